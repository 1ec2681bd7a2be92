#include "modules/frame_views/point_cloud.h"

#include <gtest/gtest.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <fstream>

#include "modules/imaging/temporary_folder.h"

namespace declutter {
namespace {

DepthImage TwoByOne() { return {{2, 1, 100, 100, 0, 0}, 0.001, {0, 900}}; }

ObjectList ListOf(Shape shape, const Eigen::Vector3d& size) {
  ObjectList list;
  list.objects.resize(1);
  list.objects[0].id = 3;
  list.objects[0].solid.shape = shape;
  list.objects[0].solid.size = size;
  list.objects[0].solid.X_CO.translation() = Eigen::Vector3d(0.1, 0.2, 0.8);
  return list;
}

TEST(MeasuredCloud, HasAPointForEachPixelWithItsColourAndObject) {
  const ColorImage color{2, 1, {1, 2, 3, 4, 5, 6}};
  ObjectList objects;
  objects.camera = TwoByOne().camera;
  objects.labels = {0, 7};
  const PointCloud cloud = MeasuredCloud(TwoByOne(), &color, &objects);
  ASSERT_EQ(cloud.points.size(), 2u);
  EXPECT_TRUE(std::isnan(cloud.points[0].p_C.x()));
  EXPECT_EQ(cloud.points[0].rgb, 0x010203u);
  EXPECT_TRUE(cloud.points[1].p_C.isApprox(Eigen::Vector3f(0.009f, 0, 0.9f)));
  EXPECT_EQ(cloud.points[1].rgb, 0x040506u);
  EXPECT_EQ(cloud.points[1].label, 7u);
}

TEST(MeasuredCloud, IsWhiteWithoutAnImageOfItsSize) {
  const ColorImage other{1, 1, {1, 2, 3}};
  const PointCloud cloud = MeasuredCloud(TwoByOne(), &other, nullptr);
  EXPECT_EQ(cloud.points[1].rgb, 0xFFFFFFu);
  EXPECT_EQ(cloud.points[1].label, 0u);
}

TEST(ModelCloud, CoversTheFacesOfABox) {
  const Eigen::Vector3d size(0.1, 0.06, 0.04);
  const PointCloud cloud = ModelCloud(ListOf(Shape::kBox, size), 0.02);
  EXPECT_EQ(cloud.points.size(), 2u * (6 * 4 + 4 * 3 + 6 * 3));
  Eigen::AlignedBox3f bounds;
  for (const CloudPoint& point : cloud.points) {
    const Eigen::Vector3f p_O = point.p_C - Eigen::Vector3f(0.1f, 0.2f, 0.8f);
    bounds.extend(p_O);
    const Eigen::Array3f to_faces = (size.cast<float>() / 2 - p_O.cwiseAbs()).array().abs();
    EXPECT_NEAR(to_faces.minCoeff(), 0, 1e-6);
    EXPECT_EQ(point.label, 3u);
  }
  EXPECT_TRUE(bounds.sizes().isApprox(size.cast<float>(), 1e-4f));
}

TEST(ModelCloud, CoversSideAndCapsOfACylinder) {
  const PointCloud cloud = ModelCloud(ListOf(Shape::kCylinder, {0.08, 0.08, 0.2}), 0.005);
  int num_side = 0, num_caps = 0;
  for (const CloudPoint& point : cloud.points) {
    const Eigen::Vector3f p_O = point.p_C - Eigen::Vector3f(0.1f, 0.2f, 0.8f);
    const bool is_side = std::abs(p_O.head<2>().norm() - 0.04f) < 1e-5f;
    const bool is_cap = std::abs(std::abs(p_O.z()) - 0.1f) < 1e-5f;
    EXPECT_TRUE(is_side || is_cap);
    num_side += is_side ? 1 : 0;
    num_caps += is_cap && !is_side ? 1 : 0;
  }
  EXPECT_NEAR(num_side, 41 * 51, 5);
  EXPECT_GT(num_caps, 300);
}

TEST(ModelCloud, StaysBoundedForALargeSolid) {
  const PointCloud cloud = ModelCloud(ListOf(Shape::kBox, {9, 9, 9}), 1e-4);
  EXPECT_LT(cloud.points.size(), 1'100'000u);
}

TEST(PcdFile, IsReadByPcl) {
  const imaging::TemporaryFolder folder;
  const std::string path = folder / "cloud.pcd";
  PointCloud cloud{2, 1, {{{1, 2, 3}, 0x102030, 5}, {{4, 5, 6}, 0xFFFFFF, 0}}};
  std::ofstream(path, std::ios::binary) << PcdFile(cloud);
  pcl::PointCloud<pcl::PointXYZRGBL> read;
  ASSERT_EQ(pcl::io::loadPCDFile(path, read), 0);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].getVector3fMap(), Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(read[0].r, 0x10);
  EXPECT_EQ(read[0].b, 0x30);
  EXPECT_EQ(read[0].label, 5u);
  EXPECT_EQ(read[1].label, 0u);
}

}  // namespace
}  // namespace declutter
