#include "modules/model_verifier/ray_kernels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <hwy/targets.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <random>
#include <vector>

#include "modules/geometry/solid.h"

namespace declutter {
namespace {

constexpr int kColumns = 75, kRows = 60, kStride = kColumns + static_cast<int>(kRayPadding);
constexpr RayLimits kLimits = {0.005f, 0.006f, 0.8f, 0.012f, 0.015f, 0.004f, 0.85f};

// A solid that leans toward the camera, 0.9 m from it, above a support plane at 0.8 m below.
Solid LeaningSolid(Shape shape) {
  Solid solid;
  solid.shape = shape;
  solid.X_CO = Eigen::Translation3d(0.01, -0.02, 0.9) *
               Eigen::AngleAxisd(2.3, Eigen::Vector3d::UnitX()) *
               Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ());
  solid.size = Eigen::Vector3d(0.16, shape == Shape::kBox ? 0.1 : 0.16, 0.14);
  return solid;
}

RaySolid AsRaySolid(const Solid& solid) {
  RaySolid made;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  made.is_cylinder = solid.shape == Shape::kCylinder;
  for (int i = 0; i < 3; ++i) {
    made.half_size[i] = static_cast<float>(0.5 * solid.size[i]);
    made.camera_O[i] = static_cast<float>(X_OC.translation()[i]);
    for (int j = 0; j < 3; ++j) made.R_OC[3 * i + j] = static_cast<float>(X_OC.linear()(i, j));
  }
  made.support[1] = -1;
  made.support[3] = 0.1f;
  return made;
}

// Depths and normals at random, many of them on the solid or beside its top face.
struct RandomImage {
  std::vector<float> ray_x, ray_y, z, n[3];

  explicit RandomImage(const Solid& solid) : ray_x(kStride), ray_y(kRows) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (size_t u = 0; u < ray_x.size(); ++u) ray_x[u] = 0.005f * (static_cast<float>(u) - 37);
    for (size_t v = 0; v < ray_y.size(); ++v) ray_y[v] = 0.005f * (static_cast<float>(v) - 30);
    for (auto* plane : {&z, &n[0], &n[1], &n[2]}) plane->resize(kStride * kRows);
    const Eigen::Vector3d top = solid.X_CO * Eigen::Vector3d(0, 0, 0.5 * solid.size.z());
    const Eigen::Vector3d up = solid.X_CO.linear().col(2);
    for (int v = 0; v < kRows; ++v) {
      for (int u = 0; u < kColumns; ++u) {
        const auto i = static_cast<size_t>(v * kStride + u);
        const Eigen::Vector3d ray(ray_x[static_cast<size_t>(u)], ray_y[static_cast<size_t>(v)], 1);
        const double on_top = up.dot(top) / up.dot(ray);
        z[i] = static_cast<float>(random() % 8 == 0   ? 0
                                  : random() % 2 == 0 ? on_top + 0.004 * unit(random)
                                                      : 0.9 + 0.1 * unit(random));
        if (random() % 5 == 0) continue;
        Eigen::Vector3f normal = up.cast<float>();
        normal += 0.6f * Eigen::Vector3f(unit(random), unit(random), unit(random));
        for (int axis = 0; axis < 3; ++axis) n[axis][i] = normal.normalized()[axis];
      }
    }
  }

  RayWindow Window() const {
    return {ray_x.data(),
            ray_y.data(),
            z.data(),
            kStride,
            n[0].data(),
            n[1].data(),
            n[2].data(),
            kStride,
            0,
            kColumns,
            2,
            kColumns - 3,
            1,
            kRows - 1};
  }
};

struct Sorted {
  RayCounts counts;
  std::vector<int32_t> explained, fits, hollow, overhanging;
};

Sorted Cast(const Solid& solid, const RandomImage& image) {
  Sorted sorted;
  for (auto* list : {&sorted.explained, &sorted.fits, &sorted.hollow, &sorted.overhanging}) {
    list->resize(kRows * kColumns + kRayPadding);
  }
  sorted.counts.explained = sorted.explained.data();
  sorted.counts.fits = sorted.fits.data();
  sorted.counts.hollow = sorted.hollow.data();
  sorted.counts.overhanging = sorted.overhanging.data();
  CastWindow(AsRaySolid(solid), image.Window(), kLimits, &sorted.counts);
  sorted.explained.resize(static_cast<size_t>(sorted.counts.num_explained));
  sorted.fits.resize(sorted.explained.size());
  sorted.hollow.resize(static_cast<size_t>(sorted.counts.num_hollow));
  sorted.overhanging.resize(static_cast<size_t>(sorted.counts.num_overhanging));
  return sorted;
}

bool IsInside(const Solid& solid, const Eigen::Vector3d& p_O) {
  const Eigen::Vector3d q = p_O.cwiseAbs() - 0.5 * solid.size;
  if (solid.shape == Shape::kBox) return q.maxCoeff() < 0;
  return q.z() < 0 && p_O.head<2>().norm() < solid.radius();
}

