#include "modules/object_exporter/wireframe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

using Eigen::Vector3d;

Solid SolidAt(Shape shape, const Vector3d& position_C, const Vector3d& size) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO.translation() = position_C;
  solid.size = size;
  return solid;
}

double Length(const std::vector<WireSegment>& segments, bool faces_camera) {
  double length_m = 0;
  for (const WireSegment& piece : segments) {
    if (piece.faces_camera == faces_camera) length_m += (piece.to_C - piece.from_C).norm();
  }
  return length_m;
}

TEST(WireframeTest, BoxSeenFromItsFrontShowsTheEdgesOfOneFace) {
  const auto segments = Wireframe(SolidAt(Shape::kBox, {0, 0, 1}, {0.2, 0.1, 0.4}));
  EXPECT_NEAR(Length(segments, true), 2 * (0.2 + 0.1), 1e-9);
  EXPECT_NEAR(Length(segments, false), 2 * (0.2 + 0.1) + 4 * 0.4, 1e-9);
}

TEST(WireframeTest, BoxSeenFromACornerHidesThreeEdges) {
  const auto segments = Wireframe(SolidAt(Shape::kBox, {1, 1, 1}, {0.2, 0.1, 0.4}));
  EXPECT_NEAR(Length(segments, false), 0.2 + 0.1 + 0.4, 1e-9);
}

TEST(WireframeTest, BoxEdgesEndInItsCorners) {
  const auto segments = Wireframe(SolidAt(Shape::kBox, {0, 0, 1}, {0.2, 0.1, 0.4}));
  const auto ends_in = [&](const Vector3d& corner_C) {
    return std::any_of(segments.begin(), segments.end(), [&](const WireSegment& piece) {
      return piece.to_C.isApprox(corner_C) || piece.from_C.isApprox(corner_C);
    });
  };
  EXPECT_TRUE(ends_in({0.1, 0.05, 0.8}));
  EXPECT_TRUE(ends_in({-0.1, -0.05, 1.2}));
}

TEST(WireframeTest, CylinderSeenFromTheSideShowsHalfOfEachCircle) {
  Solid can = SolidAt(Shape::kCylinder, {0, 0, 10}, {0.1, 0.1, 0.2});
  can.X_CO.linear() = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix();
  const auto segments = Wireframe(can);
  const double circle_m = M_PI * 0.1;
  EXPECT_NEAR(Length(segments, true), circle_m + 2 * 0.2, 0.02);
  EXPECT_NEAR(Length(segments, false), circle_m, 0.02);
}

TEST(WireframeTest, SilhouetteOfACylinderIsTangentToTheLineOfSight) {
  Solid can = SolidAt(Shape::kCylinder, {0.1, 0, 0.5}, {0.16, 0.16, 0.2});
  can.X_CO.linear() = Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d axis_C = can.X_CO.linear().col(2);
  int num_side_pieces = 0;
  for (const WireSegment& piece : Wireframe(can)) {
    if ((piece.to_C - piece.from_C).normalized().cross(axis_C).norm() > 1e-6) continue;
    ++num_side_pieces;
    Vector3d normal_C = piece.from_C - can.X_CO.translation();
    normal_C -= axis_C * axis_C.dot(normal_C);
    EXPECT_NEAR(normal_C.norm(), 0.08, 1e-9);
    EXPECT_NEAR(normal_C.dot(piece.from_C), 0, 1e-9);
  }
  EXPECT_GT(num_side_pieces, 0);
}

TEST(WireframeTest, CylinderSeenAlongItsAxisHasNoSilhouette) {
  const auto segments = Wireframe(SolidAt(Shape::kCylinder, {0, 0, 1}, {0.1, 0.1, 0.2}));
  for (const WireSegment& piece : segments) EXPECT_EQ(piece.from_C.z(), piece.to_C.z());
}

}  // namespace
}  // namespace declutter
