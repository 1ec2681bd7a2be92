#include "modules/hough_segmenter/side_voting.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <set>

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

CellArrays AllOf(const std::vector<SideCell>& cells) {
  CellArrays arrays;
  arrays.Resize(cells.size());
  for (size_t i = 0; i < cells.size(); ++i) arrays.Set(i, cells[i], i, 0.004f);
  return arrays;
}

std::vector<size_t> IndicesOf(const CellArrays& arrays) {
  std::vector<size_t> indices;
  for (size_t i = 0; i < arrays.size(); ++i) indices.push_back(arrays.IndexOf(i));
  return indices;
}

SideDetections Detect(const std::vector<SideCell>& cells, int component, uint64_t seed,
                      int64_t max_tests = std::numeric_limits<int64_t>::max()) {
  SideSearch search{HoughSegmenterConfig()};
  search.fitter.Assign(FeatureMode::kDefault, cells, seed, max_tests);
  SideDetections found;
  DetectSides(component, &search, &found);
  return found;
}

TEST(SideVoting, FindsAFaceAndACylinderThatTouch) {
  std::vector<SideCell> cells;
  AddFace(-0.10f, 0.05f, 0.7f, &cells);
  AddArc({0.09f, 0.72f}, 0.04f, 0.01f, &cells);
  AddNoise(0.0007f, &cells);
  const SideDetections found = Detect(cells, 3, 1);
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
  std::vector<float> first_votes;
  std::vector<float> radii;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    HoughSegmenterConfig one_sample;
    one_sample.set_num_samples(1);
    SideFitter fitter(one_sample);
    fitter.Assign(FeatureMode::kDefault, cells, seed);
    LineFit vote;
    first_votes.push_back(fitter.FitLine(&vote) ? vote.support : 0);
    const SideDetections found = Detect(cells, 0, seed);
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
  const SideDetections found = Detect(cells, 0, 1);
  ASSERT_THAT(found.arcs, SizeIs(2));
  const auto [narrow, wide] = std::minmax(found.arcs[0].model.r, found.arcs[1].model.r);
  EXPECT_NEAR(narrow, 0.041, 0.001);
  EXPECT_NEAR(wide, 0.047, 0.001);
}

TEST(SideVoting, FindsNothingInFewerPointsThanN) {
  std::vector<SideCell> cells;
  AddFace(0, 0.010f, 0.7f, &cells);
  ASSERT_LT(AllOf(cells).NumPoints(), 100);
  for (const auto& few : {cells, std::vector<SideCell>()}) {
    const SideDetections found = Detect(few, 0, 1);
    EXPECT_THAT(found.faces, IsEmpty());
    EXPECT_THAT(found.arcs, IsEmpty());
  }
}

TEST(SideVoting, FindsTheSameWhateverCameBefore) {
  std::vector<SideCell> cells;
  AddArc({0.09f, 0.72f}, 0.04f, 0.01f, &cells);
  AddNoise(0.0007f, &cells);
  std::vector<SideCell> others = cells;
  AddFace(-0.30f, 0.05f, 0.7f, &others);
  SideSearch search{HoughSegmenterConfig()};
  SideDetections found;
  for (const auto* component : {&others, &cells}) {
    search.fitter.Assign(FeatureMode::kDefault, *component, 1);
    found = SideDetections();
    DetectSides(0, &search, &found);
  }
  const SideDetections alone = Detect(cells, 0, 1);
  ASSERT_THAT(found.arcs, SizeIs(1));
  ASSERT_THAT(alone.arcs, SizeIs(1));
  EXPECT_THAT(found.faces, IsEmpty());
  EXPECT_EQ(found.arcs[0].model.r, alone.arcs[0].model.r);
  EXPECT_EQ(found.arcs[0].num_votes, alone.arcs[0].num_votes);
}

TEST(SideVoting, TakesPeaksFromTheVotesThatItsTestsAllow) {
  std::vector<SideCell> cells;
  AddFace(-0.10f, 0.05f, 0.7f, &cells);
  AddNoise(0.0007f, &cells);
  SideSearch search{HoughSegmenterConfig()};
  search.fitter.Assign(FeatureMode::kDefault, cells, 1);
  SideDetections all;
  DetectSides(0, &search, &all);
  const int64_t num_tests = search.fitter.num_tests();
  EXPECT_FALSE(search.fitter.is_spent());
  const SideDetections some = Detect(cells, 0, 1, num_tests / 2);
  ASSERT_THAT(all.faces, SizeIs(1));
  ASSERT_THAT(some.faces, SizeIs(1));
  EXPECT_GT(some.faces[0].num_votes, 0);
  EXPECT_LT(some.faces[0].num_votes, all.faces[0].num_votes);
  EXPECT_NEAR(some.faces[0].model.rho, all.faces[0].model.rho, 1e-4);
  EXPECT_THAT(Detect(cells, 0, 1, 0).faces, IsEmpty());
}

