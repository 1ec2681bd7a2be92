#include "modules/codec/normal_code.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/geometry/for_each_processor.h"

// The loops select instead of branching: the compiler makes vectors of them.
namespace declutter::codec {
namespace {

constexpr float kSteps = 127;

// Folds the lower half of the octahedron, z < 0, over the upper one's outer triangles, and back:
// the coordinate that was `along`, the other one being `across`.
inline float Folded(float along, float across) {
  return std::copysign(1 - std::abs(across), along);
}

// std::lround, of values that an int8_t can hold.
inline int8_t Rounded(float value) {
  const int whole = static_cast<int>(value);
  const float rest = value - static_cast<float>(whole);
  return static_cast<int8_t>(whole + (rest >= 0.5f) - (rest <= -0.5f));
}

}  // namespace

DECLUTTER_FOR_EACH_PROCESSOR void EncodeNormals(const float* x, const float* y, const float* z,
                                                size_t num, int8_t* first, int8_t* second) {
  for (size_t i = 0; i < num; ++i) {
    const float norm = std::abs(x[i]) + (std::abs(y[i]) + std::abs(z[i]));
    const float divisor = std::max(norm, std::numeric_limits<float>::min());
    const float upper_x = -x[i] / divisor, upper_y = -y[i] / divisor;
    const float lower_x = Folded(upper_x, upper_y), lower_y = Folded(upper_y, upper_x);
    first[i] = Rounded(kSteps * (z[i] > 0 ? lower_x : upper_x));
    second[i] = Rounded(kSteps * (z[i] > 0 ? lower_y : upper_y));
  }
  for (size_t i = 0; i < num; ++i) {
    const bool is_known = (x[i] != 0) | (y[i] != 0) | (z[i] != 0);
    first[i] = is_known ? first[i] : kUnknownNormal;
    second[i] = is_known ? second[i] : kUnknownNormal;
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void DecodeNormals(const int8_t* first, const int8_t* second,
                                                size_t num, float* x, float* y, float* z) {
  for (size_t i = 0; i < num; ++i) {
    const float code_x = static_cast<float>(first[i]) / kSteps;
    const float code_y = static_cast<float>(second[i]) / kSteps;
    const float p_z = 1 - (std::abs(code_x) + std::abs(code_y));
    const float p_x = p_z < 0 ? Folded(code_x, code_y) : code_x;
    const float p_y = p_z < 0 ? Folded(code_y, code_x) : code_y;
    const float norm = std::sqrt(p_x * p_x + (p_y * p_y + p_z * p_z));
    const bool is_known = first[i] != kUnknownNormal;
    x[i] = is_known ? -(p_x / norm) : 0;
    y[i] = is_known ? -(p_y / norm) : 0;
    z[i] = is_known ? -(p_z / norm) : 0;
  }
}

}  // namespace declutter::codec
