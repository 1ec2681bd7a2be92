#include "modules/plane_filter/support_choice.h"

#include <algorithm>
#include <cmath>

#include "modules/plane_filter/prism.h"

namespace declutter {
namespace {

// A plane without anything on it counts as carrying this part of the image.
constexpr double kBareLoad = 0.01;

// Weight of pixels at the image's corners; in the middle it is 1.
constexpr double kCornerWeight = 0.4;

// Part of a plane over the hull of another from which it stands on that one.
constexpr double kStandingPart = 0.5;

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

double HeightOver(const Support& support, float x, float y, float value) {
  return support.plane.Height({x / value, y / value, 1 / value});
}

// Part of a candidate's region that is over the hull of a support, within the heights of objects.
double PartStandingOn(const InverseDepth& grid, const Support& support, const PixelMask& region,
                      const PlaneFilterConfig& config) {
  int num_pixels = 0;
  int num_standing = 0;
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      if (!region[grid.Index(u, v)]) continue;
      ++num_pixels;
      const float x = grid.ray_x[static_cast<size_t>(u)];
      const float y = grid.ray_y[static_cast<size_t>(v)];
      const float value = grid.values[grid.Index(u, v)];
      const double height = HeightOver(support, x, y, value);
      num_standing += height > config.object_height_m() && height < config.max_height_m() &&
                      support.prism.Contains(x, y, value);
    }
  }
  return num_pixels > 0 ? static_cast<double>(num_standing) / num_pixels : 0;
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
}

// Pixels that cannot be the load of a plane: those of level planes, which may be supports
// themselves, and those of planes that stand on no other, such as walls.
PixelMask NotLoad(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
                  const std::vector<Support>& supports, const PlaneFilterConfig& config) {
  PixelMask excluded(grid.values.size());
  for (size_t j = 0; j < candidates.size(); ++j) {
    bool load = false;
    for (size_t k = 0; k < supports.size() && !load; ++k) {
      if (k == j) continue;
      const double angle = Angle(supports[k].plane.normal, supports[j].plane.normal);
      load = angle > 3 * config.max_parallel_angle_rad() &&
             PartStandingOn(grid, supports[k], candidates[j].region, config) > kStandingPart;
    }
    if (load) continue;
    for (size_t i = 0; i < excluded.size(); ++i) excluded[i] |= candidates[j].region[i];
  }
  return excluded;
}

// Adds every pixel to its own plane, or to the load of the plane that it stands on: the highest
// one under it.
void Weigh(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
           const PixelMask& not_load, const PlaneFilterConfig& config,
           std::vector<Support>* supports) {
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const size_t i = grid.Index(u, v);
      const float value = grid.values[i];
      if (value <= 0) continue;
      const double weight = CentreWeight(grid, u, v);
      Support* carrier = nullptr;
      double carrier_height = config.max_height_m();
      for (size_t k = 0; k < supports->size(); ++k) {
        Support& support = (*supports)[k];
        if (candidates[k].region[i]) support.pixels += weight;
        if (not_load[i]) continue;
        const float x = grid.ray_x[static_cast<size_t>(u)];
        const float y = grid.ray_y[static_cast<size_t>(v)];
        const double height = HeightOver(support, x, y, value);
        if (height < config.object_height_m() || height > carrier_height ||
            !support.prism.Contains(x, y, value)) {
          continue;
        }
        carrier = &support;
        carrier_height = height;
      }
      if (carrier != nullptr) carrier->load += weight;
    }
  }
}

double Score(const InverseDepth& grid, const Support& support, const PlaneFilterConfig& config) {
  const double bare_load = kBareLoad * static_cast<double>(grid.values.size());
  const double tilt = Angle(support.plane.normal, -Eigen::Vector3d::UnitY());
  const double level = tilt <= config.max_tilt_rad() ? 1 : config.wall_weight();
  return level * std::sqrt(support.pixels * (support.load + bare_load));
}

}  // namespace

std::vector<size_t> ChooseSupports(const InverseDepth& grid,
                                   const std::vector<PlaneCandidate>& candidates,
                                   const PlaneFilterConfig& config) {
  std::vector<Support> supports;
  for (const PlaneCandidate& candidate : candidates) {
    const auto hull_T = HullInPlane(grid, candidate.plane, candidate.region);
    supports.push_back({candidate.plane.ToPlane(), Prism(candidate.plane, hull_T, 0.0)});
  }
  Weigh(grid, candidates, NotLoad(grid, candidates, supports, config), config, &supports);

  size_t main = 0;
  for (size_t k = 1; k < supports.size(); ++k) {
    if (Score(grid, supports[k], config) > Score(grid, supports[main], config)) main = k;
  }
  std::vector<size_t> chosen;
  for (size_t k = 0; k < supports.size(); ++k) {
    if (k != main &&
        Angle(supports[k].plane.normal, supports[main].plane.normal) <=
            config.max_parallel_angle_rad() &&
        PartStandingOn(grid, supports[main], candidates[k].region, config) < kStandingPart) {
      chosen.push_back(k);
    }
  }
  std::stable_sort(chosen.begin(), chosen.end(), [&](size_t a, size_t b) {
    return candidates[a].num_pixels > candidates[b].num_pixels;
  });
  if (!supports.empty()) chosen.insert(chosen.begin(), main);
  return chosen;
}

}  // namespace declutter
