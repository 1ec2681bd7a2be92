#include "modules/feature_estimator/rsd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "modules/feature_estimator/lanes.h"

namespace declutter {
namespace {

constexpr int kMaxBins = 16;

// Corrections of the systematic error of the binning, as in the descriptor's reference code.
constexpr double kLargestAngleCorrection = 0.9;
constexpr double kSmallestAngleCorrection = 1.1;

// Cosines of the angles between the normals of a few adjacent points and those of their neighbours,
// disregarding orientation: extremes of each distance bin, outside [0, 1] in bins without
// neighbours.
struct AngleBins {
  std::array<Lanes, kMaxBins> min_cosine, max_cosine;
};

// Slope of distance over angle through the origin, at most plane_radius_m.
double Radius(const std::array<Lanes, kMaxBins>& cosine, size_t lane, const RsdParameters& rsd) {
  double squared_angles = 0, angles_distances = 0;
  for (int bin = 0; bin < rsd.num_bins; ++bin) {
    const float value = cosine[static_cast<size_t>(bin)][lane];
    if (value < 0 || value > 1) continue;
    const double angle_rad = std::acos(static_cast<double>(value));
    squared_angles += angle_rad * angle_rad;
    angles_distances += angle_rad * (bin + 0.5) * rsd.radius_m / rsd.num_bins;
  }
  if (squared_angles == 0) return rsd.plane_radius_m;
  return std::min(angles_distances / squared_angles, rsd.plane_radius_m);
}

DECLUTTER_FOR_EACH_PROCESSOR void CollectAngles(const PointImage& points,
                                                const NormalImage& normals, size_t begin,
                                                const RsdParameters& rsd, AngleBins* bins) {
  const auto num_bins = static_cast<size_t>(rsd.num_bins);
  bins->min_cosine.fill(2.0F + Lanes{});
  bins->max_cosine.fill(-1.0F + Lanes{});
  bins->min_cosine[0] = bins->max_cosine[0] = 1.0F + Lanes{};  // the point itself
  std::array<float, kMaxBins + 1> squared_edge{};
  for (size_t bin = 1; bin <= num_bins; ++bin) {
    const double edge_m = rsd.radius_m * static_cast<double>(bin) / rsd.num_bins;
    squared_edge[bin] = static_cast<float>(edge_m * edge_m);
  }
  Lanes px, py, pz, ax, ay, az;
  LoadLanes(&points.x[begin], px);
  LoadLanes(&points.y[begin], py);
  LoadLanes(&points.z[begin], pz);
  LoadLanes(&normals.x[begin], ax);
  LoadLanes(&normals.y[begin], ay);
  LoadLanes(&normals.z[begin], az);
  const SphereWindow window(points, begin, {rsd.radius_m});
  for (int row = -window.num_rows(); row <= window.num_rows(); ++row) {
    const int columns = window.Columns(row);
    const ptrdiff_t center = static_cast<ptrdiff_t>(begin) + row * points.stride;
    for (ptrdiff_t q = center - columns; q <= center + columns; ++q) {
      Lanes x, y, z, nx, ny, nz;
      LoadLanes(points.x.data() + q, x);
      LoadLanes(points.y.data() + q, y);
      LoadLanes(points.z.data() + q, z);
      LoadLanes(normals.x.data() + q, nx);
      LoadLanes(normals.y.data() + q, ny);
      LoadLanes(normals.z.data() + q, nz);
      x -= px;
      y -= py;
      z -= pz;
      const Lanes squared_distance = x * x + y * y + z * z;
      Lanes cosine = nx * ax + ny * ay + nz * az;
      cosine = cosine < 0 ? -cosine : cosine;
      cosine = cosine > 1 ? 1.0F + Lanes{} : cosine;
      const LaneMask is_known = (nx != 0) | (ny != 0) | (nz != 0);
      for (size_t bin = 0; bin < num_bins; ++bin) {
        const LaneMask is_in_bin = is_known & (squared_distance >= squared_edge[bin]) &
                                   (squared_distance < squared_edge[bin + 1]);
        Lanes& min_cosine = bins->min_cosine[bin];
        Lanes& max_cosine = bins->max_cosine[bin];
        min_cosine = is_in_bin & (cosine < min_cosine) ? cosine : min_cosine;
        max_cosine = is_in_bin & (cosine > max_cosine) ? cosine : max_cosine;
      }
    }
  }
}

}  // namespace

std::vector<float> EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                         const RsdParameters& rsd) {
  if (rsd.num_bins < 1 || rsd.num_bins > kMaxBins) throw std::logic_error("RSD: number of bins");
  std::vector<float> r_min(points.x.size(), 0.0F);
  AngleBins bins;
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (!normals.IsKnown(begin)) continue;
      CollectAngles(points, normals, begin, rsd, &bins);
      for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
        if (!normals.IsKnown(begin + lane)) continue;
        const double of_largest_angles = Radius(bins.min_cosine, lane, rsd);
        const double of_smallest_angles = Radius(bins.max_cosine, lane, rsd);
        r_min[begin + lane] =
            static_cast<float>(std::min(kLargestAngleCorrection * of_largest_angles,
                                        kSmallestAngleCorrection * of_smallest_angles));
      }
      i += PointImage::kLanes - 1;
    }
  }
  return r_min;
}

}  // namespace declutter
