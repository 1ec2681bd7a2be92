#include "modules/plane_filter/scene_roles.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace declutter {
namespace {

// A plane without anything on it counts as carrying this part of the image.
constexpr double kBareLoad = 0.002;

// Weight of pixels at the image's corners; in the middle it is 1.
constexpr double kCornerWeight = 0.4;

// Part of a plane over the hull of another from which it stands on that one.
constexpr double kStandingPart = 0.5;

// Smallest part of the image that a further support fills.
constexpr double kMinFurtherSupport = 0.02;

// Part of the main support behind a wall, from which it is a face of an object instead.
constexpr double kMaxPartBehindWall = 0.01;

// A wall's lower end is at most this high over the support [m], and as many rows of the grid higher
// as regions lose at their outline; or it is hidden, and it may as well be an object at the border.
constexpr double kMaxWallBase = 0.02;
constexpr double kLostRows = 2;

// Points are behind a plane from this distance [m].
constexpr double kBehind = 0.03;

constexpr double kMinWallAngle = 0.8;  // [rad] to the main support

// Tops of objects, even several of one height, are closed over at most this area [m^2].
constexpr double kMaxTopArea = 0.4 * 0.3;

// Planes up to this angle are both level: they may be distorted differently [rad].
constexpr double kMaxLevelAngle = 0.18;

using Candidates = std::vector<PlaneCandidates::Candidate>;

double CentreWeight(const InverseDepth& grid, int u, int v) {
  const double x = 2.0 * u / grid.width - 1;
  const double y = 2.0 * v / grid.height - 1;
  return 1 - (1 - kCornerWeight) * 0.5 * (x * x + y * y);
}

Eigen::Vector3d PointOf(const InverseDepth& grid, int u, int v) {
  return Eigen::Vector3d(grid.ray_x[static_cast<size_t>(u)], grid.ray_y[static_cast<size_t>(v)],
                         1) /
         grid.values[grid.Index(u, v)];
}

// Part of the points that satisfy a condition.
template <typename Condition>
double PartOf(const std::vector<Eigen::Vector3d>& points, Condition condition) {
  if (points.empty()) return 0;
  const auto num_true = std::count_if(points.begin(), points.end(), condition);
  return static_cast<double>(num_true) / static_cast<double>(points.size());
}

// Whether most of the region of a plane is over the hull of a carrier, within the heights of
// objects.
bool StandsOn(const Carrier& plane, const Carrier& carrier, const PlaneFilterConfig& config) {
  return PartOf(plane.region, [&](const Eigen::Vector3d& p_C) {
           const double height = carrier.plane.Height(p_C);
           return height > config.object_height_m() && height < config.max_height_m() &&
                  carrier.prism.Contains(p_C);
         }) > kStandingPart;
}

// Whether a plane is a wall to the main support.
bool IsWall(const InverseDepth& grid, const Carrier& wall, const Carrier& main) {
  if (wall.plane.normal.dot(main.plane.normal) > std::cos(kMinWallAngle)) return false;
  const double part_behind = PartOf(
      main.region, [&](const Eigen::Vector3d& p_C) { return wall.plane.Height(p_C) < -kBehind; });
  const double lost_angle = kLostRows * (grid.ray_y[1] - grid.ray_y[0]);
  const double part_low = PartOf(wall.region, [&](const Eigen::Vector3d& p_C) {
    return main.plane.Height(p_C) < kMaxWallBase + lost_angle * p_C.z();
  });
  return part_behind < kMaxPartBehindWall && part_low > 0;
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

// Marks the region of candidate k and the inliers at its outline, which regions leave out.
void MarkWithOutline(const InverseDepth& grid, const PlaneCandidates& candidates, size_t k,
                     const PixelMask& inliers, PixelMask* mask) {
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      if (!candidates.IsIn(grid.Index(u, v), k)) continue;
      // Regions leave the outermost rows and columns out: all neighbours exist.
      for (int dv = -1; dv <= 1; ++dv) {
        for (int du = -1; du <= 1; ++du) {
          const size_t i = grid.Index(u + du, v + dv);
          (*mask)[i] |= inliers[i];
        }
      }
    }
  }
}

