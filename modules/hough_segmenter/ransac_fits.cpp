#include "modules/hough_segmenter/ransac_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace declutter {
namespace {

constexpr size_t kMaxScoredCells = 256;    // cells that decide between samples
constexpr size_t kFirstScoredCells = 64;   // cells that decide which samples are scored on all
constexpr size_t kMinFinalists = 6;        // samples that are
constexpr float kMinBaseline = 0.008f;     // [m] of the two cells of a sample
constexpr int kMaxDraws = 4;               // of a partner, before a sample is given up
constexpr float kMinKappaLength = 0.045f;  // [m] of a line whose curvature says something
constexpr float kNoLimit = std::numeric_limits<float>::infinity();
constexpr float kMaxRadiusStep = 0.003f;    // [m] between the lower and upper part of a cylinder
constexpr float kSlackBeforeRefit = 2.0f;   // of the limits of a model that is not yet refitted
constexpr double kMinCosUnfiltered = -1e6;  // so far below every cosine that all agree alike

}  // namespace

SideFitter::SideFitter(const HoughSegmenterConfig& config)
    : config_(config),
      min_cos_(static_cast<float>(config.filter_normals() ? std::cos(config.max_normal_angle_rad())
                                                          : kMinCosUnfiltered)),
      radii_{static_cast<float>(config.min_radius_m()), static_cast<float>(config.max_radius_m())} {
}

