#include "modules/hough_segmenter/ransac_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/hough_segmenter/inlier_filters.h"

namespace declutter {
namespace {

constexpr float kBucketSide = 0.05f;       // [m] squares in which the partner of a sample is drawn
constexpr size_t kMaxScoredCells = 400;    // cells that decide between samples
constexpr float kMinBaseline = 0.008f;     // [m] of the two cells of a sample
constexpr int kMaxDraws = 12;              // of a partner, before a sample is given up
constexpr float kMinKappaLength = 0.045f;  // [m] of a line whose curvature says something
constexpr float kNoLimit = std::numeric_limits<float>::infinity();
constexpr float kMaxRadiusStep = 0.003f;  // [m] between the lower and upper part of a cylinder

}  // namespace

SideFitter::SideFitter(const HoughSegmenterConfig& config, FeatureMode mode,
                       const std::vector<SideCell>& cells, uint64_t seed)
    : config_(config),
      mode_(mode),
      cells_(cells),
      arrays_(config),
      random_(seed),
      subsample_arrays_(config) {
  arrays_.Assign(cells);
  if (cells.empty()) return;
  Eigen::Vector2f low = cells[0].p;
  Eigen::Vector2f high = low;
  for (const SideCell& cell : cells) {
    low = low.cwiseMin(cell.p);
    high = high.cwiseMax(cell.p);
  }
  num_bucket_columns_ = static_cast<int>((high.x() - low.x()) / kBucketSide) + 1;
  const int num_rows = static_cast<int>((high.y() - low.y()) / kBucketSide) + 1;
  buckets_.resize(static_cast<size_t>(num_bucket_columns_ * num_rows));
  for (size_t i = 0; i < cells.size(); ++i) {
    const Eigen::Vector2f q = (cells[i].p - low) / kBucketSide;
    const int bucket = static_cast<int>(q.y()) * num_bucket_columns_ + static_cast<int>(q.x());
    bucket_of_cell_.push_back(bucket);
    buckets_[static_cast<size_t>(bucket)].push_back(static_cast<int>(i));
  }
}

void SideFitter::Subsample(const std::vector<char>& is_free) {
  subsample_.clear();
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (is_free[i]) subsample_.push_back(static_cast<int>(i));
  }
  if (subsample_.size() > kMaxScoredCells) {
    for (size_t i = 0; i < kMaxScoredCells; ++i) {
      std::swap(subsample_[i], subsample_[i + random_(subsample_.size() - i)]);
    }
    subsample_.resize(kMaxScoredCells);
  }
  subsample_arrays_.Gather(arrays_, subsample_);
}

std::optional<std::pair<int, int>> SideFitter::SamplePair(const std::vector<char>& is_free) {
  const int a = subsample_[random_(subsample_.size())];
  const int bucket = bucket_of_cell_[static_cast<size_t>(a)];
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    const int dx = static_cast<int>(random_(3)) - 1;
    const int dy = static_cast<int>(random_(3)) - 1;
    const int column = bucket % num_bucket_columns_ + dx;
    const int neighbour = bucket + dy * num_bucket_columns_ + dx;
    if (column < 0 || column >= num_bucket_columns_ || neighbour < 0 ||
        neighbour >= static_cast<int>(buckets_.size())) {
      continue;
    }
    const auto& candidates = buckets_[static_cast<size_t>(neighbour)];
    if (candidates.empty()) continue;
    const int b = candidates[random_(candidates.size())];
    const float baseline =
        (cells_[static_cast<size_t>(a)].p - cells_[static_cast<size_t>(b)].p).norm();
    if (is_free[static_cast<size_t>(b)] && baseline > kMinBaseline) return std::pair(a, b);
  }
  return std::nullopt;
}

void SideFitter::Filter(LineFit* fit) const {
  if (mode_ == FeatureMode::kPaper && config_.filter_curvature()) {
    KeepFlat(cells_, static_cast<float>(config_.max_curvature_of_flat()), fit);
  }
  if (config_.filter_runs()) {
    KeepOneRun(cells_, static_cast<float>(config_.max_gap_m()), mode_, fit);
  }
}

void SideFitter::Filter(CircleFit* fit) const {
  const auto max_gap = static_cast<float>(config_.max_gap_m());
  if (mode_ == FeatureMode::kPaper) {
    KeepRound(
        cells_,
        config_.filter_curvature() ? static_cast<float>(config_.max_curvature_of_flat())
                                   : -kNoLimit,
        config_.filter_radius() ? static_cast<float>(config_.max_radius_difference_m()) : kNoLimit,
        fit);
  }
  if (config_.filter_heights()) KeepOneHeight(cells_, max_gap, fit);
  KeepArcs(cells_, max_gap, config_.filter_arcs() ? 2 : cells_.size(), fit);
  if (config_.filter_heights()) KeepOneRadius(cells_, kMaxRadiusStep, fit);
}

