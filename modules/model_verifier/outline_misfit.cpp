#include "modules/model_verifier/outline_misfit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "modules/geometry/depth_image.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {
namespace {

constexpr size_t kPartsPerSide = 6;
constexpr size_t kNumSides = 4;
constexpr size_t kNumParts = kNumSides * kPartsPerSide;  // of an outline
// [px] without depth, as in a shadow, beyond which something lower is seen.
constexpr int kMaxGap = 8;

// The upper face of a solid, in an image.
class TopFace {
 public:
  TopFace(const Solid& solid, const DepthImage& image)
      : image_(image), X_OC_(solid.X_CO.inverse()), height_(0.5 * solid.height()) {}

  bool IsSeenFromAbove() const { return X_OC_.translation().z() > height_; }

  enum class Place : int8_t { kUnknown, kOn, kBelow, kAbove };
  // Of what pixel (u, v) measured; unknown outside the image.
  Place PlaceOf(int u, int v) const {
    const PinholeCamera& camera = image_.camera;
    if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) return Place::kUnknown;
    const double z = image_.DepthAt(u, v);
    if (z == 0) return Place::kUnknown;
    const double above =
        X_OC_.linear().row(2).dot(z * camera.Ray(u, v)) + X_OC_.translation().z() - height_;
    if (std::abs(above) < SurfaceTolerance(z)) return Place::kOn;
    return above < 0 ? Place::kBelow : Place::kAbove;
  }

  // Steps (du, dv) from a pixel on the face to where it ends beside something lower; nothing when
  // it goes on, or is hidden from there.
  std::optional<double> StepsToFreeEdge(int u, int v, int du, int dv, int max_steps) const {
    int first = 0;  // step that is not on the face
    for (int k = 1; k <= (first == 0 ? max_steps : first + kMaxGap); ++k) {
      const int x = u + k * du;
      const int y = v + k * dv;
      const Place place = PlaceOf(x, y);
      if (place == Place::kOn && first == 0) continue;
      if (first == 0) first = k;
      if (place == Place::kUnknown) continue;
      // Alone it would be noise.
      const bool is_below = place == Place::kBelow && PlaceOf(x + du, y + dv) != Place::kOn;
      return is_below ? std::optional(first - 0.5) : std::nullopt;
    }
    return std::nullopt;
  }

  Eigen::Vector3d RayInO(double u, double v) const {
    return X_OC_.linear() * image_.camera.Ray(u, v);
  }
  // Where a ray meets the plane of the face, in O.
  Eigen::Vector3d Meet(const Eigen::Vector3d& ray_O) const {
    const Eigen::Vector3d camera_O = X_OC_.translation();
    return camera_O + (height_ - camera_O.z()) / ray_O.z() * ray_O;
  }

 private:
  const DepthImage& image_;
  Eigen::Isometry3d X_OC_;
  double height_;
};

// The place of a point of the upper face against the outline of the solid.
struct OutlinePlace {
  size_t part = 0;
  double distance = 0;      // [m] outward
  Eigen::Vector3d outward;  // unit normal of the outline in O
};

size_t PartAt(double position, size_t num_parts) {
  const double part = position * static_cast<double>(num_parts);
  return static_cast<size_t>(std::clamp(part, 0.0, static_cast<double>(num_parts - 1)));
}

OutlinePlace PlaceAtCircle(const Solid& solid, const Eigen::Vector3d& p) {
  const double angle = std::atan2(p.y(), p.x());
  return {PartAt(0.5 + angle / (2 * M_PI), kNumParts), p.head<2>().norm() - solid.radius(),
          Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)};
}

OutlinePlace PlaceAtRectangle(const Solid& solid, const Eigen::Vector3d& p) {
  const Eigen::Vector2d half = 0.5 * solid.size.head<2>();
  const Eigen::Vector2d out = p.head<2>().cwiseAbs() - half;
  const int axis = out.x() > out.y() ? 0 : 1;
  const int along = 1 - axis;
  const size_t side = static_cast<size_t>(2 * axis) + (p[axis] > 0 ? 1 : 0);
  return {side * kPartsPerSide + PartAt(0.5 + 0.5 * p[along] / half[along], kPartsPerSide),
          out.minCoeff() > 0 ? out.norm() : out[axis],
          std::copysign(1.0, p[axis]) * Eigen::Vector3d::Unit(axis)};
}

