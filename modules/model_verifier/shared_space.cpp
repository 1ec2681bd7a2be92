#include "modules/model_verifier/shared_space.h"

#include <algorithm>
#include <array>

#include "modules/model_verifier/projection.h"
#include "modules/model_verifier/ray_kernels.h"

namespace declutter {
namespace {

// The centres of kSteps^3 equal parts of a solid of size 1.
class Samples {
 public:
  explicit Samples(Shape shape) {
    constexpr int kSteps = 5;
    const auto at = [](int i) { return (static_cast<float>(i) + 0.5f) / kSteps - 0.5f; };
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const bool is_inside = at(i) * at(i) + at(j) * at(j) <= 0.25f;
        if (shape == Shape::kCylinder && !is_inside) continue;
        for (int k = 0; k < kSteps; ++k, ++num_) {
          x_[num_] = at(i);
          y_[num_] = at(j);
          z_[num_] = at(k);
        }
      }
    }
  }

  SamplePoints View() const { return {x_.data(), y_.data(), z_.data(), num_}; }

 private:
  std::array<float, 125 + kRayPadding> x_{}, y_{}, z_{};
  size_t num_ = 0;
};

// Share of the volume of `a` that lies inside `b`.
double SharedVolume(const Solid& a, const Solid& b) {
  static const Samples kBox(Shape::kBox), kCylinder(Shape::kCylinder);
  const double min_depth = std::min(0.004, 0.15 * a.size.minCoeff());  // [m]
  SamplePoints points = (a.shape == Shape::kBox ? kBox : kCylinder).View();
  const Eigen::Isometry3d X_BA = b.X_CO.inverse() * a.X_CO;
  for (int i = 0; i < 3; ++i) {
    points.origin[i] = static_cast<float>(X_BA.translation()[i]);
    for (int j = 0; j < 3; ++j) {
      points.axes[3 * i + j] = static_cast<float>(X_BA.linear()(i, j) * a.size[j]);
    }
  }
  return static_cast<double>(
             CountInside(AsRaySolid(b, Plane()), points, static_cast<float>(min_depth))) /
         static_cast<double>(points.num);
}

// False when the sphere around one does not reach into the other.
bool MayShareSpace(const Solid& a, const Solid& b) {
  const Eigen::Vector3d ab = b.X_CO.translation() - a.X_CO.translation();
  const auto reaches = [&](const Solid& sphere, const Solid& solid) {
    const Eigen::Vector3d ab_O = solid.X_CO.linear().transpose() * ab;
    return (ab_O.cwiseAbs() - 0.5 * solid.size).maxCoeff() < 0.5 * sphere.size.norm();
  };
  return reaches(a, b) && reaches(b, a);
}

}  // namespace

bool ShareSpace(const Solid& a, const Solid& b, double max_share) {
  return MayShareSpace(a, b) && (SharedVolume(a, b) > max_share || SharedVolume(b, a) > max_share);
}

}  // namespace declutter
