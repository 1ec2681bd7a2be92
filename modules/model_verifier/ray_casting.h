#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/uninitialized.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/ray_kernels.h"

namespace declutter {

// The solid in its own frame, ready to be met by points.
class SolidCaster {
 public:
  explicit SolidCaster(const Solid& solid);

  const Eigen::Isometry3d& X_OC() const { return X_OC_; }

  // [m] distance of a point to the surface, negative inside.
  double SignedDistance(const Eigen::Vector3d& p_O) const;

 private:
  Shape shape_;
  Eigen::Vector3d half_size_;
  Eigen::Isometry3d X_OC_;
};

// How the pixels that a solid projects to were measured. Counts are of the sensor's pixels,
// whatever the grid's step.
struct RayEvidence {
  // Measured on the surface: indices row * columns + column of the grid, each of which stands for
  // pixel_weight, and how well they fit, from kFitUnit on the surface with its normal to 0 at the
  // tolerances.
  UninitializedVector<int32_t> explained;
  UninitializedVector<int32_t> fits;
  int64_t fit_sum = 0;   // of fits
  int pixel_weight = 1;  // [px]
  PixelWindow window;    // of the grid, that holds them all
  // Indices of pixels that look into a cylinder through its open top.
  UninitializedVector<int32_t> hollow;
  // Indices of pixels beside the solid, where its top face goes on.
  UninitializedVector<int32_t> overhanging;
  int num_contradicting = 0;  // measured on the surface, with another normal
  int num_occluded = 0;       // hidden by something in front
  int num_violating = 0;      // measured behind the surface: free space inside
  int num_unknown = 0;        // not measured

  int num_explained() const { return pixel_weight * static_cast<int>(explained.size()); }
  int num_overhanging() const { return pixel_weight * static_cast<int>(overhanging.size()); }
  // [px] that speak for the solid, by how well they fit.
  double Fit() const { return static_cast<double>(pixel_weight * fit_sum) / kFitUnit; }
  // [px] that speak for the solid less those that speak against it.
  double Balance() const { return Fit() - num_violating - num_contradicting - num_overhanging(); }
};

// Casts a ray through each observed pixel that can see the solid. Points within the noise of the
// support plane belong to the plane and explain nothing. The second one uses the buffers of what it
// replaces again.
RayEvidence CastRays(const Solid& solid, const Observation& observation);
void CastRays(const Solid& solid, const Observation& observation, RayEvidence* replaced);

// [px] of the fit from pixels that at most max_num solids explain: num_explaining tells how many
// do, for each pixel of the grid.
double FitAlone(const RayEvidence& evidence, const std::vector<uint8_t>& num_explaining,
                int max_num);

// [px] of the overhanging ones that no solid explains: what goes on there may be another.
int NumOverhangingAlone(const RayEvidence& evidence, const std::vector<uint8_t>& num_explaining);

// The measured points that a solid explains, in O [m], in place of what points_O held.
void FindExplainedPoints(const Solid& solid, const RayEvidence& evidence,
                         const Observation& observation, std::vector<Eigen::Vector3d>* points_O);

// [px] of a grid with points above the support plane within reach_m of a solid.
int NumNear(const Solid& solid, double reach_m, const Observation& observation);

// [m] distance from a surface within which a measurement at depth z lies on it: 3 standard
// deviations of the sensor noise.
double SurfaceTolerance(double z);

}  // namespace declutter
