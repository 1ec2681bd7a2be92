#include "modules/runtime/definition_parser.h"

#include <cctype>
#include <stdexcept>

namespace declutter::runtime {
namespace {

std::string WithoutComments(const std::string& text) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text.compare(i, 2, "//") == 0) {
      i = text.find('\n', i);
    } else if (text.compare(i, 2, "/*") == 0) {
      i = text.find("*/", i);
      if (i != std::string::npos) ++i;
    } else {
      code += text[i];
      continue;
    }
    if (i == std::string::npos) break;
    code += ' ';
  }
  return code;
}

// Words of letters, digits, '_' and '.'; every other visible character stands alone.
class Tokens {
 public:
  explicit Tokens(const std::string& text) : text_(WithoutComments(text)) {}

  std::string Next() {
    while (at_ < text_.size() && IsSpace(text_[at_])) ++at_;
    const std::size_t start = at_;
    while (at_ < text_.size() && IsWord(text_[at_])) ++at_;
    if (at_ == start && at_ < text_.size()) ++at_;
    return text_.substr(start, at_ - start);
  }

  std::string Word() {
    std::string word = Next();
    if (word.empty() || !IsWord(word[0])) throw std::logic_error(".lcm: name expected: " + word);
    return word;
  }

  void Expect(const std::string& token) {
    const std::string found = Next();
    if (found != token) throw std::logic_error(".lcm: " + token + " expected: " + found);
  }

 private:
  static bool IsSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
  static bool IsWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  }

  std::string text_;
  std::size_t at_ = 0;
};

}  // namespace

Definition ParseDefinition(const std::string& text) {
  Tokens tokens(text);
  Definition definition;
  std::string token = tokens.Next();
  if (token == "package") {
    tokens.Word();
    tokens.Expect(";");
    token = tokens.Next();
  }
  if (token != "struct") throw std::logic_error(".lcm: struct expected: " + token);
  definition.name = tokens.Word();
  tokens.Expect("{");
  for (token = tokens.Next(); token != "}"; token = tokens.Next()) {
    Definition::Member member{token, tokens.Word(), {}};
    for (token = tokens.Next(); token == "["; token = tokens.Next()) {
      member.dimensions.push_back(tokens.Word());
      tokens.Expect("]");
    }
    if (token != ";") throw std::logic_error(".lcm: ; expected after " + member.name);
    definition.members.push_back(std::move(member));
  }
  tokens.Expect("");
  return definition;
}

}  // namespace declutter::runtime
