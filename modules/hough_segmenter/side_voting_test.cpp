#include "modules/hough_segmenter/side_voting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "modules/hough_segmenter/inlier_filters.h"
#include "modules/hough_segmenter/parameter_space.h"

namespace declutter {
namespace {

using Eigen::Vector2f;
using testing::Each;
using testing::Ge;
using testing::IsEmpty;
using testing::SizeIs;

constexpr float kPi = static_cast<float>(M_PI);

SideCell Cell(const Vector2f& p, const Vector2f& n, float z, float kappa) {
  SideCell cell;
  cell.p = p;
  cell.n = n;
  cell.z = z;
  cell.kappa = kappa;
  cell.sigma = 0.001f;
  cell.weight = 4;
  return cell;
}

// A face from (x0, y) to (x1, y) that looks toward -y, 80 mm high.
void AddFace(float x0, float x1, float y, std::vector<SideCell>* cells) {
  for (float x = x0; x <= x1; x += 0.004f) {
    for (float z = 0.01f; z < 0.08f; z += 0.016f) {
      cells->push_back(Cell({x, y}, {0, -1}, z, 0));
    }
  }
}

// The half of a cylinder that looks toward -y, from z0 up.
void AddArc(const Vector2f& c, float r, float z0, std::vector<SideCell>* cells) {
  for (float angle = -kPi; angle < 0; angle += 0.004f / r) {
    const Vector2f n(std::cos(angle), std::sin(angle));
    for (float z = z0; z < z0 + 0.07f; z += 0.016f) {
      cells->push_back(Cell(c + r * n, n, z, 0.8f / r));
    }
  }
}

void AddNoise(float sigma, std::vector<SideCell>* cells) {
  std::mt19937 random(7);
  std::normal_distribution<float> noise(0, sigma);
  for (SideCell& cell : *cells) cell.p += Vector2f(noise(random), noise(random));
}

std::vector<int> AllOf(const std::vector<SideCell>& cells) {
  std::vector<int> indices;
  for (size_t i = 0; i < cells.size(); ++i) indices.push_back(static_cast<int>(i));
  return indices;
}

TEST(SideVoting, FindsAFaceAndACylinderThatTouch) {
  std::vector<SideCell> cells;
  AddFace(-0.10f, 0.05f, 0.7f, &cells);
  AddArc({0.09f, 0.72f}, 0.04f, 0.01f, &cells);
  AddNoise(0.0007f, &cells);
  SideDetections found;
  DetectSides(HoughSegmenterConfig(), FeatureMode::kDefault, cells, 3, 1, &found);
  ASSERT_THAT(found.faces, SizeIs(1));
  ASSERT_THAT(found.arcs, SizeIs(1));
  EXPECT_NEAR(found.faces[0].model.n.y(), -1, 0.001);
  EXPECT_NEAR(found.faces[0].model.rho, -0.7, 0.001);
  EXPECT_NEAR(found.faces[0].model.length(), 0.15, 0.006);
  EXPECT_NEAR(found.arcs[0].model.r, 0.04, 0.001);
  EXPECT_NEAR((found.arcs[0].model.c - Vector2f(0.09f, 0.72f)).norm(), 0, 0.001);
  EXPECT_EQ(found.arcs[0].component, 3);
}

TEST(SideVoting, SeedsChangeTheVotesButNotTheModels) {
  std::vector<SideCell> cells;
  AddFace(-0.10f, 0.05f, 0.7f, &cells);
  AddFace(0.055f, 0.12f, 0.73f, &cells);
  AddArc({-0.15f, 0.72f}, 0.035f, 0.01f, &cells);
  AddNoise(0.001f, &cells);
  const std::vector<char> is_free(cells.size(), 1);
  std::vector<float> first_votes;
  std::vector<float> radii;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    const HoughSegmenterConfig config;
    HoughSegmenterConfig one_sample;
    one_sample.set_num_samples(1);
    SideFitter fitter(one_sample, FeatureMode::kDefault, cells, seed);
    const auto vote = fitter.FitLine(is_free);
    first_votes.push_back(vote ? vote->support : 0);
    SideDetections found;
    DetectSides(config, FeatureMode::kDefault, cells, 0, seed, &found);
    EXPECT_THAT(found.faces, SizeIs(2)) << "seed " << seed;
    ASSERT_THAT(found.arcs, SizeIs(1)) << "seed " << seed;
    radii.push_back(found.arcs[0].model.r);
  }
  EXPECT_NE(*std::min_element(first_votes.begin(), first_votes.end()),
            *std::max_element(first_votes.begin(), first_votes.end()));
  EXPECT_NEAR(*std::min_element(radii.begin(), radii.end()),
              *std::max_element(radii.begin(), radii.end()), 1e-4);
}

TEST(SideVoting, TellsACanFromTheWiderCanBelow) {
  std::vector<SideCell> cells;
  AddArc({0, 0.7f}, 0.047f, 0.01f, &cells);
  AddArc({0.002f, 0.7f}, 0.041f, 0.08f, &cells);
  AddNoise(0.0007f, &cells);
  SideDetections found;
  DetectSides(HoughSegmenterConfig(), FeatureMode::kDefault, cells, 0, 1, &found);
  ASSERT_THAT(found.arcs, SizeIs(2));
  const auto [narrow, wide] = std::minmax(found.arcs[0].model.r, found.arcs[1].model.r);
  EXPECT_NEAR(narrow, 0.041, 0.001);
  EXPECT_NEAR(wide, 0.047, 0.001);
}

TEST(SideVoting, FindsNothingInFewerPointsThanN) {
  std::vector<SideCell> cells;
  AddFace(0, 0.010f, 0.7f, &cells);
  ASSERT_LT(NumPoints(cells, AllOf(cells)), 100);
  SideDetections found;
  DetectSides(HoughSegmenterConfig(), FeatureMode::kDefault, cells, 0, 1, &found);
  DetectSides(HoughSegmenterConfig(), FeatureMode::kDefault, {}, 0, 1, &found);
  EXPECT_THAT(found.faces, IsEmpty());
  EXPECT_THAT(found.arcs, IsEmpty());
}

TEST(InlierFilters, KeepsTheHeavierRunOfALineAndRejectsTwoInPaperMode) {
  std::vector<SideCell> cells;
  AddFace(0, 0.05f, 0.7f, &cells);
  AddFace(0.09f, 0.20f, 0.7f, &cells);
  LineFit fit;
  fit.model.n = {0, -1};
  fit.inliers = AllOf(cells);
  LineFit paper = fit;
  KeepOneRun(cells, 0.015f, FeatureMode::kDefault, &fit);
  KeepOneRun(cells, 0.015f, FeatureMode::kPaper, &paper);
  std::vector<float> x;
  for (int i : fit.inliers) x.push_back(cells[static_cast<size_t>(i)].p.x());
  EXPECT_THAT(x, Each(Ge(0.09f)));
  EXPECT_THAT(x, testing::Not(IsEmpty()));
  EXPECT_THAT(paper.inliers, IsEmpty());
}

TEST(InlierFilters, DropsArcsOfAnotherHeight) {
  std::vector<SideCell> cells;
  AddArc({0, 0.7f}, 0.04f, 0.01f, &cells);
  const size_t num_below = cells.size();
  AddArc({0, 0.7f}, 0.04f, 0.20f, &cells);
  cells.resize(num_below + num_below / 2);
  CircleFit fit;
  fit.model.c = {0, 0.7f};
  fit.model.r = 0.04f;
  fit.inliers = AllOf(cells);
  KeepOneHeight(cells, 0.015f, &fit);
  KeepArcs(cells, 0.015f, 2, &fit);
  EXPECT_THAT(fit.inliers, SizeIs(num_below));
  EXPECT_NEAR(fit.model.arc, M_PI, 0.2);
}

TEST(InlierFilters, PaperModeDividesFlatFromRoundByCurvatureAndRadius) {
  std::vector<SideCell> cells(4, Cell({0.04f, 0}, {1, 0}, 0.05f, 0));
  cells[0].curvature = 0.005f;  // flat
  cells[1].curvature = 0.020f;  // round, of another radius
  cells[1].r_min = 0.07f;
  cells[2].curvature = 0.020f;  // round, of this radius
  cells[2].r_min = 0.05f;
  cells[3].curvature = 0.009f;  // flat
  LineFit line;
  line.inliers = AllOf(cells);
  KeepFlat(cells, 0.010f, &line);
  CircleFit circle;
  circle.model.r = 0.04f;
  circle.inliers = AllOf(cells);
  KeepRound(cells, 0.010f, 0.020f, &circle);
  EXPECT_THAT(line.inliers, testing::ElementsAre(0, 3));
  EXPECT_THAT(circle.inliers, testing::ElementsAre(2));
}

// Points that a model keeps with all filters and without one of them, in default mode.
template <typename Model>
std::pair<float, float> NumKept(const std::vector<SideCell>& cells, const Model& model,
                                void (HoughSegmenterConfig::*set_filter)(bool)) {
  const std::vector<char> is_free(cells.size(), 1);
  HoughSegmenterConfig config;
  const auto num_kept = [&] {
    const auto fit = SideFitter(config, FeatureMode::kDefault, cells, 1).Refit(model, is_free);
    return fit ? fit->num_points : 0;
  };
  const float with = num_kept();
  (config.*set_filter)(false);
  return {with, num_kept()};
}

TEST(InlierFilters, OfALineCanBeSwitchedOffOneByOne) {
  LineModel line;
  line.n = {0, -1};
  line.rho = -0.7f;
  std::vector<SideCell> cells;
  AddFace(0, 0.05f, 0.7f, &cells);
  AddFace(0.09f, 0.20f, 0.7f, &cells);
  const float num_all = NumPoints(cells, AllOf(cells));
  const auto runs = NumKept(cells, line, &HoughSegmenterConfig::set_filter_runs);
  EXPECT_THAT(runs, testing::Pair(testing::AllOf(testing::Gt(0), testing::Lt(num_all)), num_all));
  cells.clear();
  AddFace(0, 0.20f, 0.7f, &cells);
  const float num_face = NumPoints(cells, AllOf(cells));
  for (SideCell& cell : cells) cell.n = {1, 0};
  EXPECT_THAT(NumKept(cells, line, &HoughSegmenterConfig::set_filter_normals),
              testing::Pair(0, num_face));
  for (SideCell& cell : cells) cell.n = {0, -1};
  for (SideCell& cell : cells) cell.kappa = 20;
  EXPECT_THAT(NumKept(cells, line, &HoughSegmenterConfig::set_filter_curvature),
              testing::Pair(0, num_face));
}

TEST(InlierFilters, OfACircleCanBeSwitchedOffOneByOne) {
  CircleModel circle;
  circle.c = {0, 0.7f};
  circle.r = 0.1f;
  std::vector<SideCell> half;
  AddArc(circle.c, circle.r, 0.01f, &half);
  std::vector<SideCell> cells;  // three parts of it
  for (const SideCell& cell : half) {
    const float x = std::abs(cell.p.x());
    if (x < 0.02f || x > 0.07f) cells.push_back(cell);
  }
  const float num_all = NumPoints(cells, AllOf(cells));
  EXPECT_THAT(NumKept(cells, circle, &HoughSegmenterConfig::set_filter_arcs),
              testing::Pair(testing::AllOf(testing::Gt(0), testing::Lt(num_all)), num_all));
  cells = half;
  AddArc(circle.c, circle.r, 0.20f, &cells);
  const float num_both = NumPoints(cells, AllOf(cells));
  EXPECT_THAT(NumKept(cells, circle, &HoughSegmenterConfig::set_filter_heights),
              testing::Pair(testing::FloatEq(0.5f * num_both), num_both));
  for (SideCell& cell : half) cell.kappa = 0;
  EXPECT_THAT(NumKept(half, circle, &HoughSegmenterConfig::set_filter_radius),
              testing::Pair(0, NumPoints(half, AllOf(half))));
}

TEST(ParameterSpace, PeakIsTheDensestPlaceNotTheStrongestVote) {
  ParameterSpace<CircleModel> space;
  const auto vote = [](float x, float support) {
    CircleFit fit;
    fit.model.c = {x, 0.7f};
    fit.model.r = 0.04f;
    fit.support = support;
    return fit;
  };
  space.Add(vote(0.100f, 500));
  for (float x : {0.000f, 0.002f, 0.004f}) space.Add(vote(x, 300));
  const auto peak = space.HighestPeak();
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->num_votes, 3);
  EXPECT_NEAR(peak->model.c.x(), 0.002, 1e-5);
  EXPECT_FLOAT_EQ(peak->density, 900);
  space.Remove(peak->strongest);
  ASSERT_TRUE(space.HighestPeak());
  EXPECT_EQ(space.HighestPeak()->num_votes, 1);
}

}  // namespace
}  // namespace declutter
