#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/hough_segmenter/cell_arrays.h"
#include "modules/hough_segmenter/cell_set.h"

namespace declutter {

// A vertical face seen from above: the part [s_min, s_max] of the line n . p = rho, at heights
// [z_min, z_max]. All in T.
struct LineModel {
  Eigen::Vector2f n = Eigen::Vector2f::UnitX();  // unit, outward
  float rho = 0;                                 // [m]
  float s_min = 0;                               // [m] along tangent()
  float s_max = 0;                               // [m]
  float z_min = 0;                               // [m]
  float z_max = 0;                               // [m]

  Eigen::Vector2f tangent() const { return {-n.y(), n.x()}; }
  Eigen::Vector2f PointAt(float s) const { return rho * n + s * tangent(); }
  float length() const { return s_max - s_min; }
};

// A vertical cylinder seen from above, at heights [z_min, z_max]. All in T.
struct CircleModel {
  Eigen::Vector2f c = Eigen::Vector2f::Zero();  // [m]
  float r = 0;                                  // [m]
  float z_min = 0;                              // [m]
  float z_max = 0;                              // [m]
  float arc = 0;                                // [rad] part of the circle that was seen
};

// A model with the cells that support it.
template <typename Model>
struct Fit {
  Model model;
  float support = 0;     // [px] weighted by how well each inlier fits
  float num_points = 0;  // [px] in all inliers
  CellSet inliers;
};
using LineFit = Fit<LineModel>;
using CircleFit = Fit<CircleModel>;

// Least squares on the inliers, weighted by points and noise: total least squares for the line,
// whose normal keeps its side, Gauss-Newton on the distances for the circle. There must be inliers.
void FitToInliers(const CellArrays& inliers, LineModel* line);
void FitToInliers(const CellArrays& inliers, CircleModel* circle);

// Sets extent and heights of the model from the inliers, of which there must be some.
void SetExtent(const CellArrays& inliers, LineModel* line);
void SetExtent(const CellArrays& inliers, CircleModel* circle);

inline LineShape ShapeOf(const LineModel& line) { return {line.n.x(), line.n.y(), line.rho}; }
inline CircleShape ShapeOf(const CircleModel& circle) {
  return {circle.c.x(), circle.c.y(), circle.r};
}

// Without extents.
inline LineModel ModelOf(const LineShape& line) {
  LineModel model;
  model.n = {line.nx, line.ny};
  model.rho = line.rho;
  return model;
}
inline CircleModel ModelOf(const CircleShape& circle) {
  CircleModel model;
  model.c = {circle.cx, circle.cy};
  model.r = circle.r;
  return model;
}

}  // namespace declutter
