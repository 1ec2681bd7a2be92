#include "modules/hough_segmenter/hough_segmenter.h"

#include <algorithm>

#include "modules/hough_segmenter/lying_cylinders.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kMaxTopStep = 0.006f;  // [m] between neighbouring pixels of one top face
constexpr int kMinTopPoints = 60;      // [px] of a top face

// An independent stream of random numbers for each component of each frame.
uint64_t ComponentSeed(uint64_t seed, int64_t utime, int component) {
  uint64_t x = seed * 0x9E3779B97F4A7C15ull + static_cast<uint64_t>(utime);
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull + static_cast<uint64_t>(component);
  return x ^ (x >> 27);
}

}  // namespace

HoughSegmenter::HoughSegmenter(const HoughSegmenterConfig& config, SideDetector detect)
    : config_(config), detect_(detect) {}

HypothesisList HoughSegmenter::Segment(const Tabletop& tabletop,
                                       const FeatureCloud& features) const {
  HypothesisList list;
  list.header = features.header;
  list.mode = features.mode;
  for (const SupportPlane& support : tabletop.planes) list.planes.push_back(support.plane);
  if (list.planes.empty() || features.points.empty()) return list;

  const Eigen::Isometry3d X_TC = TableFrame(list.planes[0]);
  const std::vector<TablePoint> points = TablePoints(tabletop, features, X_TC);
  const std::vector<std::vector<SideCell>> cells =
      SideCells(points, features.num_components, static_cast<float>(config_.cell_side_m()),
                static_cast<float>(config_.cell_height_m()));
  SideDetections sides;
  for (int c = 0; c < features.num_components; ++c) {
    detect_(config_, list.mode, cells[static_cast<size_t>(c)], c,
            ComponentSeed(config_.seed(), features.header.utime, c), &sides);
  }
  Surfaces surfaces{std::move(sides.faces), std::move(sides.arcs),
                    FindTopPatches(points, tabletop, X_TC, kMaxTopStep, kMinTopPoints)};
  MeasureExtents(points, &surfaces);

  const auto propose = [&list](const std::vector<Hypothesis>& hypotheses) {
    list.hypotheses.insert(list.hypotheses.end(), hypotheses.begin(), hypotheses.end());
  };
  propose(CompleteBoxes(config_, surfaces));
  propose(CompleteCylinders(config_, surfaces));
  AddSidesBelowTops(points, &list.hypotheses);
  if (list.mode == FeatureMode::kDefault) {
    propose(FindLyingCylinders(config_, points, surfaces.tops, config_.seed()));
  }
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  for (Hypothesis& hypothesis : list.hypotheses) {
    hypothesis.solid.X_CO = X_CT * hypothesis.solid.X_CO;
  }
  std::stable_sort(
      list.hypotheses.begin(), list.hypotheses.end(),
      [](const Hypothesis& a, const Hypothesis& b) { return a.num_inliers > b.num_inliers; });
  return list;
}

}  // namespace declutter
