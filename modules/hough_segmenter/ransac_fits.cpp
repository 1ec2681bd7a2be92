#include "modules/hough_segmenter/ransac_fits.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "modules/hough_segmenter/inlier_filters.h"

namespace declutter {
namespace {

constexpr float kBucketSide = 0.05f;       // [m] squares in which the partner of a sample is drawn
constexpr size_t kMaxScoredCells = 400;    // cells that decide between samples
constexpr float kMinBaseline = 0.008f;     // [m] of the two cells of a sample
constexpr int kMaxDraws = 12;              // of a partner, before a sample is given up
constexpr float kMinKappaLength = 0.045f;  // [m] of a line whose curvature says something
constexpr float kMaxRadiusStep = 0.003f;   // [m] between the lower and upper part of a cylinder

LineModel LineThrough(const SideCell& a, const SideCell& b) {
  LineModel line;
  const Eigen::Vector2f t = (b.p - a.p).normalized();
  line.n = {t.y(), -t.x()};
  if (line.n.dot(a.n + b.n) < 0) line.n = -line.n;
  line.rho = 0.5f * line.n.dot(a.p + b.p);
  return line;
}

// Where the two normals meet, going inward. Nothing when they are almost parallel or meet outside.
std::optional<CircleModel> CircleThrough(const SideCell& a, const SideCell& b) {
  const float sine = a.n.x() * b.n.y() - a.n.y() * b.n.x();
  if (std::abs(sine) < 0.1f) return std::nullopt;
  const Eigen::Vector2f ab = b.p - a.p;
  // c = a.p - ra * a.n = b.p - rb * b.n
  const float ra = -(ab.x() * b.n.y() - ab.y() * b.n.x()) / sine;
  const float rb = -(ab.x() * a.n.y() - ab.y() * a.n.x()) / sine;
  if (ra <= 0 || rb <= 0) return std::nullopt;
  CircleModel circle;
  circle.r = 0.5f * (ra + rb);
  circle.c = 0.5f * (a.p - circle.r * a.n + b.p - circle.r * b.n);
  return circle;
}

template <typename Model>
void SetHeights(const std::vector<SideCell>& cells, Fit<Model>* fit) {
  fit->model.z_min = std::numeric_limits<float>::max();
  fit->model.z_max = std::numeric_limits<float>::lowest();
  for (int i : fit->inliers) {
    const float z = cells[static_cast<size_t>(i)].z;
    fit->model.z_min = std::min(fit->model.z_min, z);
    fit->model.z_max = std::max(fit->model.z_max, z);
  }
}

void SetExtent(const std::vector<SideCell>& cells, LineFit* fit) {
  const Eigen::Vector2f t = fit->model.tangent();
  fit->model.s_min = std::numeric_limits<float>::max();
  fit->model.s_max = std::numeric_limits<float>::lowest();
  for (int i : fit->inliers) {
    const float s = t.dot(cells[static_cast<size_t>(i)].p);
    fit->model.s_min = std::min(fit->model.s_min, s);
    fit->model.s_max = std::max(fit->model.s_max, s);
  }
  SetHeights(cells, fit);
}

// Total least squares through the inliers; the normal keeps its side.
void RefitModel(const std::vector<SideCell>& cells, const std::vector<int>& inliers,
                LineModel* line) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double total = 0;
  for (int i : inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    const double w = cell.weight / (cell.sigma * cell.sigma);
    mean += w * cell.p.cast<double>();
    total += w;
  }
  mean /= total;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (int i : inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    const Eigen::Vector2d q = cell.p.cast<double>() - mean;
    scatter += cell.weight / (cell.sigma * cell.sigma) * q * q.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  Eigen::Vector2f n = solver.eigenvectors().col(0).cast<float>();
  if (n.dot(line->n) < 0) n = -n;
  line->n = n;
  line->rho = n.dot(mean.cast<float>());
}

// Gauss-Newton on the distances to the circle.
void RefitModel(const std::vector<SideCell>& cells, const std::vector<int>& inliers,
                CircleModel* circle) {
  Eigen::Vector3d x(circle->c.x(), circle->c.y(), circle->r);
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity() * 1e-9;
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i : inliers) {
      const SideCell& cell = cells[static_cast<size_t>(i)];
      const double w = cell.weight / (cell.sigma * cell.sigma);
      const Eigen::Vector2d q = cell.p.cast<double>() - x.head<2>();
      const double distance = std::max(q.norm(), 1e-6);
      const Eigen::Vector3d J(-q.x() / distance, -q.y() / distance, -1.0);
      H += w * J * J.transpose();
      g += w * J * (distance - x.z());
    }
    x -= H.ldlt().solve(g);
  }
  if (!x.allFinite() || x.z() <= 0) return;
  circle->c = x.head<2>().cast<float>();
  circle->r = static_cast<float>(x.z());
}

}  // namespace

