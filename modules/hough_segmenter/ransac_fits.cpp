#include "modules/hough_segmenter/ransac_fits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace declutter {
namespace {

constexpr size_t kMaxScoredCells = 400;    // cells that decide between samples
constexpr size_t kFirstScoredCells = 96;   // cells that decide which samples are scored on all
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
                                                          : kMinCosUnfiltered)) {}

void SideFitter::Assign(FeatureMode mode, const std::vector<SideCell>& cells, uint64_t seed) {
  mode_ = mode;
  cells_ = &cells;
  random_ = RandomIndex(seed);
  order_.resize(cells.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  open_.Resize(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) {
    std::swap(order_[i], order_[i + random_(cells.size() - i)]);
    open_.Set(i, cells[order_[i]], order_[i], static_cast<float>(config_.inlier_distance_m()));
  }
  buckets_.Assign(cells);
  Restart();
}

void SideFitter::Restart() {
  left_.Copy(open_);
  buckets_.Restore();
}

void SideFitter::Drop(const CellSet& set, CellArrays* arrays) {
  marks_.resize(arrays->size() + kCellBlock);
  for (size_t i = 0; i < arrays->size(); ++i) {
    marks_[i] = set.Contains(arrays->IndexOf(i)) ? 0.0f : 1.0f;
  }
  arrays->KeepMarked(marks_);
}

void SideFitter::Take(const CellSet& inliers) {
  Drop(inliers, &left_);
  inliers.ForEach([this](size_t i) { buckets_.Remove(i); });
}

void SideFitter::Explain(const CellSet& cells) {
  Drop(cells, &open_);
  buckets_.Restore();
  cells.ForEach([this](size_t i) { buckets_.Remove(i); });
  buckets_.Keep();
}

std::optional<LineModel> SideFitter::ModelThrough(size_t a, size_t b, const LineModel*) const {
  const SideCell& cell_a = (*cells_)[a];
  const SideCell& cell_b = (*cells_)[b];
  const LineModel line = LineThrough(cell_a, cell_b);
  if (line.n.dot(cell_a.n) <= min_cos_ || line.n.dot(cell_b.n) <= min_cos_) return std::nullopt;
  return line;
}

std::optional<CircleModel> SideFitter::ModelThrough(size_t a, size_t b, const CircleModel*) const {
  const SideCell& cell_a = (*cells_)[a];
  const SideCell& cell_b = (*cells_)[b];
  const auto circle = CircleThrough(cell_a, cell_b);
  if (!circle || circle->r < config_.min_radius_m() || circle->r > config_.max_radius_m()) {
    return std::nullopt;
  }
  const auto distance = static_cast<float>(config_.inlier_distance_m());
  for (const SideCell* cell : {&cell_a, &cell_b}) {
    const float offset = (cell->p - circle->c).norm() - circle->r;
    if (std::abs(offset) > InlierLimit(*cell, distance)) return std::nullopt;
  }
  return circle;
}

template <typename Model>
void SideFitter::DrawCandidates(std::vector<Candidate<Model>>* candidates) {
  candidates->clear();
  for (int i = 0; i < config_.num_samples(); ++i) {
    const size_t a = left_.IndexOf(random_(left_.size()));
    for (int draw = 0; draw < kMaxDraws; ++draw) {
      const auto b = buckets_.DrawNear(a, &random_);
      if (!b || ((*cells_)[a].p - (*cells_)[*b].p).norm() <= kMinBaseline) continue;
      const auto model = ModelThrough(a, *b, static_cast<const Model*>(nullptr));
      if (model) candidates->push_back({*model});
      break;
    }
  }
}

template <typename Model>
bool SideFitter::FitBest(std::vector<Candidate<Model>>* candidates, Fit<Model>* fit) {
  if (left_.NumPoints() < static_cast<float>(config_.min_inliers())) return false;
  DrawCandidates(candidates);
  if (candidates->empty()) return false;
  const size_t num_scored = std::min(left_.size(), kMaxScoredCells);
  const size_t begin = random_(left_.size() - num_scored + 1);
  const size_t num_first = std::min(num_scored, kFirstScoredCells);
  const auto is_better = [](const auto& x, const auto& y) { return x.score > y.score; };
  const CellView first = left_.view().Part(begin, num_first);
  for (auto& candidate : *candidates) {
    candidate.score = SampleSupport(first, ShapeOf(candidate.model), min_cos_);
  }
  if (num_scored > num_first) {
    std::stable_sort(candidates->begin(), candidates->end(), is_better);
    candidates->resize(
        std::min(candidates->size(), std::max(kMinFinalists, candidates->size() / 4)));
    const CellView rest = left_.view().Part(begin + num_first, num_scored - num_first);
    for (auto& candidate : *candidates) {
      candidate.score += SampleSupport(rest, ShapeOf(candidate.model), min_cos_);
    }
  }
  // The first of the best ones.
  const auto best = std::min_element(candidates->begin(), candidates->end(), is_better);
  return best->score > 0 && RefitTo(best->model, left_, fit);
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
bool SideFitter::FindInliers(const CellArrays& among, Model* model) {
  const auto min_points = static_cast<float>(config_.min_inliers());
  marks_.resize(among.size() + kCellBlock);
  Agreements(among.view(), ShapeOf(*model), min_cos_, marks_.data());
  inliers_.CopyMarked(among, marks_);
  if (inliers_.NumPoints() < min_points) return false;
  Filter(model);
  return inliers_.NumPoints() >= min_points;
}

template <typename Model>
bool SideFitter::RefitTo(Model model, const CellArrays& among, Fit<Model>* fit) {
  if (!FindInliers(among, &model)) return false;
  SetExtent(inliers_, &model);
  if (!IsPossible(model, kSlackBeforeRefit)) return false;
  FitToInliers(inliers_, &model);
  if (!FindInliers(among, &model)) return false;
  SetExtent(inliers_, &model);
  if (!IsPossible(model, 1)) return false;
  fit->model = model;
  fit->num_points = inliers_.NumPoints();
  fit->support = Support(inliers_.view(), ShapeOf(model), min_cos_);
  fit->inliers.Clear(cells_->size());
  for (size_t i = 0; i < inliers_.size(); ++i) fit->inliers.Add(inliers_.IndexOf(i));
  return true;
}

bool SideFitter::FitLine(LineFit* fit) { return FitBest(&lines_, fit); }

bool SideFitter::FitCircle(CircleFit* fit) { return FitBest(&circles_, fit); }

bool SideFitter::Refit(const LineModel& model, LineFit* fit) { return RefitTo(model, open_, fit); }

bool SideFitter::Refit(const CircleModel& model, CircleFit* fit) {
  return RefitTo(model, open_, fit);
}

}  // namespace declutter
