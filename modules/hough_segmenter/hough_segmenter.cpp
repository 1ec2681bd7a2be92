#include "modules/hough_segmenter/hough_segmenter.h"

#include <algorithm>
#include <cstdint>
#include <string>

#include "modules/hough_segmenter/lying_cylinders.h"
#include "modules/hough_segmenter/solid_completion.h"

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

// Keeps the first of hypotheses that are alike.
void DropAlike(std::vector<Hypothesis>* hypotheses) {
  std::vector<Hypothesis> kept;
  for (const Hypothesis& hypothesis : *hypotheses) {
    const auto is_alike = [&](const Hypothesis& other) { return AreAlike(hypothesis, other); };
    if (std::none_of(kept.begin(), kept.end(), is_alike)) kept.push_back(hypothesis);
  }
  *hypotheses = std::move(kept);
}

// The tabletop at the pixels that have features: of many points, the message of the features may
// leave out more than that of the tabletop.
Tabletop AtFeatures(Tabletop tabletop, const FeatureCloud& features) {
  tabletop.thinning = features.thinning;
  return tabletop;
}

}  // namespace

HoughSegmenter::HoughSegmenter(const HoughSegmenterConfig& config, SideDetector detect)
    : config_(config),
      detect_(detect),
      side_search_(config),
      section_search_(SectionConfig(config)),
      completion_(config) {}

void HoughSegmenter::FindSides(const FeatureCloud& features, int num_pixels) {
  const std::vector<std::vector<SideCell>>& cells =
      cells_.Gather(points_, features.num_components, static_cast<float>(config_.cell_side_m()),
                    static_cast<float>(config_.cell_height_m()), num_pixels);
  size_t num_cells = 0;
  for (const auto& component : cells) num_cells += component.size();
  detections_.faces.clear();
  detections_.arcs.clear();
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

void HoughSegmenter::KeepBest(std::vector<Hypothesis>* hypotheses) {
  std::stable_sort(
      hypotheses->begin(), hypotheses->end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.num_inliers > b.num_inliers; });
  DropAlike(hypotheses);
  const auto max_num = static_cast<size_t>(config_.max_hypotheses());
  if (hypotheses->size() <= max_num) return;
  if (!shortfall_.empty()) shortfall_ += "; ";
  shortfall_ += std::to_string(hypotheses->size() - max_num) +
                " solids were left out (max_hypotheses " + std::to_string(max_num) + ")";
  hypotheses->resize(max_num);
}

HypothesisList HoughSegmenter::Segment(const Tabletop& tabletop, const FeatureCloud& features) {
  shortfall_.clear();
  if (features.thinning > tabletop.thinning) {
    return Segment(AtFeatures(tabletop, features), features);
  }
  HypothesisList list;
  list.header = features.header;
  list.mode = features.mode;
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

  completion_.CompleteBoxes(detections_.faces, tops, &list.hypotheses);
  completion_.CompleteCylinders(detections_.arcs, tops, &list.hypotheses);
  completion_.AddSidesBelowTops(sides_, &list.hypotheses);
  if (list.mode == FeatureMode::kDefault) {
    slants_.Assign(points_, [](const TablePoint& point) { return point.is_slanted(); });
    const std::vector<Hypothesis> lying =
        FindLyingCylinders(config_, points_, slants_, tops, &cells_, &section_search_);
    list.hypotheses.insert(list.hypotheses.end(), lying.begin(), lying.end());
  }
  KeepBest(&list.hypotheses);
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  for (Hypothesis& hypothesis : list.hypotheses) {
    hypothesis.solid.X_CO = X_CT * hypothesis.solid.X_CO;
  }
  return list;
}

}  // namespace declutter
