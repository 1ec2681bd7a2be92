#include "modules/plane_filter/plane_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/image_components.h"
#include "modules/geometry/marked_pixels.h"
#include "modules/geometry/random_index.h"
#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

// Half widths of the windows that samples lie in, in turn: far-apart pixels rarely share a small
// plane, and near ones fix a large plane badly.
constexpr int kSampleReaches[] = {14, 6};

// Where a plane cuts through another surface, the residuals fill the band evenly, with a root mean
// square of 0.58 of its half width; the sensor's noise stays below this part of it.
constexpr double kMaxRmsOfBand = 0.5;

// Inliers among an inlier and its 8 neighbours.
constexpr int kMinAmid = 7;

int Draw(RandomIndex* random, int size) {
  return static_cast<int>((*random)(static_cast<size_t>(size)));
}

std::optional<InversePlane> PlaneThrough(const InverseDepth& grid,
                                         const std::array<Eigen::Vector2i, 3>& pixels) {
  Eigen::Matrix3d rays;
  Eigen::Vector3d values;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2i& pixel = pixels[static_cast<size_t>(i)];
    rays.row(i) << grid.ray_x[static_cast<size_t>(pixel.x())],
        grid.ray_y[static_cast<size_t>(pixel.y())], 1.0;
    values[i] = grid.values[grid.Index(pixel.x(), pixel.y())];
  }
  if (std::abs(rays.determinant()) < 1e-6) return std::nullopt;
  const Eigen::Vector3f plane = (rays.inverse() * values).cast<float>();
  return InversePlane{plane.x(), plane.y(), plane.z()};
}

// Three pixels near each other with a measurement; nullopt when the draw met a gap.
std::optional<InversePlane> SamplePlane(const InverseDepth& grid, int reach, RandomIndex* random) {
  std::array<Eigen::Vector2i, 3> pixels;
  for (int i = 0; i < 3; ++i) {
    Eigen::Vector2i& pixel = pixels[static_cast<size_t>(i)];
    if (i == 0) {
      pixel = {Draw(random, grid.width), Draw(random, grid.height)};
    } else {
      pixel = pixels[0] + Eigen::Vector2i(Draw(random, 2 * reach + 1) - reach,
                                          Draw(random, 2 * reach + 1) - reach);
    }
    if (pixel.x() < 0 || pixel.x() >= grid.width || pixel.y() < 0 || pixel.y() >= grid.height ||
        grid.values[grid.Index(pixel.x(), pixel.y())] <= 0) {
      return std::nullopt;
    }
  }
  return PlaneThrough(grid, pixels);
}

// The pixels of a grid that have a measurement, in no need of their places.
struct PixelList {
  std::vector<float> x, y, values;  // rays and 1 / z [1/m]; zeros for kernels at the end
  size_t num = 0;
};

void ListMeasured(const InverseDepth& grid, PixelList* list) {
  list->num = 0;
  for (auto* plane : {&list->x, &list->y, &list->values}) {
    plane->resize(grid.values.size() + kKernelPadding);
  }
  for (int v = 0; v < grid.height; ++v) {
    const float* values = &grid.values[grid.Index(0, v)];
    for (int u = 0; u < grid.width; ++u) {
      if (values[u] <= 0) continue;
      list->x[list->num] = grid.ray_x[static_cast<size_t>(u)];
      list->y[list->num] = grid.ray_y[static_cast<size_t>(v)];
      list->values[list->num++] = values[u];
    }
  }
  std::fill_n(list->values.begin() + static_cast<std::ptrdiff_t>(list->num), kKernelPadding, 0.0f);
}

std::optional<InversePlane> BestSample(const InverseDepth& grid, const PixelList& measured,
                                       int num_samples, float band, RandomIndex* random) {
  std::optional<InversePlane> best;
  int best_count = 0;
  // Draws that meet a gap are repeated, but not for ever.
  for (int sampled = 0, drawn = 0; sampled < num_samples && drawn < 20 * num_samples; ++drawn) {
    const std::optional<InversePlane> plane = SamplePlane(grid, kSampleReaches[drawn % 2], random);
    if (!plane) continue;
    ++sampled;
    const int count =
        CountPlaneInliers(measured.x.data(), measured.y.data(), measured.values.data(),
                          measured.num, plane->a, plane->b, plane->c, band, best_count);
    if (count > best_count) {
      best_count = count;
      best = plane;
    }
  }
  return best;
}

}  // namespace

PixelMask CoherentRegion(const InverseDepth& image, const InversePlane& plane, float band,
                         int min_region_pixels) {
  PixelMask region = Amid(image, PlaneInliers(image, plane, band), kMinAmid);
  // The inliers are in one plane: whether pixels touch in the image is all that counts.
  const ImageComponents components =
      LabelComponents(image.width, image.height, region, image.values, HUGE_VALF);
  std::vector<double> sum_squares(components.num_pixels.size());
  for (int v = 0; v < image.height; ++v) {
    const float y = image.ray_y[static_cast<size_t>(v)];
    const size_t row = image.Index(0, v);
    ForEachMarked(region.data(), row, row + static_cast<size_t>(image.width), [&](size_t i) {
      const float residual = image.values[i] - plane.At(image.ray_x[i - row], y);
      sum_squares[static_cast<size_t>(components.label[i])] += residual * residual;
    });
  }
  const double max_mean_square = kMaxRmsOfBand * kMaxRmsOfBand * band * band;
  ForEachMarked(region.data(), 0, region.size(), [&](size_t i) {
    const size_t label = static_cast<size_t>(components.label[i]);
    const int32_t num_pixels = components.num_pixels[label];
    region[i] =
        num_pixels >= min_region_pixels && sum_squares[label] <= max_mean_square * num_pixels;
  });
  return region;
}

std::vector<PlaneCandidate> FindPlanes(const InverseDepth& grid, const PlaneFilterConfig& config) {
  std::vector<PlaneCandidate> candidates;
  if (grid.values.empty()) return candidates;
  RandomIndex random(config.seed());
  const float band = static_cast<float>(config.inlier_sigmas() * config.inverse_depth_sigma());
  const int min_pixels = std::max(
      3, static_cast<int>(config.min_plane_fraction() * static_cast<double>(grid.values.size())));
  InverseDepth rest = grid;
  PixelList measured;
  const PixelMask all_pixels(grid.values.size(), 1);
  const int max_attempts = 2 * config.max_planes();
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    if (static_cast<int>(candidates.size()) == config.max_planes()) break;
    ListMeasured(rest, &measured);
    std::optional<InversePlane> plane =
        BestSample(rest, measured, config.num_samples(), band, &random);
    if (!plane) break;
    for (int i = 0; plane && i < 3; ++i) {
      plane = FitInliers(rest, all_pixels, *plane, band);
    }
    if (!plane) continue;
    const PixelMask inliers = PlaneInliers(rest, *plane, band);
    if (std::count(inliers.begin(), inliers.end(), 1) < min_pixels) break;
    PlaneCandidate candidate{*plane, CoherentRegion(rest, *plane, band, min_pixels / 4), 0};
    candidate.num_pixels =
        static_cast<int>(std::count(candidate.region.begin(), candidate.region.end(), 1));
    for (size_t i = 0; i < inliers.size(); ++i) {
      if (inliers[i]) rest.values[i] = 0;
    }
    if (candidate.num_pixels >= min_pixels / 2) candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace declutter