bool SideFitter::IsPossible(const LineFit& fit) const {
  // Within the reach of the features from its outlines a narrow face looks round.
  return mode_ == FeatureMode::kPaper || !config_.filter_curvature() ||
         fit.model.length() <= kMinKappaLength ||
         MedianKappa(cells_, fit.inliers) <= config_.max_kappa_of_flat();
}

bool SideFitter::IsPossible(const CircleFit& fit) const {
  if (fit.model.r < config_.min_radius_m() || fit.model.r > config_.max_radius_m()) return false;
  return mode_ == FeatureMode::kPaper || !config_.filter_radius() ||
         MedianKappa(cells_, fit.inliers) * fit.model.r >= config_.min_kappa_radius();
}

template <typename Model>
Fit<Model> SideFitter::Inliers(const Model& model, const std::vector<char>& is_free,
                               std::vector<float>* agreements) const {
  Fit<Model> fit;
  fit.model = model;
  arrays_.Agreements(model, agreements);
  for (size_t i = 0; i < cells_.size(); ++i) {
    if ((*agreements)[i] > 0 && is_free[i]) fit.inliers.push_back(static_cast<int>(i));
  }
  fit.num_points = NumPoints(cells_, fit.inliers);
  if (fit.num_points < static_cast<float>(config_.min_inliers())) return fit;
  Filter(&fit);
  fit.num_points = NumPoints(cells_, fit.inliers);
  return fit;
}

template <typename Model>
std::optional<Fit<Model>> SideFitter::RefitTo(const Model& model,
                                              const std::vector<char>& is_free) const {
  const auto min_points = static_cast<float>(config_.min_inliers());
  std::vector<float> agreements;
  Fit<Model> fit = Inliers(model, is_free, &agreements);
  if (fit.num_points < min_points) return std::nullopt;
  FitToInliers(cells_, &fit);
  fit = Inliers(fit.model, is_free, &agreements);
  if (fit.num_points < min_points) return std::nullopt;
  SetExtent(cells_, &fit);
  if (!IsPossible(fit)) return std::nullopt;
  for (int i : fit.inliers) {
    const auto index = static_cast<size_t>(i);
    fit.support += cells_[index].weight * agreements[index];
  }
  return fit;
}

std::optional<LineFit> SideFitter::Refit(const LineModel& model,
                                         const std::vector<char>& is_free) const {
  return RefitTo(model, is_free);
}

std::optional<CircleFit> SideFitter::Refit(const CircleModel& model,
                                           const std::vector<char>& is_free) const {
  return RefitTo(model, is_free);
}

template <typename Model, typename Sample>
std::optional<Model> SideFitter::BestSample(Sample sample) const {
  std::optional<Model> best;
  float best_score = 0;
  std::vector<float> agreements;
  for (int i = 0; i < config_.num_samples(); ++i) {
    const std::optional<Model> model = sample();
    if (!model) continue;
    subsample_arrays_.Agreements(*model, &agreements);
    const float score = subsample_arrays_.Support(agreements);
    if (score <= best_score) continue;
    best_score = score;
    best = model;
  }
  return best;
}

std::optional<LineFit> SideFitter::FitLine(const std::vector<char>& is_free) {
  Subsample(is_free);
  if (subsample_.empty()) return std::nullopt;
  const auto best = BestSample<LineModel>([&]() -> std::optional<LineModel> {
    const auto pair = SamplePair(is_free);
    if (!pair) return std::nullopt;
    const SideCell& a = cells_[static_cast<size_t>(pair->first)];
    const LineModel line = LineThrough(a, cells_[static_cast<size_t>(pair->second)]);
    if (line.n.dot(a.n) <= arrays_.min_cos()) return std::nullopt;
    return line;
  });
  if (!best) return std::nullopt;
  return RefitTo(*best, is_free);
}

std::optional<CircleFit> SideFitter::FitCircle(const std::vector<char>& is_free) {
  Subsample(is_free);
  if (subsample_.empty()) return std::nullopt;
  const auto best = BestSample<CircleModel>([&]() -> std::optional<CircleModel> {
    const auto pair = SamplePair(is_free);
    if (!pair) return std::nullopt;
    const auto circle = CircleThrough(cells_[static_cast<size_t>(pair->first)],
                                      cells_[static_cast<size_t>(pair->second)]);
    if (!circle || circle->r < config_.min_radius_m() || circle->r > config_.max_radius_m()) {
      return std::nullopt;
    }
    return circle;
  });
  if (!best) return std::nullopt;
  return RefitTo(*best, is_free);
}

}  // namespace declutter