// One pixel at a time, in double precision, with rays that are followed in small steps.
class StepByStep {
 public:
  StepByStep(const Solid& solid, const RandomImage& image) : solid_(solid), image_(image) {
    const RayWindow window = image.Window();
    for (int v = window.v_begin; v < window.v_end; ++v) {
      for (int u = window.u_begin; u < window.u_end; ++u) See(u, v);
    }
  }

  const RayCounts& counts() const { return counts_; }
  const std::vector<int32_t>& overhanging() const { return overhanging_; }
  double fit() const { return fit_; }

 private:
  void See(int u, int v) {
    const Eigen::Vector3d ray(image_.ray_x[static_cast<size_t>(u)],
                              image_.ray_y[static_cast<size_t>(v)], 1);
    const auto i = static_cast<size_t>(v * kStride + u);
    const double z = image_.z[i];
    const Eigen::Isometry3d X_OC = solid_.X_CO.inverse();
    const Eigen::Vector3d n_O =
        X_OC.linear() * Eigen::Vector3d(image_.n[0][i], image_.n[1][i], image_.n[2][i]);
    const Eigen::Vector3d p = X_OC * (z * ray);
    double z_in = 0, z_out = 0;
    for (double step = 0.7; step < 1.1; step += 2e-5) {
      if (!IsInside(solid_, X_OC * (step * ray))) continue;
      if (z_in == 0) z_in = step;
      z_out = step;
    }
    const Eigen::Vector3d half = 0.5 * solid_.size;
    const bool is_cylinder = solid_.shape == Shape::kCylinder;
    const double side = is_cylinder
                            ? p.head<2>().norm() - half.x()
                            : std::max(std::abs(p.x()) - half.x(), std::abs(p.y()) - half.y());
    const double end = std::abs(p.z()) - half.z();
    const double tolerance = std::max(0.005, 0.006 * z * z);
    const double height = 0.1 - z * ray.y();
    if (z_in == 0) {
      if (z > 0 && std::abs(p.z() - half.z()) <= 0.004 && side >= 0 && side <= 0.015 &&
          height >= tolerance && (n_O.isZero() || n_O.z() > 0.85)) {
        ++counts_.num_overhanging;
        overhanging_.push_back(v * kColumns + u);
      }
      return;
    }
    if (z == 0) {
      ++counts_.num_unknown;
      return;
    }
    const Eigen::Vector3d entry = X_OC * (z_in * ray);
    const bool through_top = std::abs(entry.z() - half.z()) < 1e-3 && entry.z() < half.z() &&
                             entry.head<2>().norm() < half.x() - 2e-4;
    const double distance = DistanceToSurface(p);
    if (std::abs(distance) < tolerance && height >= 0.8 * tolerance) {
      const auto normal = NormalAt(p, side, end, tolerance);
      const double normal_fit = normal && !n_O.isZero() ? (normal->dot(n_O) - 0.85) / 0.15 : 1;
      counts_.num_contradicting += normal_fit < 0;
      counts_.num_explained += normal_fit >= 0;
      if (normal_fit >= 0) fit_ += normal_fit * (1 - std::pow(distance / tolerance, 2));
    } else if (z < z_in) {
      ++counts_.num_occluded;
    } else if (is_cylinder && through_top && distance < 0) {
      ++counts_.num_hollow;
    } else {
      const Eigen::Vector3d exit = X_OC * (z_out * ray);
      const bool through_ends = std::abs(std::abs(entry.z() - exit.z()) - 2 * half.z()) < 1e-4;
      counts_.num_violating += (through_ends ? z : std::min(z, z_out)) - z_in > tolerance;
    }
  }

  double DistanceToSurface(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d half = 0.5 * solid_.size;
    Eigen::Vector3d q = p.cwiseAbs() - half;
    if (solid_.shape == Shape::kCylinder) {
      q = Eigen::Vector3d(p.head<2>().norm() - half.x(), -1, std::abs(p.z()) - half.z());
    }
    return q.maxCoeff() < 0 ? q.maxCoeff() : q.cwiseMax(0.0).norm();
  }

  // The side of an axis that the camera is on where that may be, else that of the point.
  double SideOf(int axis, double position, double tolerance) const {
    const double seen = solid_.X_CO.inverse().translation()[axis] < 0 ? -1 : 1;
    if (seen * position > 0.5 * solid_.size[axis] - tolerance) return seen;
    return position < 0 ? -1 : 1;
  }

