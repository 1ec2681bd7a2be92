#include "modules/plane_filter/scene_roles.h"

#include <algorithm>
#include <cmath>

#include "modules/plane_filter/prism.h"

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

// Planes up to this angle are both level: they may be distorted differently [rad].
constexpr double kMaxLevelAngle = 0.18;

struct Support {
  Plane plane;        // in C
  Prism prism;        // over its hull
  double pixels = 0;  // weighted number of pixels in the plane
  double load = 0;    // weighted number of pixels that stand on it
};

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

// Part of the marked pixels whose points in C satisfy a condition.
template <typename Condition>
double PartOf(const InverseDepth& grid, const PixelMask& mask, Condition condition) {
  int num_pixels = 0;
  int num_true = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      if (!mask[grid.Index(u, v)]) continue;
      ++num_pixels;
      num_true += condition(PointOf(grid, u, v));
    }
  }
  return num_pixels > 0 ? static_cast<double>(num_true) / num_pixels : 0;
}

// Whether most of a region is over the hull of a support, within the heights of objects.
bool StandsOn(const InverseDepth& grid, const PixelMask& region, const Support& support,
              const PlaneFilterConfig& config) {
  return PartOf(grid, region, [&](const Eigen::Vector3d& p_C) {
           const double height = support.plane.Height(p_C);
           return height > config.object_height_m() && height < config.max_height_m() &&
                  support.prism.Contains(p_C);
         }) > kStandingPart;
}

bool IsWall(const InverseDepth& grid, const PlaneCandidate& candidate, const Plane& main_plane,
            const PixelMask& main_region) {
  const Plane plane = candidate.plane.ToPlane();
  if (plane.normal.dot(main_plane.normal) > std::cos(kMinWallAngle)) return false;
  const double part_behind = PartOf(
      grid, main_region, [&](const Eigen::Vector3d& p_C) { return plane.Height(p_C) < -kBehind; });
  const double lost_angle = kLostRows * (grid.ray_y[1] - grid.ray_y[0]);
  const double part_low = PartOf(grid, candidate.region, [&](const Eigen::Vector3d& p_C) {
    return main_plane.Height(p_C) < kMaxWallBase + lost_angle * p_C.z();
  });
  return part_behind < kMaxPartBehindWall && part_low > 0;
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

// Marks the region and the inliers at its outline, which regions leave out.
void MarkWithOutline(const InverseDepth& grid, const PlaneCandidate& candidate,
                     const PlaneFilterConfig& config, PixelMask* mask) {
  const float band = static_cast<float>(config.inlier_sigmas() * config.inverse_depth_sigma());
  const PixelMask inliers = PlaneInliers(grid, candidate.plane, band);
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      if (!candidate.region[grid.Index(u, v)]) continue;
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

// Pixels that cannot be the load of a plane: those of level planes, which may be supports
// themselves, and those of planes that stand on no other, or are a wall to it.
PixelMask NotLoad(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
                  const std::vector<Support>& supports, const PlaneFilterConfig& config) {
  PixelMask excluded(grid.values.size());
  for (size_t j = 0; j < candidates.size(); ++j) {
    bool load = false;
    for (size_t k = 0; k < supports.size() && !load; ++k) {
      load = k != j && Angle(supports[k].plane.normal, supports[j].plane.normal) > kMaxLevelAngle &&
             StandsOn(grid, candidates[j].region, supports[k], config) &&
             !IsWall(grid, candidates[j], supports[k].plane, candidates[k].region);
    }
    if (!load) MarkWithOutline(grid, candidates[j], config, &excluded);
  }
  return excluded;
}

// Whether another sizeable level plane is as far above plane k as a table above the floor.
bool IsFloor(const std::vector<PlaneCandidate>& candidates, const std::vector<Support>& supports,
             size_t k, double min_pixels, const PlaneFilterConfig& config) {
  for (size_t j = 0; j < supports.size(); ++j) {
    if (candidates[j].num_pixels >= min_pixels &&
        supports[k].plane.d - supports[j].plane.d > config.min_table_height_m() &&
        Angle(supports[k].plane.normal, supports[j].plane.normal) < kMaxLevelAngle) {
      return true;
    }
  }
  return false;
}

// Adds every pixel to its own plane, or to the load of the plane that it stands on: the highest
// one under it.
void Weigh(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
           const PixelMask& not_load, const PlaneFilterConfig& config,
           std::vector<Support>* supports) {
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const size_t i = grid.Index(u, v);
      if (grid.values[i] <= 0) continue;
      const double weight = CentreWeight(grid, u, v);
      const Eigen::Vector3d p_C = PointOf(grid, u, v);
      Support* carrier = nullptr;
      double carrier_height = config.max_height_m();
      for (size_t k = 0; k < supports->size(); ++k) {
        Support& support = (*supports)[k];
        if (candidates[k].region[i]) support.pixels += weight;
        const double height = support.plane.Height(p_C);
        if (not_load[i] || height < config.object_height_m() || height > carrier_height ||
            !support.prism.Contains(p_C)) {
          continue;
        }
        carrier = &support;
        carrier_height = height;
      }
      if (carrier != nullptr) carrier->load += weight;
    }
  }
}