// [m^2] of the hull of a plane where depth is measured, and not under it: all of a table, whatever
// stands on it, but not what lies between the tops of boxes of one height.
double ClosedArea(const InverseDepth& grid, const Carrier& carrier) {
  const double ray_area = (grid.ray_x[1] - grid.ray_x[0]) * (grid.ray_y[1] - grid.ray_y[0]);
  double area = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const Eigen::Vector3d ray(grid.ray_x[static_cast<size_t>(u)],
                                grid.ray_y[static_cast<size_t>(v)], 1);
      const double toward = -carrier.plane.normal.dot(ray);
      if (toward <= 0 || grid.values[grid.Index(u, v)] <= 0) continue;
      const double z = carrier.plane.d / toward;
      if (!carrier.prism.Contains(z * ray) ||
          carrier.plane.Height(PointOf(grid, u, v)) < -kBehind) {
        continue;
      }
      area += z * z * z * ray_area / carrier.plane.d;
    }
  }
  return area;
}

// Whether another level plane, too large for tops of objects, is as far above plane k as a table
// above the floor.
bool IsFloor(const InverseDepth& grid, const std::vector<Carrier>& carriers, size_t num_planes,
             size_t k, const PlaneFilterConfig& config) {
  for (size_t j = 0; j < num_planes; ++j) {
    if (carriers[k].plane.d - carriers[j].plane.d > config.min_table_height_m() &&
        Angle(carriers[k].plane.normal, carriers[j].plane.normal) < kMaxLevelAngle &&
        ClosedArea(grid, carriers[j]) > kMaxTopArea) {
      return true;
    }
  }
  return false;
}

double LevelWeight(double tilt, const PlaneFilterConfig& config) {
  if (tilt > M_PI / 2) {
    return std::max(config.wall_weight(),
                    config.upside_down_weight() * LevelWeight(M_PI - tilt, config));
  }
  if (tilt <= config.level_tilt_rad()) return 1;
  if (tilt >= config.wall_tilt_rad()) return config.wall_weight();
  const double steepness =
      (tilt - config.level_tilt_rad()) / (config.wall_tilt_rad() - config.level_tilt_rad());
  return 1 + steepness * (config.wall_weight() - 1);
}

double Score(const InverseDepth& grid, const Carrier& carrier, bool is_floor,
             const PlaneFilterConfig& config) {
  const double bare_load = kBareLoad * static_cast<double>(grid.values.size());
  const double tilt = Angle(carrier.plane.normal, -Eigen::Vector3d::UnitY());
  const double level = LevelWeight(tilt, config);
  const double high = is_floor ? config.floor_weight() : 1;
  return level * high * std::sqrt(carrier.pixels * (carrier.load + bare_load));
}

double MinSupportPixels(const InverseDepth& grid) {
  return kMinFurtherSupport * static_cast<double>(grid.values.size());
}

}  // namespace

void SceneRoles::MakeCarriers(const InverseDepth& grid, const PlaneCandidates& candidates) {
  carriers_.resize(std::max(carriers_.size(), candidates.planes.size()));
  for (size_t k = 0; k < candidates.planes.size(); ++k) {
    const InversePlane& plane = candidates.planes[k].plane;
    const auto& hull_T = hull_.Find(grid, plane, candidates.region_of, static_cast<uint8_t>(k + 1));
    Carrier& carrier = carriers_[k];
    carrier.plane = plane.ToPlane();
    carrier.prism = Prism(plane, hull_T, 0.0, std::move(carrier.prism));
    carrier.region.clear();
    carrier.pixels = carrier.load = 0;
  }
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const size_t own = candidates.region_of[grid.Index(u, v)];
      if (own > 0) carriers_[own - 1].region.push_back(PointOf(grid, u, v));
    }
  }
}

