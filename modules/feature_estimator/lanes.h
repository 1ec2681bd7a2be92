#pragma once

#include <cstdint>
#include <cstring>

#include "modules/feature_estimator/point_image.h"
#include "modules/geometry/for_each_processor.h"

namespace declutter {

// Adjacent pixels processed side by side. All arithmetic is per lane and in the same order with
// every instruction set, so results do not depend on the processor. Values are passed by reference:
// how vectors are passed by value depends on the instruction set.
using Lanes = float __attribute__((vector_size(PointImage::kLanes * sizeof(float))));
using LaneMask = int32_t __attribute__((vector_size(PointImage::kLanes * sizeof(int32_t))));

#define DECLUTTER_LANES inline __attribute__((always_inline))

DECLUTTER_LANES void LoadLanes(const float* from, Lanes& to) { std::memcpy(&to, from, sizeof(to)); }

DECLUTTER_LANES void StoreLanes(const Lanes& from, float* to) {
  std::memcpy(to, &from, sizeof(from));
}

// Sets lanes outside the mask to zero.
DECLUTTER_LANES void KeepLanes(const LaneMask& mask, Lanes& value) {
  value = reinterpret_cast<Lanes>(reinterpret_cast<LaneMask>(value) & mask);
}

}  // namespace declutter