void SideFitter::Assign(FeatureMode mode, const std::vector<SideCell>& cells, uint64_t seed,
                        int64_t max_tests) {
  max_tests_ = max_tests;
  num_tests_ = 0;
  mode_ = mode;
  cells_ = &cells;
  random_ = RandomIndex(seed);
  const auto inlier_distance = static_cast<float>(config_.inlier_distance_m());
  sample_cells_.clear();
  for (const SideCell& cell : cells) {
    sample_cells_.push_back(
        {cell.p.x(), cell.p.y(), cell.n.x(), cell.n.y(), InlierLimit(cell, inlier_distance)});
  }
  order_.resize(cells.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  open_.Resize(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    std::swap(order_[i], order_[i + random_(cells.size() - i)]);
    open_.Set(i, cells[order_[i]], order_[i], inlier_distance);
  }
  buckets_.Assign(cells);
  place_.resize(cells.size());
  Restart();
}

void SideFitter::Restart() {
  pairs_.Clear();
  num_left_ = open_.size();
  const float* weights = open_.field(CellArrays::kWeight);
  left_weights_.assign(weights, weights + num_left_ + kCellBlock);
  num_points_left_ = open_.NumPoints();
  for (size_t i = 0; i < num_left_; ++i) place_[open_.IndexOf(i)] = i;
  buckets_.Restore();
}

void SideFitter::Take(const CellSet& inliers) {
  pairs_.Clear();
  inliers.ForEach([this](size_t cell) {
    float& weight = left_weights_[place_[cell]];
    num_points_left_ -= weight;
    weight = 0;
    --num_left_;
    buckets_.Remove(cell);
  });
}

void SideFitter::Explain(const CellSet& cells) {
  marks_.resize(open_.size() + kCellBlock);
  for (size_t i = 0; i < open_.size(); ++i) {
    marks_[i] = cells.Contains(open_.IndexOf(i)) ? 0.0f : 1.0f;
  }
  open_.KeepMarked(marks_);
  buckets_.Restore();
  cells.ForEach([this](size_t i) { buckets_.Remove(i); });
  buckets_.Keep();
}

CellView SideFitter::OpenCells(const float* weights) const {
  CellView cells = open_.view();
  cells.weight = weights;
  return cells;
}

void SideFitter::DrawPairs() {
  for (int i = 0; i < config_.num_samples(); ++i) {
    size_t place = random_(open_.size());
    while (left_weights_[place] == 0) place = random_(open_.size());
    const size_t index = open_.IndexOf(place);
    const SampleCell& a = sample_cells_[index];
    for (int draw = 0; draw < kMaxDraws; ++draw) {
      const auto near = buckets_.DrawNear(index, &random_);
      if (!near) continue;
      const SampleCell& b = sample_cells_[*near];
      const float dx = a.x - b.x, dy = a.y - b.y;
      if (dx * dx + dy * dy <= kMinBaseline * kMinBaseline) continue;
      pairs_.Add(a, b);
      break;
    }
  }
}

void SideFitter::FindCandidates(std::vector<LineShape>* lines) const {
  LinesThrough(pairs_, min_cos_, lines);
}

void SideFitter::FindCandidates(std::vector<CircleShape>* circles) const {
  CirclesThrough(pairs_, radii_, circles);
}

template <typename Shape>
bool SideFitter::Rank(const std::vector<Shape>& candidates) {
  // Parts of the open cells in which about so many are left.
  const auto part_with = [this](size_t num) {
    return std::min(open_.size(), num * open_.size() / num_left_);
  };
  const size_t num_scored = part_with(kMaxScoredCells);
  const size_t num_first = part_with(kFirstScoredCells);
  const size_t begin = random_(open_.size() - num_scored + 1);
  const CellView left = OpenCells(left_weights_.data());
  scores_.resize(candidates.size());
  Supports(left.Part(begin, num_first), candidates.data(), candidates.size(), min_cos_,
           scores_.data());
  num_tests_ += static_cast<int64_t>(candidates.size() * num_first);

  const auto is_better = [this](size_t i, size_t j) {
    return scores_[i] != scores_[j] ? scores_[i] > scores_[j] : i < j;
  };
  ranking_.resize(candidates.size());
  std::iota(ranking_.begin(), ranking_.end(), size_t{0});
  if (num_scored > num_first) {
    const size_t num_finalists =
        std::min(candidates.size(), std::max(kMinFinalists, candidates.size() / 4));
    std::nth_element(ranking_.begin(),
                     ranking_.begin() + static_cast<std::ptrdiff_t>(num_finalists), ranking_.end(),
                     is_better);
    ranking_.resize(num_finalists);
    const CellView rest = left.Part(begin + num_first, num_scored - num_first);
    for (const size_t i : ranking_) {
      float support = 0;
      Supports(rest, &candidates[i], 1, min_cos_, &support);
      scores_[i] += support;
    }
    num_tests_ += static_cast<int64_t>(num_finalists * rest.num);
  }
  std::iter_swap(ranking_.begin(), std::min_element(ranking_.begin(), ranking_.end(), is_better));
  return scores_[ranking_[0]] > 0;
}

template <typename Shape, typename Model>
bool SideFitter::FitBest(std::vector<Shape>* candidates, Fit<Model>* fit) {
  if (is_spent() || num_left_ == 0 ||
      num_points_left_ < static_cast<float>(config_.min_inliers())) {
    return false;
  }
  if (pairs_.empty()) DrawPairs();
  FindCandidates(candidates);
  return !candidates->empty() && Rank(*candidates) &&
         RefitTo(ModelOf((*candidates)[ranking_[0]]), left_weights_.data(), fit);
}

void SideFitter::Filter(LineModel* line) {
  if (mode_ == FeatureMode::kPaper && config_.filter_curvature()) {
    filters_.KeepFlat(static_cast<float>(config_.max_curvature_of_flat()), &inliers_);
  }
  if (config_.filter_runs()) {
    filters_.KeepOneRun(*line, static_cast<float>(config_.max_gap_m()), mode_, &inliers_);
  }
}

void SideFitter::Filter(CircleModel* circle) {
  const auto max_gap = static_cast<float>(config_.max_gap_m());
  if (mode_ == FeatureMode::kPaper) {
    filters_.KeepRound(
        *circle,
        config_.filter_curvature() ? static_cast<float>(config_.max_curvature_of_flat())
                                   : -kNoLimit,
        config_.filter_radius() ? static_cast<float>(config_.max_radius_difference_m()) : kNoLimit,
        &inliers_);
  }
  if (config_.filter_heights()) filters_.KeepOneHeight(max_gap, &inliers_);
  filters_.KeepArcs(max_gap, config_.filter_arcs() ? 2 : cells_->size(), circle, &inliers_);
  if (config_.filter_heights()) filters_.KeepOneRadius(*circle, kMaxRadiusStep, &inliers_);
}

bool SideFitter::IsPossible(const LineModel& line, float slack) const {
  // Within the reach of the features from its outlines a narrow face looks round.
  return mode_ == FeatureMode::kPaper || !config_.filter_curvature() ||
         line.length() <= kMinKappaLength ||
         IsMedianKappaBelow(slack * static_cast<float>(config_.max_kappa_of_flat()), inliers_);
}

bool SideFitter::IsPossible(const CircleModel& circle, float slack) const {
  const auto r = static_cast<double>(circle.r);
  if (r < config_.min_radius_m() / double{slack} || r > double{slack} * config_.max_radius_m()) {
    return false;
  }
  if (mode_ == FeatureMode::kPaper || !config_.filter_radius()) return true;
  const double min_kappa = config_.min_kappa_radius() / (r * double{slack});
  return !IsMedianKappaBelow(static_cast<float>(min_kappa), inliers_);
}

template <typename Model>
bool SideFitter::FindInliers(const float* weights, Model* model) {
  const auto min_points = static_cast<float>(config_.min_inliers());
  const CellView cells = OpenCells(weights);
  float* agreements = open_.field(CellArrays::kAgreement);
  num_tests_ += static_cast<int64_t>(cells.num);
  Agreements(cells, ShapeOf(*model), min_cos_, agreements);
  inliers_.CopyMarked(open_, agreements,
                      mode_ == FeatureMode::kPaper ? CellArrays::kNumPaperFieldsOfInlier
                                                   : CellArrays::kNumFieldsOfInlier);
  if (inliers_.NumPoints() < min_points) return false;
  Filter(model);
  return inliers_.NumPoints() >= min_points;
}

template <typename Model>
bool SideFitter::RefitTo(Model model, const float* weights, Fit<Model>* fit) {
  if (!FindInliers(weights, &model)) return false;
  SetExtent(inliers_, &model);
  if (!IsPossible(model, kSlackBeforeRefit)) return false;
  FitToInliers(inliers_, &model);
  if (!FindInliers(weights, &model)) return false;
  SetExtent(inliers_, &model);
  if (!IsPossible(model, 1)) return false;
  fit->model = model;
  fit->num_points = inliers_.NumPoints();
  fit->support = SumOfProducts(inliers_.field(CellArrays::kWeight),
                               inliers_.field(CellArrays::kAgreement), inliers_.size());
  fit->inliers.Clear(cells_->size());
  for (size_t i = 0; i < inliers_.size(); ++i) fit->inliers.Add(inliers_.IndexOf(i));
  return true;
}

bool SideFitter::FitLine(LineFit* fit) { return FitBest(&lines_, fit); }

bool SideFitter::FitCircle(CircleFit* fit) { return FitBest(&circles_, fit); }

bool SideFitter::Refit(const LineModel& model, LineFit* fit) {
  return RefitTo(model, open_.field(CellArrays::kWeight), fit);
}

bool SideFitter::Refit(const CircleModel& model, CircleFit* fit) {
  return RefitTo(model, open_.field(CellArrays::kWeight), fit);
}

}  // namespace declutter