SideFitter::SideFitter(const HoughSegmenterConfig& config, FeatureMode mode,
                       const std::vector<SideCell>& cells, uint64_t seed)
    : config_(config),
      mode_(mode),
      cells_(cells),
      min_cos_(static_cast<float>(std::cos(config.max_normal_angle_rad()))),
      random_(seed) {
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
  if (subsample_.size() <= kMaxScoredCells) return;
  for (size_t i = 0; i < kMaxScoredCells; ++i) {
    std::swap(subsample_[i], subsample_[i + random_() % (subsample_.size() - i)]);
  }
  subsample_.resize(kMaxScoredCells);
}

std::optional<std::pair<int, int>> SideFitter::SamplePair(const std::vector<char>& is_free) {
  const int a = subsample_[random_() % subsample_.size()];
  const int bucket = bucket_of_cell_[static_cast<size_t>(a)];
  for (int draw = 0; draw < kMaxDraws; ++draw) {
    const int dx = static_cast<int>(random_() % 3) - 1;
    const int dy = static_cast<int>(random_() % 3) - 1;
    const int column = bucket % num_bucket_columns_ + dx;
    const int neighbour = bucket + dy * num_bucket_columns_ + dx;
    if (column < 0 || column >= num_bucket_columns_ || neighbour < 0 ||
        neighbour >= static_cast<int>(buckets_.size())) {
      continue;
    }
    const auto& candidates = buckets_[static_cast<size_t>(neighbour)];
    if (candidates.empty()) continue;
    const int b = candidates[random_() % candidates.size()];
    const float baseline =
        (cells_[static_cast<size_t>(a)].p - cells_[static_cast<size_t>(b)].p).norm();
    if (is_free[static_cast<size_t>(b)] && baseline > kMinBaseline) return std::pair(a, b);
  }
  return std::nullopt;
}

float SideFitter::Agreement(float distance_m, float cos_angle, float sigma) const {
  const float max_distance =
      std::max(static_cast<float>(config_.inlier_distance_m()), 2.5f * sigma);
  if (distance_m >= max_distance || cos_angle <= min_cos_) return 0;
  const float d = distance_m / max_distance;
  return (1 - d * d) * (cos_angle - min_cos_) / (1 - min_cos_);
}

float SideFitter::Agreement(const SideCell& cell, const LineModel& line) const {
  return Agreement(std::abs(line.n.dot(cell.p) - line.rho), line.n.dot(cell.n), cell.sigma);
}

float SideFitter::Agreement(const SideCell& cell, const CircleModel& circle) const {
  const Eigen::Vector2f q = cell.p - circle.c;
  const float distance = q.norm();
  if (distance < 1e-6f) return 0;
  return Agreement(std::abs(distance - circle.r), q.dot(cell.n) / distance, cell.sigma);
}

LineFit SideFitter::Inliers(const LineModel& line, const std::vector<char>& is_free) const {
  LineFit fit;
  fit.model = line;
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (is_free[i] && Agreement(cells_[i], line) > 0) fit.inliers.push_back(static_cast<int>(i));
  }
  if (mode_ == FeatureMode::kPaper) {
    KeepFlat(cells_, static_cast<float>(config_.max_curvature_of_flat()), &fit);
  }
  KeepOneRun(cells_, static_cast<float>(config_.max_gap_m()), mode_, &fit);
  fit.num_points = NumPoints(cells_, fit.inliers);
  return fit;
}

CircleFit SideFitter::Inliers(const CircleModel& circle, const std::vector<char>& is_free) const {
  CircleFit fit;
  fit.model = circle;
  for (size_t i = 0; i < cells_.size(); ++i) {
    if (is_free[i] && Agreement(cells_[i], circle) > 0) fit.inliers.push_back(static_cast<int>(i));
  }
  if (mode_ == FeatureMode::kPaper) {
    KeepRound(cells_, static_cast<float>(config_.max_curvature_of_flat()),
              static_cast<float>(config_.max_radius_difference_m()), &fit);
  }
  KeepArcsAtOneHeight(cells_, static_cast<float>(config_.max_gap_m()), &fit);
  KeepOneRadius(cells_, kMaxRadiusStep, &fit);
  fit.num_points = NumPoints(cells_, fit.inliers);
  return fit;
}

