#include "modules/hough_segmenter/lying_cylinders.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace declutter {
namespace {

// A point of T at pixel (u, v); the pixels only say which points are neighbours.
TablePoint Point(const Eigen::Vector3f& p_T, const Eigen::Vector3f& n_T, int u, int v) {
  return {{p_T, n_T, 0.001f, 0}, 0, 0, 0, u, v};
}

// The upper half of a cylinder of radius 40 mm on the table, its axis along x from x0 to x1, at
// y = 0.7. One column of pixels every 2 mm.
void AddLyingCylinder(float x0, float x1, std::vector<TablePoint>* points) {
  constexpr float kRadius = 0.04f;
  for (float x = x0; x < x1; x += 0.002f) {
    for (int row = 0; row <= 60; ++row) {
      const float angle = static_cast<float>(M_PI) * static_cast<float>(row) / 60;
      const Eigen::Vector3f n(0, -std::cos(angle), std::sin(angle));
      const Eigen::Vector3f p = Eigen::Vector3f(x, 0.7f, kRadius) + kRadius * n;
      points->push_back(Point(p, n, 100 + static_cast<int>(std::lround(x / 0.002f)), 100 + row));
    }
  }
}

// The top and the front of a box, 80 mm deep and high.
void AddBox(float x0, float x1, std::vector<TablePoint>* points) {
  for (float x = x0; x < x1; x += 0.002f) {
    const int u = 100 + static_cast<int>(std::lround(x / 0.002f));
    for (int row = 0; row < 40; ++row) {
      const float along = 0.002f * static_cast<float>(row);
      points->push_back(Point({x, 0.66f, along}, {0, -1, 0}, u, 100 + row));
      points->push_back(Point({x, 0.66f + along, 0.08f}, {0, 0, 1}, u, 140 + row));
    }
  }
}

std::vector<Hypothesis> Find(const std::vector<TablePoint>& points) {
  Tabletop tabletop;
  tabletop.objects.camera = {400, 300, 400, 400, 199.5, 149.5};
  tabletop.objects.counts.assign(400 * 300, 0);
  const auto tops =
      TopPatchFinder().Find(points, tabletop, Eigen::Isometry3d::Identity(), 0.006f, 60);
  PointGrid slants;
  slants.Assign(points, [](const TablePoint& point) { return point.is_slanted(); });
  SideCells cells;
  std::vector<Hypothesis> hypotheses;
  LyingCylinders(HoughSegmenterConfig()).Find(points, slants, tops, &cells, &hypotheses);
  return hypotheses;
}

// Whether one of them has this length, with the radius and height of AddLyingCylinder.
bool HasLength(const std::vector<Hypothesis>& found, double length) {
  for (const Hypothesis& hypothesis : found) {
    const Solid& solid = hypothesis.solid;
    if (std::abs(solid.height() - length) < 0.006 && std::abs(solid.radius() - 0.04) < 0.002 &&
        std::abs(solid.X_CO.translation().z() - 0.04) < 0.002 &&
        std::abs(solid.X_CO.linear()(0, 2)) > 0.99) {
      return true;
    }
  }
  return false;
}

TEST(LyingCylinders, AreFoundWithTheirAxisLevel) {
  std::vector<TablePoint> points;
  AddLyingCylinder(0, 0.2f, &points);
  EXPECT_TRUE(HasLength(Find(points), 0.2));
}

TEST(LyingCylinders, AreJoinedAcrossAnOccluder) {
  std::vector<TablePoint> points;
  AddLyingCylinder(0, 0.08f, &points);
  AddLyingCylinder(0.14f, 0.22f, &points);
  EXPECT_TRUE(HasLength(Find(points), 0.22));
}

TEST(LyingCylinders, AreNotSeenInABox) {
  std::vector<TablePoint> points;
  AddBox(0, 0.2f, &points);
  EXPECT_THAT(Find(points), testing::IsEmpty());
}

}  // namespace
}  // namespace declutter
