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

// Arc cosine of values in [0, 1] to 2e-8 rad: Abramowitz and Stegun, formula 4.4.46.
DECLUTTER_LANES void ArcCosine(const Lanes& x, Lanes& angle_rad) {
  constexpr float kCoefficients[] = {-0.0012624911F, 0.0066700901F, -0.0170881256F, 0.0308918810F,
                                     -0.0501743046F, 0.0889789874F, -0.2145988016F, 1.5707963050F};
  angle_rad = Lanes{};
  for (const float coefficient : kCoefficients) angle_rad = angle_rad * x + coefficient;
  float root[PointImage::kLanes];
  StoreLanes(1.0F - x, root);
  for (float& value : root) value = std::sqrt(value);
  Lanes factor;
  LoadLanes(root, factor);
  angle_rad *= factor;
}

// Slope of distance over angle through the origin, at most plane_radius_m, times a correction.
DECLUTTER_LANES void Radius(const Lanes* cosine, const RsdParameters& rsd, double correction,
                            Lanes& radius_m) {
  Lanes squared_angles{}, angles_distances{};
  for (int bin = 0; bin < rsd.num_bins; ++bin) {
    Lanes value = cosine[bin];
    const LaneMask is_known = (value >= 0) & (value <= 1);
    KeepLanes(is_known, value);
    Lanes angle_rad;
    ArcCosine(value, angle_rad);
    KeepLanes(is_known, angle_rad);
    squared_angles += angle_rad * angle_rad;
    angles_distances += angle_rad * static_cast<float>((bin + 0.5) * rsd.radius_m / rsd.num_bins);
  }
  const float plane_radius_m = static_cast<float>(rsd.plane_radius_m);
  const Lanes slope =
      squared_angles > 0 ? angles_distances / squared_angles : plane_radius_m + Lanes{};
  radius_m =
      static_cast<float>(correction) * (slope < plane_radius_m ? slope : plane_radius_m + Lanes{});
}

// Cosines that rounding made larger than 1; kNoMinimum stays.
DECLUTTER_LANES void LimitToOne(Lanes& cosine) {
  cosine = (cosine > 1) & (cosine < kNoMinimum) ? 1.0F + Lanes{} : cosine;
}

// A few adjacent points.
struct PointBlock {
  Lanes x, y, z, normal_x, normal_y, normal_z;
};

// Collects from elements [first, last] neighbours in kFirst and the bins after it; they are too far
// away for those before.
template <size_t kNumBins, size_t kFirst>
DECLUTTER_LANES void CollectAngles(const PointImage& points, const NormalImage& normals,
                                   const float* known_x, const PointBlock& block,
                                   const float* squared_edge, ptrdiff_t first, ptrdiff_t last,
                                   Lanes* min_cosine, Lanes* max_cosine) {
  for (ptrdiff_t q = first; q <= last; ++q) {
    Lanes x, y, z, nx, ny, nz;
    LoadLanes(known_x + q, x);
    LoadLanes(points.y.data() + q, y);
    LoadLanes(points.z.data() + q, z);
    LoadLanes(normals.x.data() + q, nx);
    LoadLanes(normals.y.data() + q, ny);
    LoadLanes(normals.z.data() + q, nz);
    x -= block.x;
    y -= block.y;
    z -= block.z;
    const Lanes squared_distance = x * x + y * y + z * z;
    const Lanes cosine = nx * block.normal_x + ny * block.normal_y + nz * block.normal_z;
    const LaneMask cosine_bits = reinterpret_cast<LaneMask>(cosine) & kAllButSign;
    LaneMask is_below = {};
#pragma GCC unroll 16
    for (size_t bin = kFirst; bin < kNumBins; ++bin) {
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

// kNumBins at least rsd.num_bins; bins beyond stay empty.
template <size_t kNumBins>
DECLUTTER_LANES void CollectAnglesInBins(const PointImage& points, const NormalImage& normals,
                                         const float* known_x, size_t begin,
                                         const RsdParameters& rsd, AngleBins* bins) {
  // Of pixels so far away from a point that their neighbours can only be in the last bins.
  constexpr size_t kFirstOfFar = kNumBins / 2 + 1;
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
  PointBlock block;
  LoadLanes(&points.x[begin], block.x);
  LoadLanes(&points.y[begin], block.y);
  LoadLanes(&points.z[begin], block.z);
  LoadLanes(&normals.x[begin], block.normal_x);
  LoadLanes(&normals.y[begin], block.normal_y);
  LoadLanes(&normals.z[begin], block.normal_z);
  const SphereWindow window(points, begin, {rsd.radius_m});
  const SphereCore core(points, begin, std::sqrt(squared_edge[kFirstOfFar - 1]), window);
  for (int row = -window.num_steps(); row <= window.num_steps(); ++row) {
    const int columns = window.Columns(row);
    const int near_columns = std::min(core.Columns(row), columns);
    const ptrdiff_t center = static_cast<ptrdiff_t>(begin) + row * points.stride;
    CollectAngles<kNumBins, kFirstOfFar>(points, normals, known_x, block, squared_edge,
                                         center - columns, center - near_columns - 1, min_cosine,
                                         max_cosine);
    CollectAngles<kNumBins, 0>(points, normals, known_x, block, squared_edge, center - near_columns,
                               center + near_columns, min_cosine, max_cosine);
    CollectAngles<kNumBins, kFirstOfFar>(points, normals, known_x, block, squared_edge,
                                         center + near_columns + 1, center + columns, min_cosine,
                                         max_cosine);
  }
  for (size_t bin = 0; bin < kNumBins; ++bin) {
    LimitToOne(min_cosine[bin]);
    LimitToOne(max_cosine[bin]);
    bins->min_cosine[bin] = min_cosine[bin];
    bins->max_cosine[bin] = max_cosine[bin];
  }
}

DECLUTTER_FOR_EACH_PROCESSOR void EstimateBlock(const PointImage& points,
                                                const NormalImage& normals, const float* known_x,
                                                size_t begin, const RsdParameters& rsd,
                                                float* r_min) {
  AngleBins bins;
  if (rsd.num_bins <= static_cast<int>(kUsualBins)) {
    CollectAnglesInBins<kUsualBins>(points, normals, known_x, begin, rsd, &bins);
  } else {
    CollectAnglesInBins<kMaxBins>(points, normals, known_x, begin, rsd, &bins);
  }
  Lanes of_largest_angles, of_smallest_angles;
  Radius(bins.min_cosine.data(), rsd, kLargestAngleCorrection, of_largest_angles);
  Radius(bins.max_cosine.data(), rsd, kSmallestAngleCorrection, of_smallest_angles);
  StoreLanes(of_largest_angles < of_smallest_angles ? of_largest_angles : of_smallest_angles,
             r_min);
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
  float r_min[PointImage::kLanes];
  for (int j = 0; j < points.height; ++j) {
    for (int i = 0; i < points.width; ++i) {
      const size_t begin = points.Index(i, j);
      if (!normals.IsKnown(begin)) continue;
      EstimateBlock(points, normals, image.known_x.data(), begin, rsd, r_min);
      for (size_t lane = 0; lane < PointImage::kLanes; ++lane) {
        if (normals.IsKnown(begin + lane)) image.r_min[begin + lane] = r_min[lane];
      }
      i += PointImage::kLanes - 1;
    }
  }
  return image;
}

}  // namespace declutter
