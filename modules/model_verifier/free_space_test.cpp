#include "modules/model_verifier/free_space.h"

#include <gtest/gtest.h>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

class SeenThrough : public testing::Test {
 protected:
  int Num(const Solid& solid) {
    RayEvidence buffer;
    return NumSeenThrough(solid, seen_.observed.every_second_pixel(), &buffer);
  }

  const ObservedScene seen_{
      "object { box { size_x_m: 0.18 size_y_m: 0.08 size_z_m: 0.13 } y_m: 0.65 }"};
};

TEST_F(SeenThrough, IsNoBoxThatIsSomewhatTooLarge) {
  const Solid& box = seen_.scene.objects[0].solid;
  EXPECT_EQ(Num(box), 0);
  Solid bulging = Longer(box, 2, 1, 0.004);
  bulging.size.head<2>().array() += 0.008;
  EXPECT_LT(Num(bulging), kMaxSeenThrough);
}

TEST_F(SeenThrough, IsABoxThatReachesIntoFreeSpace) {
  EXPECT_GT(Num(Longer(seen_.scene.objects[0].solid, 0, 1, 0.03)), kMaxSeenThrough);
  EXPECT_GT(Num(Longer(seen_.scene.objects[0].solid, 2, 1, 0.03)), kMaxSeenThrough);
}

TEST_F(SeenThrough, IsNothingThinnerThanWhatIsLeftOut) {
  // In free space, beside the box.
  Solid thin = Longer(seen_.scene.objects[0].solid, 0, 1, 0.2);
  thin.X_CO.translation() += 0.1 * thin.X_CO.linear().col(0);
  EXPECT_GT(Num(thin), kMaxSeenThrough);
  thin.size.y() = 0.009;
  EXPECT_EQ(Num(thin), 0);
}

}  // namespace
}  // namespace declutter
