#include "modules/model_verifier/leaning_boxes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/model_verifier.h"

namespace declutter {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

// A camera that looks down at a table at 45 degrees.
const Plane kTable = {Eigen::Vector3d(0, -std::sqrt(0.5), -std::sqrt(0.5)), 0.6};

// Depth at which a ray enters a box; infinite when it passes by.
double DepthOn(const Solid& box, const Eigen::Vector3d& ray_C) {
  const Eigen::Isometry3d X_OC = box.X_CO.inverse();
  const Eigen::Vector3d ray = X_OC.linear() * ray_C;
  double in = 0, out = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double a = (-0.5 * box.size[i] - X_OC.translation()[i]) / ray[i];
    const double b = (0.5 * box.size[i] - X_OC.translation()[i]) / ray[i];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return in < out ? in : std::numeric_limits<double>::infinity();
}

// What a camera without noise sees of boxes on the table.
DepthImage ImageOf(const std::vector<Solid>& boxes) {
  DepthImage image;
  image.camera = {640, 480, 525, 525, 319.5, 239.5};
  image.depth_scale_m = 0.0001;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector3d ray = image.camera.Ray(u, v);
      const double slope = kTable.normal.dot(ray);
      double z = slope < 0 ? -kTable.d / slope : 0;
      for (const Solid& box : boxes) z = std::min(z, DepthOn(box, ray));
      image.counts.push_back(static_cast<uint16_t>(std::min(65535.0, z / image.depth_scale_m)));
    }
  }
  return image;
}

// A box 0.1 m above the table, turned by yaw about its normal, then by lean about x of O.
Solid BoxThatLeans(double yaw, double lean) {
  Solid box;
  const Eigen::Isometry3d X_CT = TableFrame(kTable).inverse();
  box.X_CO = X_CT * Eigen::Translation3d(0, 0.55, 0.1) *
             Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
             Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitX());
  box.size = {0.16, 0.10, 0.12};
  return box;
}

HypothesisList NearTheBox(const Solid& box) {
  HypothesisList list;
  list.planes = {kTable};
  // Something that nothing speaks for.
  list.hypotheses.emplace_back().solid = box;
  list.hypotheses[0].solid.shape = Shape::kCylinder;
  list.hypotheses[0].solid.size = {0.03, 0.03, 0.03};
  return list;
}

ObjectList VerifyNear(const Solid& box) {
  DepthFrame frame;
  frame.image = ImageOf({box});
  return ModelVerifier(ModelVerifierConfig()).Verify(frame, NearTheBox(box));
}

TEST(ModelVerifier, FindsABoxThatLeansThoughNothingVotedForIt) {
  for (const auto& [yaw, lean] : {std::pair(0.0, 0.25), {0.6, 0.25}, {-0.4, -0.25}, {0.6, -0.35}}) {
    const Solid truth = BoxThatLeans(yaw, lean);
    const ObjectList list = VerifyNear(truth);
    ASSERT_THAT(list.objects, SizeIs(1)) << yaw;
    const Solid& found = list.objects[0].solid;
    EXPECT_EQ(found.shape, Shape::kBox);
    EXPECT_LT((found.X_CO.translation() - truth.X_CO.translation()).norm(), 0.003) << yaw;
    Eigen::Vector3d size = found.size, true_size = truth.size;
    std::sort(size.begin(), size.end());
    std::sort(true_size.begin(), true_size.end());
    EXPECT_LT((size - true_size).cwiseAbs().maxCoeff(), 0.006)
        << yaw << " " << found.size.transpose();
    // Its axes are those of the box, whichever is z.
    const Eigen::Matrix3d turn = (found.X_CO.linear().transpose() * truth.X_CO.linear()).cwiseAbs();
    EXPECT_GT(turn.colwise().maxCoeff().minCoeff(), 0.998) << yaw;
    EXPECT_GT(found.X_CO.linear().determinant(), 0);
    const double height_sd = std::sqrt(list.objects[0].covariance(5, 5));
    EXPECT_LT(std::abs(found.size.z() - truth.size.z()), 2 * height_sd);
  }
}

TEST(LeaningBoxFinder, LeavesBoxesAloneThatStand) {
  const Solid box = BoxThatLeans(0.6, 0);
  const DepthImage image = ImageOf({box});
  ObservedImage observed;
  observed.Set(image, kTable);
  const Observation observation = observed.every_second_pixel();
  const std::vector<uint8_t> all(static_cast<size_t>(observation.grid.num_pixels()), 1);
  const PixelWindow window{0, observation.grid.columns, 0, observation.grid.rows};
  LeaningBoxFinder finder;
  EXPECT_THAT(finder.Find(all, window, 400, observation), IsEmpty());

  // Of one that leans, nothing where its pixels are not marked, or are fewer than asked for.
  const DepthImage leaning = ImageOf({BoxThatLeans(0.6, 0.25)});
  observed.Set(leaning, kTable);
  const std::vector<uint8_t> none(all.size(), 0);
  EXPECT_THAT(finder.Find(none, window, 400, observation), IsEmpty());
  EXPECT_THAT(finder.Find(all, window, 40000, observation), IsEmpty());
  EXPECT_FALSE(finder.Find(all, window, 400, observation).empty());
}

}  // namespace
}  // namespace declutter