double LevelWeight(double tilt, const PlaneFilterConfig& config) {
  if (tilt <= config.level_tilt_rad()) return 1;
  if (tilt >= config.wall_tilt_rad()) return config.wall_weight();
  const double steepness =
      (tilt - config.level_tilt_rad()) / (config.wall_tilt_rad() - config.level_tilt_rad());
  return 1 + steepness * (config.wall_weight() - 1);
}

double Score(const InverseDepth& grid, const Support& support, bool is_floor,
             const PlaneFilterConfig& config) {
  const double bare_load = kBareLoad * static_cast<double>(grid.values.size());
  const double tilt = Angle(support.plane.normal, -Eigen::Vector3d::UnitY());
  const double level = LevelWeight(tilt, config);
  const double high = is_floor ? config.floor_weight() : 1;
  return level * high * std::sqrt(support.pixels * (support.load + bare_load));
}

}  // namespace

SceneRoles AssignRoles(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
                       const PlaneFilterConfig& config) {
  SceneRoles roles;
  if (candidates.empty()) return roles;
  std::vector<Support> supports;
  for (const PlaneCandidate& candidate : candidates) {
    const auto hull_T = HullInPlane(grid, candidate.plane, candidate.region);
    supports.push_back({candidate.plane.ToPlane(), Prism(candidate.plane, hull_T, 0.0)});
  }
  Weigh(grid, candidates, NotLoad(grid, candidates, supports, config), config, &supports);

  const double min_pixels = kMinFurtherSupport * static_cast<double>(grid.values.size());
  size_t main = 0;
  double best_score = -1;
  for (size_t k = 0; k < supports.size(); ++k) {
    const bool is_floor = IsFloor(candidates, supports, k, min_pixels, config);
    const double score = Score(grid, supports[k], is_floor, config);
    if (score <= best_score) continue;
    best_score = score;
    main = k;
  }
  roles.supports.push_back(main);
  for (size_t k = 0; k < supports.size(); ++k) {
    if (k == main) continue;
    const double angle = Angle(supports[k].plane.normal, supports[main].plane.normal);
    if (IsWall(grid, candidates[k], supports[main].plane, candidates[main].region)) {
      roles.walls.push_back(k);
    } else if (angle <= config.max_parallel_angle_rad() && candidates[k].num_pixels >= min_pixels &&
               !StandsOn(grid, candidates[k].region, supports[main], config)) {
      roles.supports.push_back(k);
    }
  }
  std::stable_sort(roles.supports.begin() + 1, roles.supports.end(), [&](size_t a, size_t b) {
    return candidates[a].num_pixels > candidates[b].num_pixels;
  });
  return roles;
}

}  // namespace declutter
