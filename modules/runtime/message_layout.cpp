#include "modules/runtime/message_layout.h"

#include <cctype>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "declutter/definitions.hpp"
#include "modules/runtime/definition_parser.h"

namespace declutter::runtime {
namespace {

using Type = MessageLayout::Type;

constexpr std::size_t kFingerprintBytes = 8;

const std::map<std::string, Type>& TypesByName() {
  static const std::map<std::string, Type> types = {
      {"int8_t", Type::kInt8},   {"int16_t", Type::kInt16}, {"int32_t", Type::kInt32},
      {"int64_t", Type::kInt64}, {"byte", Type::kByte},     {"boolean", Type::kBoolean},
      {"float", Type::kFloat},   {"double", Type::kDouble}, {"string", Type::kString}};
  return types;
}

std::size_t ElementSize(Type type) {
  switch (type) {
    case Type::kInt8:
    case Type::kByte:
    case Type::kBoolean:
      return 1;
    case Type::kInt16:
      return 2;
    case Type::kInt32:
    case Type::kFloat:
      return 4;
    case Type::kInt64:
    case Type::kDouble:
      return 8;
    case Type::kString:
      break;
  }
  throw std::logic_error("a string has no fixed size");
}

// LCM's hash of a struct: names and types of the members and how they are counted, not the name of
// the struct.
class Fingerprint {
 public:
  void Add(int c) {
    const std::uint64_t sign_extended = static_cast<std::uint64_t>(hash_ >> 55);
    hash_ = static_cast<std::int64_t>(((static_cast<std::uint64_t>(hash_) << 8) ^ sign_extended) +
                                      static_cast<std::uint64_t>(c));
  }

  void Add(const std::string& text) {
    Add(static_cast<int>(text.size()));
    for (const char c : text) Add(static_cast<int>(c));
  }

  std::int64_t Value() const {
    const auto bits = static_cast<std::uint64_t>(hash_);
    return static_cast<std::int64_t>((bits << 1) + (bits >> 63));
  }

 private:
  std::int64_t hash_ = 0x12345678;
};

std::string Hexadecimal(std::int64_t fingerprint) {
  char text[20];
  std::snprintf(text, sizeof(text), "0x%016" PRIx64, static_cast<std::uint64_t>(fingerprint));
  return text;
}

bool IsNumber(const std::string& word) {
  return std::isdigit(static_cast<unsigned char>(word[0])) != 0;
}

void AddMember(const Definition::Member& member, Fingerprint* fingerprint) {
  fingerprint->Add(member.name);
  fingerprint->Add(member.type);
  fingerprint->Add(static_cast<int>(member.dimensions.size()));
  for (const std::string& dimension : member.dimensions) {
    fingerprint->Add(IsNumber(dimension) ? 0 : 1);
    fingerprint->Add(dimension);
  }
}

int IndexOf(const std::vector<MessageLayout::Field>& fields, const std::string& name) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].name == name && fields[i].type == Type::kInt32 && !fields[i].is_array) {
      return static_cast<int>(i);
    }
  }
  throw std::logic_error(".lcm: " + name + " must be an earlier int32_t");
}

MessageLayout::Field FieldOf(const Definition::Member& member,
                             const std::vector<MessageLayout::Field>& earlier) {
  const auto type = TypesByName().find(member.type);
  if (type == TypesByName().end() || member.dimensions.size() > 1) {
    throw std::logic_error(".lcm: only flat fields are supported: " + member.name);
  }
  MessageLayout::Field field{member.name, type->second};
  if (member.dimensions.empty()) return field;
  field.is_array = true;
  const std::string& count = member.dimensions[0];
  if (IsNumber(count)) {
    field.fixed_count = std::stoi(count);
  } else {
    field.count_field = IndexOf(earlier, count);
  }
  return field;
}

std::runtime_error Broken(const std::string& field, const std::string& what, std::int64_t value) {
  return std::runtime_error(field + ' ' + what + " (" + std::to_string(value) + ')');
}