  std::optional<Eigen::Vector3d> NormalAt(const Eigen::Vector3d& p, double side, double end,
                                          double tolerance) const {
    const Eigen::Vector3d along_z(0, 0, SideOf(2, p.z(), tolerance));
    if (solid_.shape == Shape::kCylinder) {
      if (std::min(side, end) > -0.012) return std::nullopt;
      return side > end ? Eigen::Vector3d(p.x(), p.y(), 0).normalized() : along_z;
    }
    Eigen::Vector3d q = p.cwiseAbs() - 0.5 * solid_.size;
    int face = 0;
    q.maxCoeff(&face);
    q[face] = -1;
    if (q.maxCoeff() > -0.012) return std::nullopt;
    return Eigen::Vector3d(SideOf(face, p[face], tolerance) * Eigen::Vector3d::Unit(face));
  }

  const Solid& solid_;
  const RandomImage& image_;
  RayCounts counts_;
  std::vector<int32_t> overhanging_;
  double fit_ = 0;
};

class RayKernels : public testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(OnEachShape, RayKernels, testing::Values(Shape::kBox, Shape::kCylinder));

TEST_P(RayKernels, SortPixelsAsStepsAlongEachRayDo) {
  const Solid solid = LeaningSolid(GetParam());
  const RandomImage image(solid);
  const Sorted sorted = Cast(solid, image);
  const StepByStep reference(solid, image);
  const RayCounts& expected = reference.counts();
  constexpr int kRounding = 4;  // [px] whose rays graze an edge
  EXPECT_NEAR(sorted.counts.num_explained, expected.num_explained, kRounding);
  EXPECT_NEAR(sorted.counts.num_hollow, expected.num_hollow, kRounding);
  EXPECT_NEAR(sorted.counts.num_contradicting, expected.num_contradicting, kRounding);
  EXPECT_NEAR(sorted.counts.num_occluded, expected.num_occluded, kRounding);
  EXPECT_NEAR(sorted.counts.num_violating, expected.num_violating, kRounding);
  EXPECT_NEAR(sorted.counts.num_overhanging, expected.num_overhanging, kRounding);
  std::vector<int32_t> different;
  std::set_symmetric_difference(sorted.overhanging.begin(), sorted.overhanging.end(),
                                reference.overhanging().begin(), reference.overhanging().end(),
                                std::back_inserter(different));
  EXPECT_LE(different.size(), static_cast<size_t>(kRounding));
  EXPECT_NEAR(sorted.counts.num_unknown, expected.num_unknown, kRounding);
  EXPECT_NEAR(static_cast<double>(sorted.counts.fit) / kFitUnit, reference.fit(), kRounding);
  EXPECT_GT(expected.num_explained, 100);
  EXPECT_GT(expected.num_contradicting, 20);
  EXPECT_GT(expected.num_occluded, 20);
  EXPECT_GT(expected.num_violating, 20);
  EXPECT_GT(expected.num_overhanging, 20);
  EXPECT_GT(expected.num_unknown, 20);
}

TEST_P(RayKernels, GiveTheSameWithEveryInstructionSet) {
  const Solid solid = LeaningSolid(GetParam());
  const RandomImage image(solid);
  std::optional<Sorted> first;
  std::optional<int> first_num_near;
  for (const int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    const Sorted sorted = Cast(solid, image);
    if (!first) first = sorted;
    EXPECT_EQ(sorted.explained, first->explained) << hwy::TargetName(target);
    EXPECT_EQ(sorted.fits, first->fits) << hwy::TargetName(target);
    EXPECT_EQ(sorted.hollow, first->hollow) << hwy::TargetName(target);
    EXPECT_EQ(sorted.overhanging, first->overhanging) << hwy::TargetName(target);
    EXPECT_EQ(sorted.counts.fit, first->counts.fit);
    EXPECT_EQ(sorted.counts.num_violating, first->counts.num_violating);
    const int num_near = CountNear(AsRaySolid(solid), image.Window(), kLimits, 0.01f);
    if (!first_num_near) first_num_near = num_near;
    EXPECT_EQ(num_near, *first_num_near);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

TEST_P(RayKernels, CountWhatIsNearAndAboveTheSupport) {
  const Solid solid = LeaningSolid(GetParam());
  const RandomImage image(solid);
  const RayWindow window = image.Window();
  int expected = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const double z = image.z[static_cast<size_t>(v * kStride + u)];
      const Eigen::Vector3d p_C = z * Eigen::Vector3d(window.ray_x[u], window.ray_y[v], 1);
      Solid grown = solid;
      grown.size.array() += 0.02;
      expected += z > 0 && 0.1 - p_C.y() > 0.8 * std::max(0.005, 0.006 * z * z) &&
                  IsInside(grown, solid.X_CO.inverse() * p_C);
    }
  }
  const int num = CountNear(AsRaySolid(solid), window, kLimits, 0.01f);
  EXPECT_LE(num, expected);  // near a corner the grown solid has more
  EXPECT_GT(num, 0.95 * expected);
}

}  // namespace
}  // namespace declutter
