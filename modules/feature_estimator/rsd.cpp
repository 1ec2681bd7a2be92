#include "modules/feature_estimator/rsd.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace declutter {
namespace {

constexpr int kMaxBins = 16;

// Corrections of the systematic error of the binning, as in the descriptor's reference code.
constexpr double kLargestAngleCorrection = 0.9;
constexpr double kSmallestAngleCorrection = 1.1;

// Cosines of the angles between the normal at a point and those of its neighbours, disregarding
// orientation: extremes of each distance bin.
struct AngleBins {
  std::array<float, kMaxBins> min_cosine, max_cosine;
};

// Slope of distance over angle through the origin, at most plane_radius_m.
double Radius(const std::array<float, kMaxBins>& cosine, int num_bins, double radius_m,
              double plane_radius_m) {
  double squared_angles = 0, angles_distances = 0;
  for (int bin = 0; bin < num_bins; ++bin) {
    const float value = cosine[static_cast<size_t>(bin)];
    if (value < 0 || value > 1) continue;
    const double angle_rad = std::acos(static_cast<double>(value));
    squared_angles += angle_rad * angle_rad;
    angles_distances += angle_rad * (bin + 0.5) * radius_m / num_bins;
  }
  if (squared_angles == 0) return plane_radius_m;
  return std::min(angles_distances / squared_angles, plane_radius_m);
}

AngleBins CollectAngles(const PointImage& points, const NormalImage& normals, size_t p,
                        const SphereWindow& window, float radius_m, int num_bins) {
  AngleBins bins;
  bins.min_cosine.fill(2);
  bins.max_cosine.fill(-1);
  bins.min_cosine[0] = bins.max_cosine[0] = 1;  // the point itself
  const float bins_per_m = static_cast<float>(num_bins) / radius_m;
  for (int row = -window.num_rows(); row <= window.num_rows(); ++row) {
    const int columns = window.Columns(row);
    const ptrdiff_t center = static_cast<ptrdiff_t>(p) + row * points.stride;
    for (ptrdiff_t i = center - columns; i <= center + columns; ++i) {
      const auto q = static_cast<size_t>(i);
      const float x = points.x[q] - points.x[p];
      const float y = points.y[q] - points.y[p];
      const float z = points.z[q] - points.z[p];
      const float squared_distance = x * x + y * y + z * z;
      if (squared_distance > radius_m * radius_m || !normals.IsKnown(q)) continue;
      const float cosine =
          std::min(1.0F, std::abs(normals.x[p] * normals.x[q] + normals.y[p] * normals.y[q] +
                                  normals.z[p] * normals.z[q]));
      const int bin =
          std::min(static_cast<int>(std::sqrt(squared_distance) * bins_per_m), num_bins - 1);
      float& min_cosine = bins.min_cosine[static_cast<size_t>(bin)];
      float& max_cosine = bins.max_cosine[static_cast<size_t>(bin)];
      min_cosine = std::min(min_cosine, cosine);
      max_cosine = std::max(max_cosine, cosine);
    }
  }
  return bins;
}

}  // namespace

std::vector<float> EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                         double radius_m, int num_bins, double plane_radius_m) {
  std::vector<float> r_min(points.x.size(), 0.0F);
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t p = points.Index(i, j);
      if (!normals.IsKnown(p)) continue;
      const SphereWindow window(points, p, {radius_m});
      const AngleBins bins =
          CollectAngles(points, normals, p, window, static_cast<float>(radius_m), num_bins);
      const double of_largest_angles =
          kLargestAngleCorrection * Radius(bins.min_cosine, num_bins, radius_m, plane_radius_m);
      const double of_smallest_angles =
          kSmallestAngleCorrection * Radius(bins.max_cosine, num_bins, radius_m, plane_radius_m);
      r_min[p] = static_cast<float>(std::min(of_largest_angles, of_smallest_angles));
    }
  }
  return r_min;
}

}  // namespace declutter
