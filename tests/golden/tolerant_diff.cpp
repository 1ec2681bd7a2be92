#include "tests/golden/tolerant_diff.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace declutter::golden {
namespace {

std::vector<std::string> Split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

std::optional<double> NumberOf(const std::string& word) {
  char* end = nullptr;
  const double number = std::strtod(word.c_str(), &end);
  if (word.empty() || *end != '\0' || !std::isfinite(number)) return std::nullopt;
  return number;
}

// Why a line is not what was expected; empty when it is. Nothing when it is another line, with
// other words.
std::optional<std::string> Compare(const std::string& expected, const std::string& actual,
                                   const Tolerances& tolerances) {
  const std::vector<std::string> a = Split(expected, ' '), b = Split(actual, ' ');
  if (a.size() != b.size()) return std::nullopt;
  std::string word, fault;
  for (size_t i = 0; i < a.size(); ++i) {
    const auto x = NumberOf(a[i]), y = NumberOf(b[i]);
    if (!x || !y) {
      if (a[i] != b[i]) return std::nullopt;
      word = a[i];
      continue;
    }
    const auto found = tolerances.find(word);
    const Tolerance tolerance = found == tolerances.end() ? Tolerance{} : found->second;
    const double limit = std::max(tolerance.absolute, tolerance.relative * std::abs(*x));
    // What is printed in decimals is equal to them only nearly.
    if (std::abs(*x - *y) <= limit + 1e-9 || !fault.empty()) continue;
    std::ostringstream text;
    text << word << " " << a[i] << " -> " << b[i] << ", may differ by " << limit;
    fault = text.str();
  }
  return fault;
}

struct Texts {
  std::vector<std::string> expected, actual;
  const Tolerances& tolerances;

  std::optional<std::string> CompareLines(size_t i, size_t j) const {
    return Compare(expected[i], actual[j], tolerances);
  }

  // What two lines at one place are worth: equal ones most, those with the same words a little.
  int Worth(size_t i, size_t j) const {
    const auto fault = CompareLines(i, j);
    return !fault ? 0 : fault->empty() ? 3 : 1;
  }
};

// worth[i][j]: of the best pairs of lines from i and j to the ends.
std::vector<std::vector<int>> BestWorths(const Texts& texts) {
  const size_t n = texts.expected.size(), m = texts.actual.size();
  std::vector<std::vector<int>> worth(n + 1, std::vector<int>(m + 1, 0));
  for (size_t i = n; i-- > 0;) {
    for (size_t j = m; j-- > 0;) {
      worth[i][j] =
          std::max({worth[i + 1][j], worth[i][j + 1], worth[i + 1][j + 1] + texts.Worth(i, j)});
    }
  }
  return worth;
}

class DiffText {
 public:
  void SetHeading(const std::string& line) {
    if (line.rfind("== ", 0) == 0) heading_ = line;
  }

  void Add(const std::string& mark, const std::string& line) {
    if (heading_ != printed_heading_) text_ += heading_ + "\n";
    printed_heading_ = heading_;
    text_ += mark + line + "\n";
  }

  const std::string& text() const { return text_; }

 private:
  std::string heading_, printed_heading_, text_;
};

}  // namespace

Tolerances ParseTolerances(const std::string& text) {
  Tolerances tolerances;
  for (std::string line : Split(text, '\n')) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string word, rest;
    Tolerance tolerance;
    if (!(words >> word)) continue;
    if (!(words >> tolerance.absolute >> tolerance.relative) || words >> rest) {
      throw std::runtime_error("not WORD ABSOLUTE RELATIVE: " + line);
    }
    tolerances[word] = tolerance;
  }
  return tolerances;
}

std::string TolerantDiff(const std::string& expected, const std::string& actual,
                         const Tolerances& tolerances) {
  const Texts texts{Split(expected, '\n'), Split(actual, '\n'), tolerances};
  const auto worth = BestWorths(texts);
  DiffText diff;
  size_t i = 0, j = 0;
  while (i < texts.expected.size() || j < texts.actual.size()) {
    const bool has_both = i < texts.expected.size() && j < texts.actual.size();
    const auto fault = has_both ? texts.CompareLines(i, j) : std::nullopt;
    if (fault && worth[i][j] == worth[i + 1][j + 1] + texts.Worth(i, j)) {
      diff.SetHeading(texts.expected[i]);
      if (!fault->empty()) {
        diff.Add("- ", texts.expected[i]);
        diff.Add("+ ", texts.actual[j] + "   (" + *fault + ")");
      }
      ++i, ++j;
    } else if (j == texts.actual.size() ||
               (i < texts.expected.size() && worth[i][j] == worth[i + 1][j])) {
      diff.SetHeading(texts.expected[i]);
      diff.Add("- ", texts.expected[i++]);
    } else {
      diff.SetHeading(texts.actual[j]);
      diff.Add("+ ", texts.actual[j++]);
    }
  }
  return diff.text();
}

}  // namespace declutter::golden
