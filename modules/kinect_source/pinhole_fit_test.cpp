#include "modules/kinect_source/pinhole_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace declutter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// A tilted plane seen by `camera`, every third point missing.
std::vector<Eigen::Vector3f> PlaneSeenBy(const PinholeCamera& camera) {
  std::vector<Eigen::Vector3f> points;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d point = camera.Ray(u, v) * (0.8 + 0.001 * v);
      points.push_back((u + v) % 3 == 0 ? Eigen::Vector3f(kNan, kNan, kNan) : point.cast<float>());
    }
  }
  return points;
}

std::string RefusalOf(int width, int height, const std::vector<Eigen::Vector3f>& points) {
  try {
    FitPinholeCamera(width, height, points);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "not refused";
}

TEST(PinholeFitTest, RecoversTheCameraOfAnOrganisedCloud) {
  const PinholeCamera camera{64, 48, 96.4, 90.1, 31.8, 22.3};
  const PinholeCamera fit = FitPinholeCamera(64, 48, PlaneSeenBy(camera));
  EXPECT_EQ(fit.width, 64);
  EXPECT_EQ(fit.height, 48);
  EXPECT_NEAR(fit.fx, 96.4, 1e-3);
  EXPECT_NEAR(fit.fy, 90.1, 1e-3);
  EXPECT_NEAR(fit.cx, 31.8, 1e-3);
  EXPECT_NEAR(fit.cy, 22.3, 1e-3);
}

TEST(PinholeFitTest, RefusesAGridThatIsNoImage) {
  auto points = PlaneSeenBy({64, 48, 96.4, 90.1, 31.8, 22.3});
  for (size_t i = 0; i < points.size(); i += 2) points[i].x() += 0.1f;
  EXPECT_THAT(RefusalOf(64, 48, points), HasSubstr("not the image of a pinhole camera"));
}

TEST(PinholeFitTest, RefusesACameraWithYUp) {
  auto points = PlaneSeenBy({64, 48, 96.4, 90.1, 31.8, 22.3});
  for (auto& point : points) point.y() = -point.y();
  EXPECT_THAT(RefusalOf(64, 48, points), HasSubstr("y down"));
}

TEST(PinholeFitTest, RefusesTooFewPoints) {
  std::vector<Eigen::Vector3f> points(64 * 48, {kNan, kNan, kNan});
  points[0] = {0.1f, 0.1f, 1.0f};
  EXPECT_THAT(RefusalOf(64, 48, points), HasSubstr("only 1 measured points"));
}

TEST(PinholeFitTest, KeepsTheNearestPointOfAPixel) {
  const PinholeCamera camera{2, 1, 1, 1, 0, 0};
  const std::vector<Eigen::Vector3f> points = {{0, 0, 3}, {0, 0, 2},  {0, 0, 2.5f}, {1, 0, 1},
                                               {9, 0, 1}, {0, 0, -1}, {kNan, 0, 1}};
  EXPECT_THAT(ProjectedPixels(camera, points), ElementsAre(-1, 0, -1, 1, -1, -1, -1));
}

TEST(PinholeFitTest, CountsInMillimetresWhatWasMeasuredInMillimetres) {
  const auto image = DepthOf({2, 1, 1, 1, 0, 0}, {{0, 0, 0.701f}, {0, 0, 0.812f}}, {0, 1});
  EXPECT_EQ(image.depth_scale_m, 0.001);
  EXPECT_THAT(image.counts, ElementsAre(701, 812));
}

TEST(PinholeFitTest, CountsInTenthsOfMillimetresOtherwise) {
  const auto image = DepthOf({2, 1, 1, 1, 0, 0}, {{0, 0, 0.7014f}, {0, 0, 0.8f}}, {0, 1});
  EXPECT_EQ(image.depth_scale_m, 0.0001);
  EXPECT_THAT(image.counts, ElementsAre(7014, 8000));
}

TEST(PinholeFitTest, CountsFarCloudsInMillimetresAndDropsWhatIsBeyond) {
  const auto image = DepthOf({2, 1, 1, 1, 0, 0}, {{0, 0, 9.0004f}, {0, 0, 70.0f}}, {0, 1});
  EXPECT_EQ(image.depth_scale_m, 0.001);
  EXPECT_THAT(image.counts, ElementsAre(9000, 0));
}

}  // namespace
}  // namespace declutter
