#pragma once

#include <cstdint>

#include "modules/model_verifier/ray_kernels.h"

// Loops over the pixels of a grid by SIMD, dispatched at run time to what the processor has.
// Results are the same bits with every instruction set.
namespace declutter {

// An end of a box, along `end_axis` of O, as a face across `face_axis` shows it.
struct FaceEnd {
  int face_axis = 0;
  int face_sign = 1;  // side of the box on which the face is
  int end_axis = 1;
  int end_sign = 1;  // side of the box on which the end is
};

// What a pixel says of a face.
struct FaceLimits {
  float min_tolerance_m = 0;       // a measurement on the face is nearer to it than this,
  float tolerance_per_square = 0;  // [1/m] or than this times its squared depth
  float min_incidence_cos = 0;     // of the ray to the face: it is not seen edge-on
  float min_normal_cos = 0;        // of a measured normal and the face's
  float edge_margin_m = 0;         // along the face's other edges, where pixels say nothing
  float bin_m = 0;                 // of a profile
  float first_bin_m = 0;           // where a profile begins, outward from the end
};

// Pixels of a face by how far outward from an end their rays meet its plane.
struct EndProfile {
  static constexpr int kNumBins = 80;

  int32_t there[kNumBins] = {};    // measured on the face
  int32_t gone[kNumBins] = {};     // measured well behind it, or on another object
  int32_t unknown[kNumBins] = {};  // not measured
};

// Adds the pixels of a window to a profile. What is measured in front of the face says nothing of
// it, nor does what is just behind it or turned away: faces bend, and sensors blur edges. A
// negative depth is one that is known to be measured on another object.
void AddToProfile(const RaySolid& box, const RayWindow& window, const FaceLimits& limits,
                  const FaceEnd& end, EndProfile* profile);

}  // namespace declutter
