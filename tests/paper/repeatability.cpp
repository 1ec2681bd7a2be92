#include "tests/paper/repeatability.h"

#include <algorithm>
#include <cmath>

#include "tests/accuracy/solid_comparison.h"

namespace declutter::experiments {
namespace {

using accuracy::Verdict;

constexpr double kMinVisible = 0.5;  // part of an object that measures its extents

// Index of the horizontal axis of a true box that lies more across the line of sight.
int WidthAxis(const Solid& box, const Eigen::Vector3d& up_C) {
  const Eigen::Vector3d sight_C = box.X_CO.translation();
  const Eigen::Vector3d level_C = sight_C - up_C * up_C.dot(sight_C);
  const Eigen::Matrix3d axes = box.X_CO.linear();
  return std::abs(axes.col(0).dot(level_C)) < std::abs(axes.col(1).dot(level_C)) ? 0 : 1;
}

Eigen::Vector3d Single(double value) { return {value, 0, 0}; }

}  // namespace

void Repeatability::Add(const PreparedFrame& frame, const Result& result) {
  for (size_t i = 0; i < frame.truth.objects.size(); ++i) {
    const accuracy::TrueObject& object = frame.truth.objects[i];
    if (object.scope != accuracy::Scope::kCore) continue;
    ++num_wanted;
    const auto model = result.score.objects[i].model;
    if (!model) continue;
    ++num_right;
    if (object.visible_fraction.value_or(0) < kMinVisible) continue;
    const auto error = accuracy::CompareSolids(result.found.objects[*model].solid, *object.solid);
    if (object.shape == Shape::kBox) {
      const int axis = WidthAxis(*object.solid, frame.truth.up_C);
      width_[i].push_back(Single(error.extent[axis]));
      depth_[i].push_back(Single(error.extent[1 - axis]));
    } else {
      const Eigen::Vector3d up = object.solid->X_CO.linear().col(2);
      radius_[i].push_back(Single(error.extent.x()));
      centre_[i].push_back(error.center_C - up * up.dot(error.center_C));
    }
  }
  for (const accuracy::ModelScore& model : result.score.models) {
    num_false += model.verdict == Verdict::kFalse;
  }
}

ErrorAndSpread Repeatability::Average(const Errors& errors) {
  constexpr double kMmPerM = 1000;
  ErrorAndSpread average;
  double num_objects = 0;
  for (const auto& [object, runs] : errors) {
    if (runs.size() < 2) continue;
    const auto num_runs = static_cast<double>(runs.size());
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    double error = 0;
    for (const Eigen::Vector3d& run : runs) {
      mean += run / num_runs;
      error += run.norm() / num_runs;
    }
    double variance = 0;
    for (const Eigen::Vector3d& run : runs) variance += (run - mean).squaredNorm();
    average.mean_mm += kMmPerM * error;
    average.sd_mm += kMmPerM * std::sqrt(variance / (num_runs - 1));
    num_objects += 1;
  }
  if (num_objects == 0) return average;
  return {average.mean_mm / num_objects, average.sd_mm / num_objects};
}

ErrorAndSpread Repeatability::BoxWidth() const { return Average(width_); }
ErrorAndSpread Repeatability::BoxDepth() const { return Average(depth_); }
ErrorAndSpread Repeatability::CylinderRadius() const { return Average(radius_); }
ErrorAndSpread Repeatability::CylinderCentre() const { return Average(centre_); }

double Repeatability::LargestRangeM() const {
  double largest = 0;
  for (const Errors* errors : {&width_, &depth_, &radius_, &centre_}) {
    for (const auto& [object, runs] : *errors) {
      for (const Eigen::Vector3d& a : runs) {
        for (const Eigen::Vector3d& b : runs) largest = std::max(largest, (a - b).norm());
      }
    }
  }
  return largest;
}

}  // namespace declutter::experiments
