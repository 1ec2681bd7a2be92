#pragma once

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "modules/codec/codec.h"

// What every decoder asks of the numbers it reads, and every encoder of those it is given.
namespace declutter::codec {

// A field of a message, or an element of one.
struct Field {
  Field(const char* field_name) : name(field_name) {}
  Field(const char* field_name, size_t element)
      : name(field_name), index(static_cast<int64_t>(element)) {}

  std::string Text() const;

  const char* name;
  int64_t index = -1;  // -1: the field as a whole
};

// Throws BadMessage unless value is good; rule says what it should have been.
template <typename Value>
void Check(bool good, const Field& field, const Value& value, const char* rule) {
  if (good) return;
  std::ostringstream text;
  text << field.Text() << " = " << value << ": " << rule;
  throw BadMessage(text.str());
}

// Throws std::logic_error: what we are about to send is wrong.
void Demand(bool good, const std::string& rule);

// Each returns value when it is what the name says.
double Finite(const Field& field, double value);
double Positive(const Field& field, double value);
float Fraction(const Field& field, float value);  // in [0, 1]
int32_t NotNegative(const Field& field, int32_t value);

// An enumeration that counts from 0 to last.
template <typename Enum>
Enum Enumerator(const Field& field, int8_t value, Enum last) {
  Check(value >= 0 && value <= static_cast<int8_t>(last), field, static_cast<int>(value),
        "not one of the values the field can have");
  return static_cast<Enum>(value);
}

// The array called name has the length that the field called count_name states.
template <typename Element>
void CheckLength(const char* name, const std::vector<Element>& array, const char* count_name,
                 int32_t count) {
  Check(count >= 0, count_name, count, "must not be negative");
  Check(array.size() == static_cast<size_t>(count), count_name, count,
        ("is not the length of " + std::string(name)).c_str());
}

// DemandImageSize throws std::logic_error, CheckImageSize BadMessage: the image is empty exactly
// when the frame has an error, and has no side over kMaxImageSide_px. Both return their number.
size_t DemandImageSize(int width, int height, const std::string& error);
size_t CheckImageSize(int32_t width, int32_t height, const std::string& error);

// The message when it fits on the wire, else throws MessageTooLarge.
template <typename Message>
Message Fitting(Message message) {
  const int num_bytes = message.getEncodedSize();
  if (num_bytes <= kMaxMessageBytes) return message;
  throw MessageTooLarge(std::string(Message::getTypeName()) + " of " + std::to_string(num_bytes) +
                        " bytes, the limit is " + std::to_string(kMaxMessageBytes));
}

}  // namespace declutter::codec
