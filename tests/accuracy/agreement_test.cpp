#include "tests/accuracy/agreement.h"

#include <gtest/gtest.h>

#include <cmath>

namespace declutter::accuracy {
namespace {

ObjectModel Model(Shape shape, double x_m, const Eigen::Vector3d& size) {
  ObjectModel model;
  model.solid.shape = shape;
  model.solid.X_CO.translation() = Eigen::Vector3d(x_m, 0, 1);
  model.solid.size = size;
  return model;
}

ObjectModel Box(double x_m, double width_m = 0.1) {
  return Model(Shape::kBox, x_m, {width_m, 0.2, 0.3});
}

FrameAgreement Compare(const std::vector<ObjectModel>& baseline,
                       const std::vector<ObjectModel>& candidate) {
  ObjectList one, other;
  one.objects = baseline;
  other.objects = candidate;
  return CompareRuns({{"a", one}}, {{"a", other}}).at(0);
}

TEST(CompareRuns, CountsModelsWithin20MmAsTheSame) {
  EXPECT_TRUE(Compare({Box(0)}, {Box(0.019)}).IsSame());
  EXPECT_FALSE(Compare({Box(0)}, {Box(0.021)}).IsSame());
  EXPECT_TRUE(Compare({Box(0, 0.1)}, {Box(0, 0.119)}).IsSame());
  EXPECT_FALSE(Compare({Box(0, 0.1)}, {Box(0, 0.121)}).IsSame());
}

TEST(CompareRuns, KeepsShapesApart) {
  const FrameAgreement frame = Compare({Box(0)}, {Model(Shape::kCylinder, 0, {0.1, 0.1, 0.3})});
  EXPECT_FALSE(frame.IsSame());
  EXPECT_EQ(frame.num_baseline, (std::array<int, 2>{1, 0}));
  EXPECT_EQ(frame.num_candidate, (std::array<int, 2>{0, 1}));
  EXPECT_EQ(frame.num_same, (std::array<int, 2>{0, 0}));
}

TEST(CompareRuns, PairsEachModelOnce) {
  const FrameAgreement frame = Compare({Box(0), Box(0.01)}, {Box(0.005)});
  EXPECT_EQ(frame.num_same[0], 1);
  EXPECT_FALSE(frame.IsSame());
}

TEST(CompareRuns, AcceptsAnyOrderOfModelsAndAxes) {
  ObjectModel turned = Model(Shape::kBox, 0, {0.2, 0.1, 0.3});
  turned.solid.X_CO.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_TRUE(Compare({Box(0), Box(0.5)}, {Box(0.5), turned}).IsSame());
}

TEST(CompareRuns, DiffersWhereOneRunHasNoResult) {
  ObjectList list, failed;
  failed.header.error = "truncated PNG";
  const std::vector<FrameAgreement> frames =
      CompareRuns({{"a", list}, {"b", list}}, {{"b", failed}, {"c", list}});
  ASSERT_EQ(frames.size(), 3u);
  for (const FrameAgreement& frame : frames) EXPECT_FALSE(frame.IsSame()) << frame.frame;
  EXPECT_TRUE(frames[1].has_baseline);
  EXPECT_FALSE(frames[1].has_candidate);
  EXPECT_TRUE(CompareRuns({{"b", failed}}, {{"b", failed}}).at(0).IsSame());
}

}  // namespace
}  // namespace declutter::accuracy
