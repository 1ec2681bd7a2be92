#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace declutter::runtime {

// The layout of a message type as its .lcm text declares it: a flat struct of scalars, strings,
// arrays of fixed size and arrays counted by an earlier integer field.
//
// The decoders that lcm-gen writes trust the counts in a message: damaged ones throw or allocate
// gigabytes. Locate() proves beforehand that a message holds exactly what its counts promise.
class MessageLayout {
 public:
  enum class Type { kInt8, kInt16, kInt32, kInt64, kByte, kBoolean, kFloat, kDouble, kString };

  struct Field {
    std::string name;
    Type type;
    bool is_array = false;
    int fixed_count = 1;   // elements when count_field is negative
    int count_field = -1;  // index of the field that counts the elements
  };

  // The bytes of a field in a message: big-endian elements one after another, a string element as
  // an int32 length followed by as many bytes, the last of them NUL.
  struct Span {
    std::size_t offset;
    std::size_t size;
    int count;  // elements
  };

  // Throws std::logic_error for text that is not such a struct.
  static MessageLayout Parse(const std::string& definition);

  // Throws std::runtime_error, saying what a message is instead, when it is not of this type or of
  // another version of it.
  void CheckType(const std::uint8_t* data, std::size_t size) const;

  // Where each field lies in an encoded message. Throws std::runtime_error naming what is wrong
  // with a message that lcm-gen's decoder must not see. Allocates nothing of a size the message
  // states.
  std::vector<Span> Locate(const std::uint8_t* data, std::size_t size) const;

  const std::string& name() const { return name_; }
  const std::vector<Field>& fields() const { return fields_; }

  // The first eight bytes of every message of this type, as lcm-gen computes them.
  std::int64_t fingerprint() const { return fingerprint_; }

 private:
  std::string name_;
  std::vector<Field> fields_;
  std::int64_t fingerprint_ = 0;
};

// The layouts of all .lcm files of the project.
const std::vector<MessageLayout>& AllLayouts();

// Throws std::logic_error for a name that no .lcm file declares.
const MessageLayout& LayoutOf(const std::string& type_name);

// Of which of our types a message says it is; null for none.
const MessageLayout* FindLayout(const std::uint8_t* data, std::size_t size);

// The first field of every message, [us]. data holds at least 16 bytes.
std::int64_t UtimeOf(const std::uint8_t* data);

// size bytes (1, 2, 4 or 8) as a signed big-endian integer.
std::int64_t ReadInteger(const std::uint8_t* data, std::size_t size);

}  // namespace declutter::runtime
