#include "modules/model_verifier/confidence.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

// Of a box of a height, at a depth, on which every pixel that sees it lies.
double ConfidenceInBox(double height_m, double z) {
  ObjectModel object;
  object.solid.size = {0.2, 0.1, height_m};
  object.solid.X_CO.translation().z() = z;
  RayEvidence evidence;
  evidence.explained.resize(400);
  evidence.fit_sum = 400 * kFitUnit;
  return Confidence(object, evidence, 0, {Eigen::Vector3d::UnitZ(), 1});
}

TEST(Confidence, IsWholeInABoxWithoutFault) { EXPECT_DOUBLE_EQ(ConfidenceInBox(0.1, 0.9), 1); }

TEST(Confidence, IsNoneInWhatIsThinnerThanASolid) { EXPECT_EQ(ConfidenceInBox(0.009, 0.6), 0); }

TEST(Confidence, IsNoneInWhatMayBeAWaveOfTheSupport) {
  EXPECT_EQ(ConfidenceInBox(0.011, 1.3), 0);
  EXPECT_GT(ConfidenceInBox(0.011, 0.9), 0);
  EXPECT_GT(ConfidenceInBox(0.016, 1.3), 0);
}

}  // namespace
}  // namespace declutter
