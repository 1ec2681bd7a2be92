#include "modules/model_verifier/outline_misfit.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/systematic_misfit.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

// An object that is seen from almost straight above.
class OutlineOf : public testing::TestWithParam<Shape> {
 protected:
  static std::string Text() {
    return std::string(
               "camera { height_m: 0.9 pitch_rad: 1.5 } table { y_m: 0 } object { y_m: 0.05 "
               "yaw_rad: 0.4 ") +
           (GetParam() == Shape::kCylinder
                ? "cylinder { radius_m: 0.04 height_m: 0.1 } }"
                : "box { size_x_m: 0.07 size_y_m: 0.06 size_z_m: 0.1 } }");
  }

  const Solid& truth() const { return seen_.scene.objects[0].solid; }
  // A solid of the other shape in the same place.
  Solid other() const {
    Solid solid = truth();
    const bool is_cylinder = solid.shape == Shape::kCylinder;
    const double width = is_cylinder ? 0.074 : 0.072;
    solid.shape = is_cylinder ? Shape::kBox : Shape::kCylinder;
    solid.size.head<2>() << width, width;
    return solid;
  }

  std::optional<double> Misfit(const Solid& solid) const {
    const Observation observation = seen_.observed.every_second_pixel();
    return OutlineMisfit(solid, CastRays(solid, observation), observation);
  }
  double Share(const Solid& solid) const {
    const Observation observation = seen_.observed.every_second_pixel();
    std::vector<Eigen::Vector3d> buffer;
    return MisfitShareOf(solid, CastRays(solid, observation), observation, &buffer);
  }

  const ObservedScene seen_{Text()};
};
INSTANTIATE_TEST_SUITE_P(EachShape, OutlineOf, testing::Values(Shape::kBox, Shape::kCylinder));

TEST_P(OutlineOf, ATopTellsItsShape) {
  ASSERT_TRUE(Misfit(truth()));
  ASSERT_TRUE(Misfit(other()));
  EXPECT_LT(*Misfit(truth()), 0.8);
  EXPECT_GT(*Misfit(other()), 1.3);
}

TEST_P(OutlineOf, ATopIsTheSameForASolidThatIsSomewhatOff) {
  Solid solid = truth();
  solid.size.head<2>().array() += 0.004;
  solid.X_CO.translation() += 0.003 * solid.X_CO.linear().col(0);
  EXPECT_NEAR(*Misfit(solid), *Misfit(truth()), 0.3);
}

TEST_P(OutlineOf, ATopIsWhatTellsWhereNoSideIsSeen) {
  EXPECT_LT(Share(truth()), 0.02);
  EXPECT_GT(Share(other()), 0.1);
}

TEST_P(OutlineOf, ATopIsNotKnownWhereNoneIsSeen) {
  EXPECT_FALSE(Misfit(Longer(truth(), 2, 1, 0.05)));  // reaches above it
  Solid lying = truth();
  lying.X_CO.linear() = lying.X_CO.linear() * Eigen::AngleAxisd(1.5, Eigen::Vector3d::UnitX());
  EXPECT_FALSE(Misfit(lying));
}

}  // namespace
}  // namespace declutter