TEST(InlierFilters, KeepsTheHeavierRunOfALineAndRejectsTwoInPaperMode) {
  std::vector<SideCell> cells;
  AddFace(0, 0.05f, 0.7f, &cells);
  AddFace(0.09f, 0.20f, 0.7f, &cells);
  LineModel line;
  line.n = {0, -1};
  CellArrays inliers = AllOf(cells);
  CellArrays paper = inliers;
  InlierFilters filters;
  filters.KeepOneRun(line, 0.015f, FeatureMode::kDefault, &inliers);
  filters.KeepOneRun(line, 0.015f, FeatureMode::kPaper, &paper);
  std::vector<float> x;
  for (size_t i : IndicesOf(inliers)) x.push_back(cells[i].p.x());
  EXPECT_THAT(x, Each(Ge(0.09f)));
  EXPECT_THAT(x, testing::Not(IsEmpty()));
  EXPECT_TRUE(paper.empty());
}

TEST(InlierFilters, DropsArcsOfAnotherHeight) {
  std::vector<SideCell> cells;
  AddArc({0, 0.7f}, 0.04f, 0.01f, &cells);
  const size_t num_below = cells.size();
  AddArc({0, 0.7f}, 0.04f, 0.20f, &cells);
  cells.resize(num_below + num_below / 2);
  CircleModel circle;
  circle.c = {0, 0.7f};
  circle.r = 0.04f;
  CellArrays inliers = AllOf(cells);
  InlierFilters filters;
  filters.KeepOneHeight(0.015f, &inliers);
  filters.KeepArcs(0.015f, 2, &circle, &inliers);
  EXPECT_THAT(IndicesOf(inliers), SizeIs(num_below));
  EXPECT_NEAR(circle.arc, M_PI, 0.2);
}

TEST(InlierFilters, PaperModeDividesFlatFromRoundByCurvatureAndRadius) {
  std::vector<SideCell> cells(4, Cell({0.04f, 0}, {1, 0}, 0.05f, 0));
  cells[0].curvature = 0.005f;  // flat
  cells[1].curvature = 0.020f;  // round, of another radius
  cells[1].r_min = 0.07f;
  cells[2].curvature = 0.020f;  // round, of this radius
  cells[2].r_min = 0.05f;
  cells[3].curvature = 0.009f;  // flat
  CellArrays flat = AllOf(cells);
  CellArrays round = flat;
  CircleModel circle;
  circle.r = 0.04f;
  InlierFilters filters;
  filters.KeepFlat(0.010f, &flat);
  filters.KeepRound(circle, 0.010f, 0.020f, &round);
  EXPECT_THAT(IndicesOf(flat), testing::ElementsAre(0, 3));
  EXPECT_THAT(IndicesOf(round), testing::ElementsAre(2));
}

