#include "modules/hough_segmenter/cell_arrays.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr size_t kLanes = 8;  // partial sums, added in the same order on every machine
constexpr double kMinCosUnfiltered = -1e6;  // so far below every cosine that all agree alike

}  // namespace

CellArrays::CellArrays(const HoughSegmenterConfig& config)
    : inlier_distance_m_(static_cast<float>(config.inlier_distance_m())),
      min_cos_(static_cast<float>(config.filter_normals() ? std::cos(config.max_normal_angle_rad())
                                                          : kMinCosUnfiltered)) {}

void CellArrays::Resize(size_t num) {
  for (auto* array : {&px_, &py_, &nx_, &ny_, &weight_, &inverse_limit_}) array->resize(num);
}

void CellArrays::Assign(const std::vector<SideCell>& cells) {
  Resize(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    const SideCell& cell = cells[i];
    const float limit = std::max(inlier_distance_m_, 2.5f * cell.sigma);
    px_[i] = cell.p.x();
    py_[i] = cell.p.y();
    nx_[i] = cell.n.x();
    ny_[i] = cell.n.y();
    weight_[i] = cell.weight;
    inverse_limit_[i] = 1 / (limit * limit);
  }
}

void CellArrays::Gather(const CellArrays& from, const std::vector<int>& indices) {
  Resize(indices.size());
  for (size_t k = 0; k < indices.size(); ++k) {
    const auto i = static_cast<size_t>(indices[k]);
    px_[k] = from.px_[i];
    py_[k] = from.py_[i];
    nx_[k] = from.nx_[i];
    ny_[k] = from.ny_[i];
    weight_[k] = from.weight_[i];
    inverse_limit_[k] = from.inverse_limit_[i];
  }
}

inline float CellArrays::Agreement(float squared_distance, float cos_angle, size_t i) const {
  const float nearness = std::max(0.0f, 1 - squared_distance * inverse_limit_[i]);
  return nearness * std::max(0.0f, cos_angle - min_cos_) / (1 - min_cos_);
}

void CellArrays::Agreements(const LineModel& line, std::vector<float>* agreements) const {
  agreements->resize(size());
  float* out = agreements->data();
  const float nx = line.n.x(), ny = line.n.y(), rho = line.rho;
  for (size_t i = 0; i < px_.size(); ++i) {
    const float distance = nx * px_[i] + ny * py_[i] - rho;
    out[i] = Agreement(distance * distance, nx * nx_[i] + ny * ny_[i], i);
  }
}

void CellArrays::Agreements(const CircleModel& circle, std::vector<float>* agreements) const {
  agreements->resize(size());
  float* out = agreements->data();
  const float cx = circle.c.x(), cy = circle.c.y(), r = circle.r;
  for (size_t i = 0; i < px_.size(); ++i) {
    const float dx = px_[i] - cx;
    const float dy = py_[i] - cy;
    const float radial = std::sqrt(dx * dx + dy * dy + 1e-12f);
    const float distance = radial - r;
    out[i] = Agreement(distance * distance, (dx * nx_[i] + dy * ny_[i]) / radial, i);
  }
}

float CellArrays::Support(const std::vector<float>& agreements) const {
  float sums[kLanes] = {};
  const size_t num = size();
  const size_t num_whole = num / kLanes * kLanes;
  for (size_t i = 0; i < num_whole; i += kLanes) {
    for (size_t lane = 0; lane < kLanes; ++lane) {
      sums[lane] += weight_[i + lane] * agreements[i + lane];
    }
  }
  for (size_t i = num_whole; i < num; ++i) sums[0] += weight_[i] * agreements[i];
  float sum = 0;
  for (float partial : sums) sum += partial;
  return sum;
}

}  // namespace declutter