// Pixels that cannot be the load of a plane: those of level planes, which may be supports
// themselves, and those of planes that stand on no other, or are a wall to it.
void SceneRoles::FindNotLoad(const InverseDepth& grid, const PlaneCandidates& candidates,
                             double sigma) {
  const float band = static_cast<float>(config_.inlier_sigmas() * sigma);
  const size_t num = candidates.planes.size();
  not_load_.assign(grid.values.size(), 0);
  for (size_t j = 0; j < num; ++j) {
    const Plane& plane = carriers_[j].plane;
    bool load = false;
    for (size_t k = 0; k < num && !load; ++k) {
      load = k != j && Angle(carriers_[k].plane.normal, plane.normal) > kMaxLevelAngle &&
             StandsOn(carriers_[j], carriers_[k], config_) &&
             !IsWall(grid, carriers_[j], carriers_[k]);
    }
    if (load) continue;
    inliers_ = PlaneInliers(grid, candidates.planes[j].plane, band, std::move(inliers_));
    MarkWithOutline(grid, candidates, j, inliers_, &not_load_);
  }
}

// Adds every pixel to its own plane, or to the load of the plane that it stands on: the highest
// one under it.
void SceneRoles::Weigh(const InverseDepth& grid, const PlaneCandidates& candidates) {
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const size_t i = grid.Index(u, v);
      if (grid.values[i] <= 0) continue;
      const double weight = CentreWeight(grid, u, v);
      const size_t own = candidates.region_of[i];
      if (own > 0) carriers_[own - 1].pixels += weight;
      if (not_load_[i]) continue;
      const Eigen::Vector3d p_C = PointOf(grid, u, v);
      Carrier* carrier = nullptr;
      double carrier_height = config_.max_height_m();
      for (size_t k = 0; k < candidates.planes.size(); ++k) {
        const double height = carriers_[k].plane.Height(p_C);
        if (height < config_.object_height_m() || height > carrier_height ||
            !carriers_[k].prism.Contains(p_C)) {
          continue;
        }
        carrier = &carriers_[k];
        carrier_height = height;
      }
      if (carrier != nullptr) carrier->load += weight;
    }
  }
}

size_t SceneRoles::MainSupport(const InverseDepth& grid, const PlaneCandidates& candidates) const {
  size_t main = 0;
  double best_score = -1;
  for (size_t k = 0; k < candidates.planes.size(); ++k) {
    const bool is_floor = IsFloor(grid, carriers_, candidates.planes.size(), k, config_);
    const double score = Score(grid, carriers_[k], is_floor, config_);
    if (score <= best_score) continue;
    best_score = score;
    main = k;
  }
  return main;
}

void SceneRoles::Assign(const InverseDepth& grid, const PlaneCandidates& candidates, double sigma) {
  const Candidates& planes = candidates.planes;
  supports_.clear();
  walls_.clear();
  if (planes.empty()) return;
  MakeCarriers(grid, candidates);
  FindNotLoad(grid, candidates, sigma);
  Weigh(grid, candidates);
  const size_t main = MainSupport(grid, candidates);
  const Plane& main_plane = carriers_[main].plane;
  supports_.push_back(main);
  for (size_t k = 0; k < planes.size(); ++k) {
    if (k == main) continue;
    const Plane& plane = carriers_[k].plane;
    if (IsWall(grid, carriers_[k], carriers_[main])) {
      walls_.push_back(planes[k].plane);
    } else if (Angle(plane.normal, main_plane.normal) <= config_.max_parallel_angle_rad() &&
               planes[k].num_pixels >= MinSupportPixels(grid) &&
               !StandsOn(carriers_[k], carriers_[main], config_)) {
      supports_.push_back(k);
    }
  }
  std::sort(supports_.begin() + 1, supports_.end(), [&](size_t a, size_t b) {
    return planes[a].num_pixels != planes[b].num_pixels
               ? planes[a].num_pixels > planes[b].num_pixels
               : a < b;
  });
}

}  // namespace declutter
