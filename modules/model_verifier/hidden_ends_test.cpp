#include "modules/model_verifier/hidden_ends.h"

#include <gtest/gtest.h>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

// Of a box, 0.2 m long, something higher in front hides the right half.
class HiddenEnds : public testing::Test {
 protected:
  HiddenEnds() {
    for (auto& ends : ends_) ends = {EndEvidence::kEdge, EndEvidence::kEdge};
    ends_[0][1] = EndEvidence::kAssumed;
  }

  // [m] by which the right end of the seen half is moved.
  double GrowthBesides(const std::vector<Solid>& others) {
    const Solid seen = Longer(seen_.scene.objects[0].solid, 0, 1, -0.1);
    Solid box = seen;
    RayEvidence buffer;
    CompleteHiddenEnds(ends_, others, seen_.observed.every_second_pixel(), &box, &variances_,
                       &buffer);
    EXPECT_EQ(box.size.tail<2>(), seen.size.tail<2>());
    const Eigen::Vector3d shift_O =
        seen.X_CO.linear().transpose() * (box.X_CO.translation() - seen.X_CO.translation());
    const double growth = box.size.x() - seen.size.x();
    EXPECT_NEAR((shift_O - Eigen::Vector3d(0.5 * growth, 0, 0)).norm(), 0, 1e-9);
    return growth;
  }

  const ObservedScene seen_{
      "object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.12 } y_m: 0.75 }"
      "object { box { size_x_m: 0.1 size_y_m: 0.06 size_z_m: 0.3 } x_m: 0.07 y_m: 0.62 }"};
  SolidEnds ends_{};
  EndVariances variances_{};
};

TEST_F(HiddenEnds, LieBehindWhatHidesThem) {
  const double growth = GrowthBesides({seen_.scene.objects[1].solid});
  EXPECT_GT(growth, 0.01);
  EXPECT_LT(growth, 0.02);
  EXPECT_GT(variances_[0][1], 0.01 * 0.01);
  EXPECT_EQ(variances_[0][0], 0);  // it is seen
}

TEST_F(HiddenEnds, DoNotReachIntoAnother) {
  Solid another = seen_.scene.objects[0].solid;
  another.size.x() = 0.05;
  another.X_CO.translation() += another.X_CO.linear() * Eigen::Vector3d(0.035, 0, 0);
  EXPECT_LT(GrowthBesides({another}), 0.008);  // it begins 10 mm behind the seen end
  EXPECT_LT(variances_[0][1], 0.004 * 0.004);
}

TEST_F(HiddenEnds, AreCutWhereTheyReachIntoAnother) {
  Solid another = seen_.scene.objects[0].solid;
  another.size.x() = 0.05;
  another.X_CO.translation() += another.X_CO.linear() * Eigen::Vector3d(0.01, 0, 0);
  EXPECT_NEAR(GrowthBesides({another}), -0.015, 0.005);
  ends_[0][1] = EndEvidence::kFreeSpace;
  EXPECT_NEAR(GrowthBesides({another}), -0.015, 0.005);
  ends_[0][1] = EndEvidence::kFace;
  EXPECT_EQ(GrowthBesides({another}), 0);
}

TEST_F(HiddenEnds, DoNotReachUnderTheTable) {
  // On its side, so that its x axis is upright, and taken to lean.
  Solid box = seen_.scene.objects[0].solid;
  const double half_height = 0.5 * box.size.z();
  box.X_CO =
      box.X_CO * Eigen::AngleAxisd(0.5 * static_cast<double>(EIGEN_PI), Eigen::Vector3d::UnitY());
  box.size = Eigen::Vector3d(2 * half_height, 0.06, 0.2);
  const Solid before = box;
  RayEvidence buffer;
  for (size_t side = 0; side < 2; ++side) {
    ends_[0] = {EndEvidence::kEdge, EndEvidence::kEdge};
    ends_[0][side] = EndEvidence::kAssumed;
    box = before;
    CompleteHiddenEnds(ends_, {}, seen_.observed.every_second_pixel(), &box, &variances_, &buffer);
    EXPECT_LT(box.size.x(), before.size.x() + 0.006) << side;
  }
}

TEST_F(HiddenEnds, DoNotReachIntoFreeSpace) {
  // The end of the whole box: what follows is seen.
  Solid box = seen_.scene.objects[0].solid;
  const double before = box.size.x();
  ends_[0] = {EndEvidence::kAssumed, EndEvidence::kEdge};
  RayEvidence buffer;
  CompleteHiddenEnds(ends_, {}, seen_.observed.every_second_pixel(), &box, &variances_, &buffer);
  EXPECT_LT(box.size.x(), before + 0.006);
}

}  // namespace
}  // namespace declutter
