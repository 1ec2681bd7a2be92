#include "modules/model_verifier/support_settling.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

// A tin and, on it or behind it, a carton of 40 x 60 x 120 mm.
class SupportSettlerTest : public testing::Test {
 protected:
  static constexpr double kTinHeight = 0.07, kCartonHeight = 0.12;

  void Look(const std::string& place_of_carton) {
    seen_.emplace(
        "object { cylinder { radius_m: 0.09 height_m: 0.07 } y_m: 0.7 }"
        "object { box { size_x_m: 0.04 size_y_m: 0.06 size_z_m: 0.12 } " +
        place_of_carton + " }");
    tin_.solid = seen_->scene.objects[0].solid;
    carton_.solid = seen_->scene.objects[1].solid;
    carton_.evidence[2] = Evidence::kAssumed;
  }

  // [m] the lower end of the carton above the table, when it was proposed to end so much further
  // down than it does.
  double SettledBottom(double sunk_m) {
    std::vector<ObjectModel> objects = {carton_, tin_};
    objects[0].solid = Longer(carton_.solid, 2, -1, sunk_m);
    SupportSettler settler;
    settler.Settle(seen_->observed.every_second_pixel(), &objects);
    supported_by_ = objects[1].supported_by;
    EXPECT_NEAR(TopOf(objects[1].solid, seen_->scene.table),
                TopOf(carton_.solid, seen_->scene.table), 1e-9);
    return BottomOf(objects[1].solid, seen_->scene.table);
  }

  std::optional<ObservedScene> seen_;
  ObjectModel tin_, carton_;
  int32_t supported_by_ = -1;
};

TEST_F(SupportSettlerTest, PutsASolidOnWhatIsBelow) {
  Look("y_m: 0.7 on: 0");
  for (const double sunk_m : {-0.03, 0.0, 0.01}) {
    EXPECT_NEAR(SettledBottom(sunk_m), kTinHeight, 1e-9) << sunk_m;
    EXPECT_EQ(supported_by_, 1) << sunk_m;
  }
}

TEST_F(SupportSettlerTest, LiftsASolidThatWasProposedToEndInsideWhatCarriesIt) {
  Look("y_m: 0.7 on: 0");
  for (const Evidence evidence : {Evidence::kAssumed, Evidence::kObserved}) {
    carton_.evidence[2] = evidence;
    EXPECT_NEAR(SettledBottom(0.03), kTinHeight, 1e-9);
    EXPECT_EQ(supported_by_, 1);
  }
}

TEST_F(SupportSettlerTest, LeavesALowerEndThatWasSeen) {
  Look("y_m: 0.7 on: 0");
  carton_.evidence[2] = Evidence::kObserved;
  EXPECT_NEAR(SettledBottom(-0.03), kTinHeight + 0.03, 1e-9);
  EXPECT_EQ(supported_by_, 1);
}

TEST_F(SupportSettlerTest, ExtendsToTheTableWhatShowsMoreOfItselfFurtherDown) {
  // There is no tin: it was proposed about the lower part of the carton.
  Look("y_m: 0.4");
  carton_.solid = Longer(carton_.solid, 2, -1, -0.05);
  tin_.solid = seen_->scene.objects[1].solid;
  tin_.solid.size += Eigen::Vector3d(0.01, 0.01, 0);
  tin_.solid = Longer(tin_.solid, 2, 1, kTinHeight - kCartonHeight);
  EXPECT_NEAR(SettledBottom(0.02), 0, 1e-9);
  EXPECT_EQ(supported_by_, 0);
}

TEST_F(SupportSettlerTest, ExtendsToTheTableWhatWouldFallOff) {
  // Behind the tin, which was proposed somewhat too wide.
  Look("y_m: 0.822");
  tin_.solid.size += Eigen::Vector3d(0.05, 0.05, 0);
  EXPECT_NEAR(SettledBottom(-0.02), 0, 1e-9);
  EXPECT_EQ(supported_by_, 0);
}

}  // namespace
}  // namespace declutter