// Bytes of a field's elements that start at offset; never reads beyond size.
std::size_t SizeOf(const MessageLayout::Field& field, int count, const std::uint8_t* data,
                   std::size_t offset, std::size_t size) {
  if (field.type != Type::kString) {
    const std::size_t bytes = static_cast<std::size_t>(count) * ElementSize(field.type);
    if (bytes > size - offset) throw Broken(field.name, "is longer than its message", count);
    return bytes;
  }
  const std::size_t start = offset;
  for (int i = 0; i < count; ++i) {
    if (size - offset < 4) throw Broken(field.name, "is cut off", count);
    const std::int64_t length = ReadInteger(data + offset, 4);
    offset += 4;
    if (length < 1) throw Broken(field.name, "has a bad length", length);
    const auto bytes = static_cast<std::size_t>(length);
    if (bytes > size - offset) throw Broken(field.name, "is longer than its message", length);
    offset += bytes;
    if (data[offset - 1] != 0) throw Broken(field.name, "does not end in NUL", length);
  }
  return offset - start;
}

}  // namespace

MessageLayout MessageLayout::Parse(const std::string& text) {
  const Definition definition = ParseDefinition(text);
  MessageLayout layout;
  layout.name_ = definition.name;
  Fingerprint fingerprint;
  for (const Definition::Member& member : definition.members) {
    layout.fields_.push_back(FieldOf(member, layout.fields_));
    AddMember(member, &fingerprint);
  }
  layout.fingerprint_ = fingerprint.Value();
  return layout;
}

void MessageLayout::CheckType(const std::uint8_t* data, std::size_t size) const {
  if (size < kFingerprintBytes) {
    throw std::runtime_error("not a " + name_ + " (" + std::to_string(size) + " byte)");
  }
  const std::int64_t fingerprint = ReadInteger(data, kFingerprintBytes);
  if (fingerprint == fingerprint_) return;
  if (const MessageLayout* other = FindLayout(data, size)) {
    throw std::runtime_error("of type " + other->name() + ", not " + name_);
  }
  throw std::runtime_error("not a " + name_ + " of this version (fingerprint " +
                           Hexadecimal(fingerprint) + ", here " + Hexadecimal(fingerprint_) + ')');
}

std::vector<MessageLayout::Span> MessageLayout::Locate(const std::uint8_t* data,
                                                       std::size_t size) const {
  CheckType(data, size);
  std::vector<Span> spans;
  spans.reserve(fields_.size());
  std::size_t offset = kFingerprintBytes;
  for (const Field& field : fields_) {
    int count = field.fixed_count;
    if (field.count_field >= 0) {
      const Span& counter = spans[static_cast<std::size_t>(field.count_field)];
      count = static_cast<int>(ReadInteger(data + counter.offset, 4));
      if (count < 0) throw Broken(field.name, "has a negative count", count);
    }
    const std::size_t bytes = SizeOf(field, count, data, offset, size);
    spans.push_back({offset, bytes, count});
    offset += bytes;
  }
  if (offset != size) {
    throw Broken(name_, "has bytes too many", static_cast<std::int64_t>(size - offset));
  }
  return spans;
}

const std::vector<MessageLayout>& AllLayouts() {
  static const std::vector<MessageLayout> layouts = [] {
    std::vector<MessageLayout> parsed;
    for (const char* text : kMessageDefinitions) parsed.push_back(MessageLayout::Parse(text));
    return parsed;
  }();
  return layouts;
}

const MessageLayout& LayoutOf(const std::string& type_name) {
  for (const MessageLayout& layout : AllLayouts()) {
    if (layout.name() == type_name) return layout;
  }
  throw std::logic_error("no .lcm file declares " + type_name);
}

const MessageLayout* FindLayout(const std::uint8_t* data, std::size_t size) {
  if (size < kFingerprintBytes) return nullptr;
  const std::int64_t fingerprint = ReadInteger(data, kFingerprintBytes);
  for (const MessageLayout& layout : AllLayouts()) {
    if (layout.fingerprint() == fingerprint) return &layout;
  }
  return nullptr;
}

std::int64_t UtimeOf(const std::uint8_t* data) { return ReadInteger(data + kFingerprintBytes, 8); }

std::int64_t ReadInteger(const std::uint8_t* data, std::size_t size) {
  std::uint64_t bits = (data[0] & 0x80U) != 0 ? ~std::uint64_t{0} : 0;
  for (std::size_t i = 0; i < size; ++i) bits = (bits << 8) | data[i];
  return static_cast<std::int64_t>(bits);
}

}  // namespace declutter::runtime
