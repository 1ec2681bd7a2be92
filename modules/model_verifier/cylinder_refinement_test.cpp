#include "modules/model_verifier/cylinder_refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

struct RadiusErrors {
  double mean_m = 0, sd_m = 0;
};

// Of a can 0.9 m from the camera, fitted from a place beside the true one, with the noise of as
// many sensors.
RadiusErrors ErrorsOfRadius(const std::string& noise, int num_sensors) {
  const std::string scene_text =
      "object { cylinder { radius_m: 0.04 height_m: 0.12 } y_m: 0.7 } noise { model: \"" + noise +
      "\" sensor_seed: ";
  double sum = 0, sum_of_squares = 0;
  FitPoints points;
  for (int seed = 0; seed < num_sensors; ++seed) {
    const ObservedScene seen(scene_text + std::to_string(seed) + " }", static_cast<uint64_t>(seed));
    Solid solid = seen.scene.objects[0].solid;
    solid.X_CO.translation().x() += 0.002;
    solid.size.head<2>().array() += 0.004;
    for (int i = 0; i < 3; ++i) solid = RefineCylinder(solid, seen.observed.every_pixel(), &points);
    const double error = solid.radius() - 0.04;
    sum += error;
    sum_of_squares += error * error;
  }
  const double mean = sum / num_sensors;
  return {mean, std::sqrt(sum_of_squares / num_sensors - mean * mean)};
}

TEST(RefineCylinder, HasNoBiasWhereThereIsNoNoise) {
  EXPECT_NEAR(ErrorsOfRadius("none", 1).mean_m, 0, 3e-5);
}

TEST(RefineCylinder, HasNoBiasByIndependentNoise) {
  const RadiusErrors errors = ErrorsOfRadius("white", 120);
  EXPECT_NEAR(errors.mean_m, 0, 3e-5);
  // The Cramer-Rao bound of what is seen up to 78 degrees of incidence is 0.05 mm.
  EXPECT_LT(errors.sd_m, 1e-4);
}

TEST(RefineCylinder, LeavesOutWhereWindowsReachAroundTheOutline) {
  EXPECT_NEAR(ErrorsOfRadius("real_sensor", 40).mean_m, 0, 1e-3);
}

}  // namespace
}  // namespace declutter