std::optional<LineFit> SideFitter::Refit(const LineModel& model,
                                         const std::vector<char>& is_free) const {
  const float min_points = static_cast<float>(config_.min_inliers());
  LineFit fit = Inliers(model, is_free);
  if (fit.num_points < min_points) return std::nullopt;
  RefitModel(cells_, fit.inliers, &fit.model);
  fit = Inliers(fit.model, is_free);
  if (fit.num_points < min_points) return std::nullopt;
  SetExtent(cells_, &fit);
  // Within the reach of the features from its outlines a narrow face looks round.
  if (mode_ == FeatureMode::kDefault && fit.model.length() > kMinKappaLength &&
      MedianKappa(cells_, fit.inliers) > config_.max_kappa_of_flat()) {
    return std::nullopt;
  }
  for (int i : fit.inliers) {
    const SideCell& cell = cells_[static_cast<size_t>(i)];
    fit.support += cell.weight * Agreement(cell, fit.model);
  }
  return fit;
}

std::optional<CircleFit> SideFitter::Refit(const CircleModel& model,
                                           const std::vector<char>& is_free) const {
  const float min_points = static_cast<float>(config_.min_inliers());
  CircleFit fit = Inliers(model, is_free);
  if (fit.num_points < min_points) return std::nullopt;
  RefitModel(cells_, fit.inliers, &fit.model);
  if (fit.model.r < config_.min_radius_m() || fit.model.r > config_.max_radius_m()) {
    return std::nullopt;
  }
  fit = Inliers(fit.model, is_free);
  if (fit.num_points < min_points) return std::nullopt;
  // kappa underestimates 1 / r near outlines, by up to a factor of two at the median.
  if (mode_ == FeatureMode::kDefault &&
      MedianKappa(cells_, fit.inliers) * fit.model.r < config_.min_kappa_radius()) {
    return std::nullopt;
  }
  SetHeights(cells_, &fit);
  for (int i : fit.inliers) {
    const SideCell& cell = cells_[static_cast<size_t>(i)];
    fit.support += cell.weight * Agreement(cell, fit.model);
  }
  return fit;
}

std::optional<LineFit> SideFitter::FitLine(const std::vector<char>& is_free) {
  Subsample(is_free);
  if (subsample_.empty()) return std::nullopt;
  LineModel best;
  float best_score = 0;
  for (int sample = 0; sample < config_.num_samples(); ++sample) {
    const auto pair = SamplePair(is_free);
    if (!pair) continue;
    const SideCell& a = cells_[static_cast<size_t>(pair->first)];
    const LineModel line = LineThrough(a, cells_[static_cast<size_t>(pair->second)]);
    if (Agreement(a, line) == 0) continue;
    float score = 0;
    for (int i : subsample_) {
      const SideCell& cell = cells_[static_cast<size_t>(i)];
      score += cell.weight * Agreement(cell, line);
    }
    if (score > best_score) {
      best_score = score;
      best = line;
    }
  }
  if (best_score == 0) return std::nullopt;
  return Refit(best, is_free);
}

std::optional<CircleFit> SideFitter::FitCircle(const std::vector<char>& is_free) {
  Subsample(is_free);
  if (subsample_.empty()) return std::nullopt;
  CircleModel best;
  float best_score = 0;
  for (int sample = 0; sample < config_.num_samples(); ++sample) {
    const auto pair = SamplePair(is_free);
    if (!pair) continue;
    const SideCell& a = cells_[static_cast<size_t>(pair->first)];
    const auto circle = CircleThrough(a, cells_[static_cast<size_t>(pair->second)]);
    if (!circle || circle->r < config_.min_radius_m() || circle->r > config_.max_radius_m()) {
      continue;
    }
    float score = 0;
    for (int i : subsample_) {
      const SideCell& cell = cells_[static_cast<size_t>(i)];
      score += cell.weight * Agreement(cell, *circle);
    }
    if (score > best_score) {
      best_score = score;
      best = *circle;
    }
  }
  if (best_score == 0) return std::nullopt;
  return Refit(best, is_free);
}

}  // namespace declutter