// Mean distances of the free edge from the parts of an outline [px].
class OutlineProfile {
 public:
  void Add(size_t part, double distance_px) {
    sums_[part] += distance_px;
    ++nums_[part];
  }

  // Mean square that is left when each side of a rectangle has moved to where it fits best.
  std::optional<double> LeftByRectangle() const {
    constexpr int kMinParts = 3;  // of a side that tells
    double squares = 0;
    int freedom = 0;
    for (size_t side = 0; side < kNumSides; ++side) {
      double sum = 0;
      double square_sum = 0;
      int num = 0;
      for (size_t part = side * kPartsPerSide; part < (side + 1) * kPartsPerSide; ++part) {
        if (!IsSeen(part)) continue;
        sum += Mean(part);
        square_sum += Mean(part) * Mean(part);
        ++num;
      }
      if (num < kMinParts) continue;
      squares += square_sum - sum * sum / num;
      freedom += num - 1;
    }
    return MeanSquare(squares, freedom);
  }

  // The same when a circle has moved and grown.
  std::optional<double> LeftByCircle() const {
    constexpr double kRegularization = 1e-3;
    Eigen::Matrix3d H = kRegularization * Eigen::Matrix3d::Identity();
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    double squares = 0;
    int freedom = -3;
    for (size_t part = 0; part < kNumParts; ++part) {
      if (!IsSeen(part)) continue;
      const double angle = 2 * M_PI * ((static_cast<double>(part) + 0.5) / kNumParts - 0.5);
      const Eigen::Vector3d J(std::cos(angle), std::sin(angle), 1);
      H += J * J.transpose();
      g += J * Mean(part);
      squares += Mean(part) * Mean(part);
      ++freedom;
    }
    return MeanSquare(squares - g.dot(H.ldlt().solve(g)), freedom);
  }

 private:
  bool IsSeen(size_t part) const { return nums_[part] >= 2; }
  double Mean(size_t part) const { return sums_[part] / nums_[part]; }
  static std::optional<double> MeanSquare(double squares, int freedom) {
    constexpr int kMinFreedom = 2;
    if (freedom < kMinFreedom) return std::nullopt;
    return std::max(0.0, squares) / freedom;
  }

  std::array<double, kNumParts> sums_ = {};
  std::array<int, kNumParts> nums_ = {};
};

}  // namespace

std::optional<double> OutlineMisfit(const Solid& solid, const RayEvidence& evidence,
                                    const Observation& observation) {
  constexpr int kDirections[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const PixelGrid& grid = observation.grid;
  const PinholeCamera& camera = observation.image.camera;
  const bool is_cylinder = solid.shape == Shape::kCylinder;
  const TopFace top(solid, observation.image);
  if (!IsUpright(solid, observation.support) || !top.IsSeenFromAbove()) return std::nullopt;
  OutlineProfile profile;
  for (const int32_t pixel : evidence.explained) {
    const int u = grid.step * (pixel % grid.columns);
    const int v = grid.step * (pixel / grid.columns);
    if (top.PlaceOf(u, v) != TopFace::Place::kOn) continue;
    for (const auto& [du, dv] : kDirections) {
      const auto steps = top.StepsToFreeEdge(u, v, du, dv, grid.step);
      if (!steps) continue;
      const Eigen::Vector3d ray_O = top.RayInO(u + *steps * du, v + *steps * dv);
      if (ray_O.z() >= 0) continue;  // it passes above the face
      const Eigen::Vector3d p = top.Meet(ray_O);
      const OutlinePlace place = is_cylinder ? PlaceAtCircle(solid, p) : PlaceAtRectangle(solid, p);
      // Of the image, a metre along the outward normal takes as much as is across the ray.
      const double cosine = place.outward.dot(ray_O.normalized());
      const double px_per_m = 0.5 * (camera.fx + camera.fy) / observation.image.DepthAt(u, v) *
                              std::sqrt(std::max(0.0, 1 - cosine * cosine));
      profile.Add(place.part, place.distance * px_per_m);
    }
  }
  const auto left = is_cylinder ? profile.LeftByCircle() : profile.LeftByRectangle();
  if (!left) return std::nullopt;
  return std::sqrt(*left);
}

}  // namespace declutter
