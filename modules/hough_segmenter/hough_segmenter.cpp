#include "modules/hough_segmenter/hough_segmenter.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

namespace declutter {
namespace {

constexpr float kMaxTopStep = 0.006f;  // [m] between neighbouring pixels of one top face
constexpr int kMinTopPixels = 60;      // [px] of a top face

// An independent stream of random numbers for each component of each frame.
uint64_t ComponentSeed(uint64_t seed, int64_t utime, int component) {
  uint64_t x = seed * 0x9E3779B97F4A7C15ull + static_cast<uint64_t>(utime);
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull + static_cast<uint64_t>(component);
  return x ^ (x >> 27);
}

// True when two hypotheses in T differ by less than the verifier's refinement moves them.
bool AreAlike(const Hypothesis& a, const Hypothesis& b) {
  constexpr double kMaxShift = 0.002;    // [m] of the centre
  constexpr double kMaxGrowth = 0.004;   // [m] of an extent
  constexpr double kMinCosine = 0.9986;  // of the axes: 3 degrees
  if (a.solid.shape != b.solid.shape || a.evidence != b.evidence ||
      (a.solid.X_CO.translation() - b.solid.X_CO.translation()).cwiseAbs().maxCoeff() > kMaxShift) {
    return false;
  }
  const Eigen::Matrix3d axes =
      (a.solid.X_CO.linear().transpose() * b.solid.X_CO.linear()).cwiseAbs();
  if (a.solid.shape == Shape::kCylinder) {
    return axes(2, 2) > kMinCosine &&
           (a.solid.size - b.solid.size).cwiseAbs().maxCoeff() < kMaxGrowth;
  }
  // The same box may have x and y the other way round.
  const bool is_turned = axes(0, 1) > axes(0, 0);
  const Eigen::Vector3d size(is_turned ? b.solid.size.y() : b.solid.size.x(),
                             is_turned ? b.solid.size.x() : b.solid.size.y(), b.solid.size.z());
  return std::max(axes(0, 0), axes(0, 1)) > kMinCosine &&
         (a.solid.size - size).cwiseAbs().maxCoeff() < kMaxGrowth;
}

// The tabletop at the pixels that have features: of many points, the message of the features may
// leave out more than that of the tabletop.
Tabletop AtFeatures(Tabletop tabletop, const FeatureCloud& features) {
  tabletop.thinning = features.thinning;
  return tabletop;
}

}  // namespace

HoughSegmenter::HoughSegmenter(const HoughSegmenterConfig& config, SideDetector detect)
    : config_(config), detect_(detect), side_search_(config), completion_(config), lying_(config) {}

void HoughSegmenter::FindSides(const FeatureCloud& features, int num_pixels) {
  const ReusedList<std::vector<SideCell>>& cells =
      cells_.Gather(points_, features.num_components, static_cast<float>(config_.cell_side_m()),
                    static_cast<float>(config_.cell_height_m()), num_pixels);
  size_t num_cells = 0;
  for (const auto& component : cells) num_cells += component.size();
  detections_.Clear();
  int64_t num_tests_left = config_.max_cell_tests();
  int num_cut_short = 0;
  for (size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].empty()) continue;
    // Its share of what is left, by its cells.
    const double share = static_cast<double>(cells[c].size()) / static_cast<double>(num_cells);
    const auto component = static_cast<int>(c);
    SideFitter& fitter = side_search_.fitter;
    fitter.Assign(features.mode, cells[c],
                  ComponentSeed(config_.seed(), features.header.utime, component),
                  static_cast<int64_t>(share * static_cast<double>(num_tests_left)));
    detect_(component, &side_search_, &detections_);
    num_cut_short += fitter.is_spent();
    num_tests_left = std::max(int64_t{0}, num_tests_left - fitter.num_tests());
    num_cells -= cells[c].size();
  }
  if (num_cut_short > 0) {
    shortfall_ += "voting was cut short in " + std::to_string(num_cut_short) + " of " +
                  std::to_string(cells.size()) + " components (max_cell_tests " +
                  std::to_string(config_.max_cell_tests()) + ")";
  }
}

std::vector<Hypothesis> HoughSegmenter::BestProposals() {
  ranking_.resize(proposals_.size());
  std::iota(ranking_.begin(), ranking_.end(), size_t{0});
  std::sort(ranking_.begin(), ranking_.end(), [this](size_t i, size_t j) {
    const int32_t a = proposals_[i].num_inliers, b = proposals_[j].num_inliers;
    return a != b ? a > b : i < j;
  });
  // The first of those alike.
  auto end = ranking_.begin();
  for (const size_t i : ranking_) {
    const auto is_alike = [&](size_t j) { return AreAlike(proposals_[i], proposals_[j]); };
    if (std::none_of(ranking_.begin(), end, is_alike)) *end++ = i;
  }
  ranking_.erase(end, ranking_.end());
  const auto max_num = static_cast<size_t>(config_.max_hypotheses());
  if (ranking_.size() > max_num) {
    if (!shortfall_.empty()) shortfall_ += "; ";
    shortfall_ += std::to_string(ranking_.size() - max_num) +
                  " solids were left out (max_hypotheses " + std::to_string(max_num) + ")";
    ranking_.resize(max_num);
  }
  std::vector<Hypothesis> best;
  best.reserve(ranking_.size());
  for (const size_t i : ranking_) best.push_back(proposals_[i]);
  return best;
}

HypothesisList HoughSegmenter::Segment(const Tabletop& tabletop, const FeatureCloud& features) {
  shortfall_.clear();
  if (features.thinning > tabletop.thinning) {
    return Segment(AtFeatures(tabletop, features), features);
  }
  HypothesisList list;
  list.header = features.header;
  list.mode = features.mode;
  list.planes.reserve(tabletop.planes.size());
  for (const SupportPlane& support : tabletop.planes) list.planes.push_back(support.plane);
  if (list.planes.empty() || features.points.empty()) return list;

  const Eigen::Isometry3d X_TC = TableFrame(list.planes[0]);
  FindTablePoints(tabletop, features, X_TC, &points_);
  const int num_pixels = tabletop.thinning * tabletop.thinning;  // that a point stands for
  FindSides(features, num_pixels);
  const TopPatches& tops =
      tops_.Find(points_, tabletop, X_TC, kMaxTopStep, kMinTopPixels / num_pixels);
  sides_.Assign(points_, [](const TablePoint& point) { return point.is_side(); });
  completion_.MeasureExtents(sides_, &detections_);

  proposals_.clear();
  completion_.CompleteBoxes(detections_.faces, tops, &proposals_);
  completion_.CompleteCylinders(detections_.arcs, tops, &proposals_);
  completion_.AddSidesBelowTops(sides_, &proposals_);
  if (list.mode == FeatureMode::kDefault) {
    slants_.Assign(points_, [](const TablePoint& point) { return point.is_slanted(); });
    lying_.Find(points_, slants_, tops, &cells_, &proposals_);
  }
  list.hypotheses = BestProposals();
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  for (Hypothesis& hypothesis : list.hypotheses) {
    hypothesis.solid.X_CO = X_CT * hypothesis.solid.X_CO;
  }
  return list;
}

}  // namespace declutter
