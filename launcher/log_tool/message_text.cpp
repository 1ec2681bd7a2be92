#include "launcher/log_tool/message_text.h"

#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

using runtime::MessageLayout;
using Type = MessageLayout::Type;

constexpr int kMaxElements = 8;
constexpr size_t kMaxString = 60;

double FloatAt(const uint8_t* data) {
  const auto bits = static_cast<uint32_t>(runtime::ReadInteger(data, 4));
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

double DoubleAt(const uint8_t* data) {
  const int64_t bits = runtime::ReadInteger(data, 8);
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

std::string Decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Of a string that may hold anything, what a terminal can show.
std::string Printable(const uint8_t* data, size_t size) {
  std::string text = "\"";
  for (size_t i = 0; i < size && i < kMaxString; ++i) {
    text += data[i] >= 0x20 && data[i] != 0x7F ? static_cast<char>(data[i]) : ' ';
  }
  return text + (size > kMaxString ? "...\"" : "\"");
}

// The element at *data, which is moved to the next.
std::string Element(Type type, const uint8_t** data) {
  const auto integer = [data](size_t size) {
    const int64_t value = runtime::ReadInteger(*data, size);
    *data += size;
    return std::to_string(value);
  };
  switch (type) {
    case Type::kInt8:
    case Type::kBoolean:
      return integer(1);
    case Type::kInt16:
      return integer(2);
    case Type::kInt32:
      return integer(4);
    case Type::kInt64:
      return integer(8);
    case Type::kByte:
      return std::to_string(*(*data)++);
    case Type::kFloat:
      *data += 4;
      return Decimal(FloatAt(*data - 4));
    case Type::kDouble:
      *data += 8;
      return Decimal(DoubleAt(*data - 8));
    case Type::kString:
      break;
  }
  const auto size = static_cast<size_t>(runtime::ReadInteger(*data, 4));  // with NUL
  *data += 4 + size;
  return Printable(*data - size, size - 1);
}

std::string FieldLine(const MessageLayout::Field& field, const MessageLayout::Span& span,
                      const uint8_t* data) {
  std::string line = field.name;
  if (field.is_array) line += "[" + std::to_string(span.count) + "]";
  const uint8_t* element = data + span.offset;
  for (int i = 0; i < span.count && i < kMaxElements; ++i)
    line += " " + Element(field.type, &element);
  return line + (span.count > kMaxElements ? " ..." : "");
}

}  // namespace

std::vector<std::string> FieldLines(const runtime::Bytes& message) {
  const MessageLayout* layout = runtime::FindLayout(message.data(), message.size());
  if (layout == nullptr) return {"of no type of this version"};
  try {
    const auto spans = layout->Locate(message.data(), message.size());
    std::vector<std::string> lines;
    for (size_t i = 0; i < spans.size(); ++i) {
      lines.push_back(FieldLine(layout->fields()[i], spans[i], message.data()));
    }
    return lines;
  } catch (const std::runtime_error& error) {
    return {std::string("damaged: ") + error.what()};
  }
}

}  // namespace declutter::log_tool
