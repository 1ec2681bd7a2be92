#include "modules/model_verifier/leaning_boxes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "modules/geometry/quantile.h"
#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/extents.h"

namespace declutter {
namespace {

constexpr float kMinPatchCos = 0.99f;        // 8 degrees between normals of neighbours on a plane
constexpr float kMaxSlant = 0.985f;          // of normals: 10 degrees off upright
constexpr double kMaxResidual = 1.5;         // [sigma] rms of the points of a patch
constexpr double kMaxFaceCos = 0.17;         // 10 degrees off the right angle between two faces
constexpr double kUprightCos = 0.985;        // 10 degrees: a box that leans less is taken to stand
constexpr double kNormalReach = 0.012;       // [m] from an edge to where normals are known
constexpr double kLow = 0.02, kHigh = 0.98;  // quantiles of points where a box ends

struct Range {
  double low, high;
};

// Ends of points along a direction from an origin. values is a buffer.
Range RangeAlong(const Eigen::Vector3d& direction, const Eigen::Vector3d& origin,
                 const std::vector<Eigen::Vector3d>& points, std::vector<double>* values) {
  values->clear();
  for (const Eigen::Vector3d& p : points) values->push_back(direction.dot(p - origin));
  const double low = Quantile(values, kLow);
  return {low, Quantile(values, kHigh)};
}

// The same axes and extents, with the most upright axis as z.
Solid WithUprightAxis(const Eigen::Matrix3d& axes, const Eigen::Vector3d& extents,
                      const Eigen::Vector3d& up) {
  int upright = 0;
  (axes.transpose() * up).cwiseAbs().maxCoeff(&upright);
  Solid box;
  const Eigen::Vector3d z = std::copysign(1.0, axes.col(upright).dot(up)) * axes.col(upright);
  const Eigen::Vector3d x = axes.col((upright + 1) % 3);
  box.X_CO.linear() << x, z.cross(x), z;
  box.size = {extents[(upright + 1) % 3], extents[(upright + 2) % 3], extents[upright]};
  return box;
}

}  // namespace

// Joins neighbours that lie on one plane.
void LeaningBoxFinder::LabelPatches(const std::vector<uint8_t>& is_marked,
                                    const PixelWindow& window, const Observation& observation) {
  const PixelGrid& grid = observation.grid;
  const Eigen::Vector3f up = observation.support.normal.cast<float>();
  sets_.Reset(0);
  points_.clear();
  normals_.clear();
  above_.assign(static_cast<size_t>(grid.columns), kNone);
  const auto join_if_flat = [&](size_t a, size_t b) {
    if (normals_[a].dot(normals_[b]) < kMinPatchCos) return;
    const float step = std::abs(normals_[a].dot(points_[a] - points_[b]));
    if (step < 3 * MeasurementSigma(points_[a].z())) sets_.Join(a, b);
  };
  for (int v = window.v_begin; v < window.v_end; ++v) {
    const auto row = static_cast<size_t>(v);
    size_t left = kNone;
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const auto column = static_cast<size_t>(u);
      size_t& above = above_[column];
      const float z = grid.z[row * grid.stride + column];
      const bool is_seen = z > 0 && is_marked[row * static_cast<size_t>(grid.columns) + column];
      const Eigen::Vector3f normal =
          is_seen ? observation.normals.At(grid.step * u, grid.step * v) : Eigen::Vector3f::Zero();
      if (normal.isZero() || std::abs(normal.dot(up)) > kMaxSlant) {
        left = above = kNone;
        continue;
      }
      const size_t here = sets_.Add();
      points_.emplace_back(z * grid.ray_x[column], z * grid.ray_y[row], z);
      normals_.push_back(normal);
      if (left != kNone) join_if_flat(here, left);
      if (above != kNone) join_if_flat(here, above);
      left = above = here;
    }
  }
}