// Points that a model keeps with all filters and without one of them, in default mode.
template <typename Model>
std::pair<float, float> NumKept(const std::vector<SideCell>& cells, const Model& model,
                                void (HoughSegmenterConfig::*set_filter)(bool)) {
  HoughSegmenterConfig config;
  const auto num_kept = [&] {
    SideFitter fitter(config);
    fitter.Assign(FeatureMode::kDefault, cells, 1);
    Fit<Model> fit;
    return fitter.Refit(model, &fit) ? fit.num_points : 0;
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
  const float num_all = AllOf(cells).NumPoints();
  const auto runs = NumKept(cells, line, &HoughSegmenterConfig::set_filter_runs);
  EXPECT_THAT(runs, testing::Pair(testing::AllOf(testing::Gt(0), testing::Lt(num_all)), num_all));
  cells.clear();
  AddFace(0, 0.20f, 0.7f, &cells);
  const float num_face = AllOf(cells).NumPoints();
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
  const float num_all = AllOf(cells).NumPoints();
  EXPECT_THAT(NumKept(cells, circle, &HoughSegmenterConfig::set_filter_arcs),
              testing::Pair(testing::AllOf(testing::Gt(0), testing::Lt(num_all)), num_all));
  cells = half;
  AddArc(circle.c, circle.r, 0.20f, &cells);
  const float num_both = AllOf(cells).NumPoints();
  EXPECT_THAT(NumKept(cells, circle, &HoughSegmenterConfig::set_filter_heights),
              testing::Pair(testing::FloatEq(0.5f * num_both), num_both));
  for (SideCell& cell : half) cell.kappa = 0;
  EXPECT_THAT(NumKept(half, circle, &HoughSegmenterConfig::set_filter_radius),
              testing::Pair(0, AllOf(half).NumPoints()));
}

// A vote for a circle at x, with the cells of a component of 100 from first on as inliers.
CircleFit Vote(float x, float support, size_t first = 0, size_t num = 0) {
  CircleFit fit;
  fit.model.c = {x, 0.7f};
  fit.model.r = 0.04f;
  fit.support = support;
  fit.num_points = static_cast<float>(4 * num);
  fit.inliers.Clear(100);
  for (size_t i = first; i < first + num; ++i) fit.inliers.Add(i);
  return fit;
}

TEST(ParameterSpace, PeakIsTheDensestPlaceNotTheStrongestVote) {
  ParameterSpace<CircleModel> space;
  space.Add(Vote(0.100f, 500));
  for (float x : {0.000f, 0.002f, 0.004f}) space.Add(Vote(x, 300));
  space.Connect();
  const auto peak = space.HighestPeak();
  ASSERT_TRUE(peak);
  EXPECT_EQ(peak->num_votes, 3);
  EXPECT_NEAR(peak->model.c.x(), 0.002, 1e-5);
  EXPECT_FLOAT_EQ(peak->density, 900);
  space.Remove(*peak);
  ASSERT_TRUE(space.HighestPeak());
  EXPECT_EQ(space.HighestPeak()->num_votes, 1);
  space.Remove(*space.HighestPeak());
  EXPECT_FALSE(space.HighestPeak());
}

TEST(ParameterSpace, ForgetsVotesOfWhichMostIsExplained) {
  const std::vector<SideCell> cells(100, Cell({0, 0}, {0, -1}, 0, 0));
  ParameterSpace<CircleModel> space;
  space.Add(Vote(0.000f, 300, 0, 40));
  space.Add(Vote(0.002f, 300, 30, 40));
  space.Connect();
  EXPECT_EQ(space.HighestPeak()->num_votes, 2);
  CellSet explained;
  explained.Clear(100);
  for (size_t i = 0; i < 45; ++i) explained.Add(i);
  space.Explain(cells, explained);
  ASSERT_TRUE(space.HighestPeak());
  EXPECT_EQ(space.HighestPeak()->num_votes, 1);
  EXPECT_FLOAT_EQ(space.HighestPeak()->model.c.x(), 0.002f);
  EXPECT_FLOAT_EQ(space.HighestPeak()->density, 300);
}

TEST(ParameterSpace, JoinsLinesWhoseDirectionsAreOnEitherSideOfAHalfTurn) {
  ParameterSpace<LineModel> space;
  for (const float angle : {kPi - 0.02f, -kPi + 0.02f, 0.0f}) {
    LineFit vote;
    vote.model.n = {std::cos(angle), std::sin(angle)};
    vote.model.s_min = -0.05f;
    vote.model.s_max = 0.05f;
    vote.support = 100;
    space.Add(vote);
  }
  space.Connect();
  ASSERT_TRUE(space.HighestPeak());
  EXPECT_EQ(space.HighestPeak()->num_votes, 2);
  EXPECT_NEAR(space.HighestPeak()->model.n.x(), -1, 1e-3);
}

TEST(CellBuckets, DrawsOnlyWhatIsLeftNearby) {
  std::vector<SideCell> cells;
  for (int i = 0; i < 60; ++i) {
    cells.push_back(Cell({0.01f * static_cast<float>(i), 0.7f}, {0, -1}, 0, 0));
  }
  CellBuckets buckets;
  buckets.Assign(cells);
  for (size_t i = 0; i < 60; i += 2) buckets.Remove(i);
  RandomIndex random(1);
  std::set<size_t> drawn;
  for (int k = 0; k < 500; ++k) drawn.insert(*buckets.DrawNear(31, &random));
  EXPECT_THAT(drawn, Each(testing::ResultOf([](size_t i) { return i % 2; }, 1u)));
  EXPECT_THAT(drawn, testing::Contains(29u));
  EXPECT_GT(*drawn.begin(), 20u);
  EXPECT_LT(*drawn.rbegin(), 42u);
  buckets.Keep();
  for (size_t i = 1; i < 60; i += 2) buckets.Remove(i);
  EXPECT_FALSE(buckets.DrawNear(31, &random));
  buckets.Restore();
  EXPECT_EQ(*buckets.DrawNear(31, &random) % 2, 1u);
}

}  // namespace
}  // namespace declutter
