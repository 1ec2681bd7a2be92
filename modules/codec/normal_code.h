#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace declutter::codec {

// A unit normal in two bytes: the octahedral map (Cigolle et al., A Survey of Efficient
// Representations for Independent Unit Vectors, JCGT 2014, "oct16") of -normal, so that normals
// toward the camera, z < 0 in C, lie in the middle of the map and neighbours have codes close by.
using NormalCode = std::array<int8_t, 2>;

// Code of an unknown normal, which is the zero vector.
inline constexpr NormalCode kUnknownNormal = {-128, -128};

// Decoded normals are unit vectors at most 1.0 degrees (on average 0.34) off.
NormalCode EncodeNormal(const Eigen::Vector3f& normal);

// Whether EncodeNormal can have returned code.
inline bool IsNormalCode(const NormalCode& code) {
  return code == kUnknownNormal || (code[0] != -128 && code[1] != -128);
}
Eigen::Vector3f DecodeNormal(const NormalCode& code);

}  // namespace declutter::codec
