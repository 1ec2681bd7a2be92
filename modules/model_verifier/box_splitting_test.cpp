#include "modules/model_verifier/box_splitting.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

constexpr double kStep = 0.002;  // [m] between points

Solid BoxOf(const Eigen::Vector3d& size) {
  Solid box;
  box.X_CO = Eigen::Translation3d(0.1, 0.2, 0.8) *
             Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized());
  box.size = size;
  return box;
}

// Adds the top face of a box that reaches from (x0, y0) to (x1, y1) of O.
void AddTop(double x0, double y0, double x1, double y1, std::vector<Eigen::Vector3d>* points_O) {
  for (double x = x0; x <= x1; x += kStep) {
    for (double y = y0; y <= y1; y += kStep) points_O->emplace_back(x, y, 0.02);
  }
}

TEST(BoxSplitter, FindsTwoBoxesOfOneHeight) {
  const Solid box = BoxOf({0.14, 0.09, 0.04});
  std::vector<Eigen::Vector3d> points_O;
  AddTop(-0.07, -0.045, 0.0, 0.045, &points_O);
  AddTop(0.002, -0.045, 0.07, 0.0, &points_O);
  const auto parts = BoxSplitter().Split(box, points_O);
  ASSERT_TRUE(parts);
  const double tolerance = 0.006;
  EXPECT_TRUE((*parts)[0].size.isApprox(Eigen::Vector3d(0.07, 0.09, 0.04), 0.08));
  EXPECT_TRUE((*parts)[1].size.isApprox(Eigen::Vector3d(0.07, 0.045, 0.04), 0.08));
  const Eigen::Vector3d second_O = box.X_CO.inverse() * (*parts)[1].X_CO.translation();
  EXPECT_LT((second_O - Eigen::Vector3d(0.035, -0.0225, 0)).norm(), tolerance);
}

TEST(BoxSplitter, CutsBetweenTheCoarsestPlaces) {
  const Solid box = BoxOf({0.24, 0.09, 0.04});
  std::vector<Eigen::Vector3d> points_O;
  AddTop(-0.12, -0.02, 0.01, 0.045, &points_O);
  AddTop(0.012, -0.045, 0.12, 0.02, &points_O);
  const auto parts = BoxSplitter().Split(box, points_O);
  ASSERT_TRUE(parts);
  EXPECT_NEAR((*parts)[0].size.x(), 0.13, 0.005);
  EXPECT_NEAR((*parts)[0].size.y(), 0.065, 0.004);
  EXPECT_NEAR((*parts)[1].size.y(), 0.065, 0.004);
}

TEST(BoxSplitter, LeavesABoxThatIsFilledWhole) {
  std::vector<Eigen::Vector3d> points_O;
  AddTop(-0.07, -0.045, 0.07, 0.045, &points_O);
  EXPECT_FALSE(BoxSplitter().Split(BoxOf({0.14, 0.09, 0.04}), points_O));
}

TEST(BoxSplitter, MakesNoPartThatIsTooThinToGrasp) {
  std::vector<Eigen::Vector3d> points_O;
  AddTop(-0.07, -0.045, 0.07, -0.034, &points_O);
  AddTop(-0.07, -0.032, -0.06, 0.045, &points_O);
  EXPECT_FALSE(BoxSplitter().Split(BoxOf({0.14, 0.09, 0.04}), points_O));
}

}  // namespace
}  // namespace declutter
