#pragma once

#include <cstddef>
#include <cstdint>

namespace declutter::codec {

// A unit normal in two bytes: the octahedral map (Cigolle et al., A Survey of Efficient
// Representations for Independent Unit Vectors, JCGT 2014, "oct16") of -normal, so that normals
// toward the camera, z < 0 in C, lie in the middle of the map and neighbours have codes close by.
// Decoded normals are unit vectors at most 1.0 degrees (on average 0.34) off.

// Both bytes of the code of an unknown normal, which is the zero vector.
inline constexpr int8_t kUnknownNormal = -128;

// Whether EncodeNormals can have written a code.
inline bool IsNormalCode(int8_t first, int8_t second) {
  return (first == kUnknownNormal) == (second == kUnknownNormal);
}

// Arrays of num elements. Coordinates must be finite.
void EncodeNormals(const float* x, const float* y, const float* z, size_t num, int8_t* first,
                   int8_t* second);
void DecodeNormals(const int8_t* first, const int8_t* second, size_t num, float* x, float* y,
                   float* z);

}  // namespace declutter::codec