// Keeps what is large and flat.
void LeaningBoxFinder::GatherPatches(size_t min_points) {
  patches_.Clear();
  num_points_.assign(points_.size(), 0);
  patch_of_root_.assign(points_.size(), kNone);
  for (size_t i = 0; i < points_.size(); ++i) ++num_points_[sets_.Root(i)];
  for (size_t i = 0; i < points_.size(); ++i) {
    const size_t root = sets_.Root(i);
    if (num_points_[root] < min_points) continue;
    if (patch_of_root_[root] == kNone) {
      patch_of_root_[root] = patches_.size();
      patches_.Add().points.clear();
    }
    patches_[patch_of_root_[root]].points.push_back(points_[i].cast<double>());
  }
  for (Patch& patch : patches_) {
    const auto num = static_cast<double>(patch.points.size());
    patch.mean.setZero();
    for (const Eigen::Vector3d& p : patch.points) patch.mean += p / num;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : patch.points) {
      covariance += (p - patch.mean) * (p - patch.mean).transpose() / num;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    patch.normal = solver.eigenvectors().col(0);
    if (patch.normal.dot(patch.mean) > 0) patch.normal *= -1;
    patch.is_flat = std::sqrt(std::max(0.0, solver.eigenvalues()[0])) <
                    kMaxResidual * MeasurementSigma(patch.mean.z());
  }
}

std::optional<Solid> LeaningBoxFinder::BoxOver(const Patch& a, const Patch& b,
                                               const Eigen::Vector3d& up) {
  if (std::abs(a.normal.dot(b.normal)) > kMaxFaceCos) return std::nullopt;
  Eigen::Matrix3d axes;
  axes.col(0) = a.normal;
  axes.col(1) = (b.normal - a.normal.dot(b.normal) * a.normal).normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  if ((axes.transpose() * up).cwiseAbs().maxCoeff() > kUprightCos) return std::nullopt;
  std::array<Range, 3> ends;
  for (int i = 0; i < 3; ++i) {
    const Range of_a = RangeAlong(axes.col(i), a.mean, a.points, &coordinates_);
    const Range of_b = RangeAlong(axes.col(i), a.mean, b.points, &coordinates_);
    ends[static_cast<size_t>(i)] = {std::min(of_a.low, of_b.low) - kNormalReach,
                                    std::max(of_a.high, of_b.high) + kNormalReach};
  }
  // Each face ends the other one.
  ends[0].high = 0;
  ends[1].high = axes.col(1).dot(b.mean - a.mean);
  Eigen::Vector3d extents, centre;
  for (int i = 0; i < 3; ++i) {
    const Range& range = ends[static_cast<size_t>(i)];
    extents[i] = range.high - range.low;
    centre[i] = 0.5 * (range.low + range.high);
  }
  if (extents.minCoeff() < kMinExtent || extents.maxCoeff() > kMaxExtent) return std::nullopt;
  Solid box = WithUprightAxis(axes, extents, up);
  box.X_CO.translation() = a.mean + axes * centre;
  return box;
}

const std::vector<LeaningBox>& LeaningBoxFinder::Find(const std::vector<uint8_t>& is_marked,
                                                      const PixelWindow& window, int min_px,
                                                      const Observation& observation) {
  boxes_.clear();
  const int pixel_weight = observation.grid.pixel_weight();
  LabelPatches(is_marked, window, observation);
  GatherPatches(static_cast<size_t>(min_px / pixel_weight));
  for (size_t i = 0; i < patches_.size(); ++i) {
    for (size_t k = 0; k < i; ++k) {
      const Patch& a = patches_[k];
      const Patch& b = patches_[i];
      if (!a.is_flat || !b.is_flat) continue;
      const auto box = BoxOver(a, b, observation.support.normal);
      const auto num_points = static_cast<int>(a.points.size() + b.points.size());
      if (box) boxes_.push_back({*box, pixel_weight * num_points});
    }
  }
  return boxes_;
}

}  // namespace declutter
