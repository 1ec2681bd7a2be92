#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/plane.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/normal_lookup.h"

namespace declutter {

// What the camera measured, at the pixels that are multiples of step in both directions.
struct Observation {
  const DepthImage& image;
  const NormalLookup& normals;
  const Plane& support;
  int step = 1;

  // The first of these rows or columns that is not before `begin`.
  int First(int begin) const { return (begin + step - 1) / step * step; }

  // [px] that each of these pixels stands for.
  int pixel_weight() const { return step * step; }
};

// Pixel rectangle, end exclusive.
struct PixelWindow {
  int u_begin = 0, u_end = 0, v_begin = 0, v_end = 0;
};

// The part of the image that a solid with a margin around it projects to; the whole image when it
// reaches behind the camera.
PixelWindow ProjectionWindow(const Solid& solid, double margin_m, const PinholeCamera& camera);

// Where a ray from the camera passes through a solid, as depths z in C [m].
struct Passage {
  double z_in = 0;
  double z_out = 0;
  bool through_top = false;  // enters through the face at the upper end of O's z axis
};

// The solid in its own frame, ready to be met by rays and points.
class SolidCaster {
 public:
  explicit SolidCaster(const Solid& solid);

  const Eigen::Isometry3d& X_OC() const { return X_OC_; }

  // A ray from the camera, turned into O; in C it has z = 1.
  std::optional<Passage> Cast(const Eigen::Vector3d& ray_O) const;

  // [m] distance of a point to the surface, negative inside.
  double SignedDistance(const Eigen::Vector3d& p_O) const;

  // [m] outside the sides, in the plane of the top face, of a point that lies in it; nothing for
  // others.
  std::optional<double> OverhangOf(const Eigen::Vector3d& p_O, double tolerance) const;

  // Outward unit normal in O of the face nearest to a point of the surface; nothing within
  // `edge_margin` [m] of an edge, where two faces meet.
  std::optional<Eigen::Vector3d> NormalAt(const Eigen::Vector3d& p_O, double edge_margin) const;

 private:
  Shape shape_;
  Eigen::Vector3d half_size_;
  Eigen::Isometry3d X_OC_;
  Eigen::Vector3d camera_O_;
};

// How the pixels that a solid projects to were measured. Counts are of the sensor's pixels,
// whatever the step.
struct RayEvidence {
  struct ExplainedPixel {
    int pixel;       // v * width + u
    float fit;       // 1 on the surface with its normal .. 0 at the tolerances
    float distance;  // [m] signed, negative inside
  };
  std::vector<ExplainedPixel> explained;  // measured on the surface; one stands for pixel_weight
  int pixel_weight = 1;                   // [px]
  std::vector<int> hollow;                // pixels that look into a cylinder through its open top
  int num_contradicting = 0;              // measured on the surface, with another normal
  int num_occluded = 0;                   // hidden by something in front
  int num_violating = 0;                  // measured behind the surface: free space inside
  int num_overhanging = 0;                // beside the solid, where its top face goes on
  int num_unknown = 0;                    // not measured

  int num_explained() const { return pixel_weight * static_cast<int>(explained.size()); }
  // [px] that speak for the solid, by how well they fit, less those that speak against it.
  double Balance() const;
};

// Casts a ray through each observed pixel that can see the solid. Points within the noise of the
// support plane belong to the plane and explain nothing.
RayEvidence CastRays(const Solid& solid, const Observation& observation);

// [m] distance from a surface within which a measurement at depth z lies on it: 3 standard
// deviations of the sensor noise.
double SurfaceTolerance(double z);

}  // namespace declutter
