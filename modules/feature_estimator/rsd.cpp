#include "modules/feature_estimator/rsd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "modules/feature_estimator/lanes.h"
#include "modules/feature_estimator/sphere_window.h"

namespace declutter {
namespace {

constexpr size_t kMaxBins = 16;
constexpr size_t kUsualBins = 5;

// Of a bin without neighbours: outside [0, 1].
constexpr float kNoMinimum = 2.0F;
constexpr float kNoMaximum = -1.0F;

constexpr int32_t kAllButSign = 0x7FFFFFFF;

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

// Cosines that rounding made larger than 1; kNoMinimum stays.
DECLUTTER_LANES void LimitToOne(Lanes& cosine) {
  cosine = (cosine > 1) & (cosine < kNoMinimum) ? 1.0F + Lanes{} : cosine;
}

// kNumBins at least rsd.num_bins; bins beyond stay empty.
template <size_t kNumBins>
DECLUTTER_LANES void CollectAnglesInBins(const PointImage& points, const NormalImage& normals,
                                         const float* known_x, size_t begin,
                                         const RsdParameters& rsd, AngleBins* bins) {
  // Local, so that they stay in registers.
  Lanes min_cosine[kNumBins], max_cosine[kNumBins];
  float squared_edge[kNumBins];  // upper
  for (size_t bin = 0; bin < kNumBins; ++bin) {
    const double edge_m = rsd.radius_m * static_cast<double>(bin + 1) / rsd.num_bins;
    squared_edge[bin] = bin < static_cast<size_t>(rsd.num_bins)
                            ? static_cast<float>(edge_m * edge_m)
                            : squared_edge[bin - 1];
    min_cosine[bin] = kNoMinimum + Lanes{};
    max_cosine[bin] = kNoMaximum + Lanes{};
  }
  min_cosine[0] = max_cosine[0] = 1.0F + Lanes{};  // the point itself
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
      LoadLanes(known_x + q, x);
      LoadLanes(points.y.data() + q, y);
      LoadLanes(points.z.data() + q, z);
      LoadLanes(normals.x.data() + q, nx);
      LoadLanes(normals.y.data() + q, ny);
      LoadLanes(normals.z.data() + q, nz);
      x -= px;
      y -= py;
      z -= pz;
      const Lanes squared_distance = x * x + y * y + z * z;
      const Lanes cosine = nx * ax + ny * ay + nz * az;
      const LaneMask cosine_bits = reinterpret_cast<LaneMask>(cosine) & kAllButSign;
      LaneMask is_below = {};
#pragma GCC unroll 16
      for (size_t bin = 0; bin < kNumBins; ++bin) {
        // All bits set where the neighbour is in another bin: not a number, which no comparison
        // takes.
        const LaneMask is_out = (squared_distance >= squared_edge[bin]) | is_below;
        is_below = squared_distance < squared_edge[bin];
        const Lanes value = reinterpret_cast<Lanes>(cosine_bits | is_out);
        min_cosine[bin] = value < min_cosine[bin] ? value : min_cosine[bin];
        max_cosine[bin] = value > max_cosine[bin] ? value : max_cosine[bin];
      }
    }
  }
  for (size_t bin = 0; bin < kNumBins; ++bin) {
    LimitToOne(min_cosine[bin]);
    LimitToOne(max_cosine[bin]);
    bins->min_cosine[bin] = min_cosine[bin];
    bins->max_cosine[bin] = max_cosine[bin];
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void CollectAngles(const PointImage& points,
                                                const NormalImage& normals, const float* known_x,
                                                size_t begin, const RsdParameters& rsd,
                                                AngleBins* bins) {
  if (rsd.num_bins <= static_cast<int>(kUsualBins)) {
    CollectAnglesInBins<kUsualBins>(points, normals, known_x, begin, rsd, bins);
  } else {
    CollectAnglesInBins<kMaxBins>(points, normals, known_x, begin, rsd, bins);
  }
}

}  // namespace

RadiusImage EstimateMinimumRadius(const PointImage& points, const NormalImage& normals,
                                  const RsdParameters& rsd, RadiusImage recycled) {
  if (rsd.num_bins < 1 || rsd.num_bins > static_cast<int>(kMaxBins))
    throw std::logic_error("RSD: number of bins");
  RadiusImage image = std::move(recycled);
  image.r_min.assign(points.x.size(), 0.0F);
  image.known_x.resize(points.x.size());
  for (size_t i = 0; i < points.x.size(); ++i) {
    image.known_x[i] = normals.IsKnown(i) ? points.x[i] : PointImage::kFar;
  }
  AngleBins bins;
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (!normals.IsKnown(begin)) continue;
      CollectAngles(points, normals, image.known_x.data(), begin, rsd, &bins);
      for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
        if (!normals.IsKnown(begin + lane)) continue;
        const double of_largest_angles = Radius(bins.min_cosine, lane, rsd);
        const double of_smallest_angles = Radius(bins.max_cosine, lane, rsd);
        image.r_min[begin + lane] =
            static_cast<float>(std::min(kLargestAngleCorrection * of_largest_angles,
                                        kSmallestAngleCorrection * of_smallest_angles));
      }
      i += PointImage::kLanes - 1;
    }
  }
  return image;
}

}  // namespace declutter
