#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace declutter {

// One field of the points of a .pcd file.
struct PcdField {
  std::string name;
  char type = 'F';          // F float, U unsigned, I signed
  size_t size = 4;          // [byte] of one value
  size_t count = 1;         // values per point
  size_t offset = 0;        // [byte] from the start of a point
  size_t token_offset = 0;  // values before it in a line of text

  size_t num_bytes() const { return size * count; }
};

// The text before the points of a .pcd file.
struct PcdHeader {
  std::vector<PcdField> fields;
  int width = 0;
  int height = 1;
  std::string encoding;     // ascii, binary or binary_compressed
  size_t point_bytes = 0;   // of all fields
  size_t point_tokens = 0;  // of all fields
  size_t header_bytes = 0;  // of the file, before the points

  size_t num_points() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
  // The four-byte field of that name.
  const PcdField* Find(const std::string& name) const;
};

// Throws std::runtime_error that says what is wrong.
PcdHeader ParsePcdHeader(const std::string& file);

}  // namespace declutter
