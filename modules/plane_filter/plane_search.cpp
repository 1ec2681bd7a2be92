#include "modules/plane_filter/plane_search.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "modules/geometry/marked_pixels.h"
#include "modules/plane_filter/pixel_kernels.h"
#include "modules/plane_filter/plane_samples.h"

namespace declutter {
namespace {

// Where a plane cuts through another surface, the residuals fill the band evenly, with a root mean
// square of 0.58 of its half width; the sensor's noise stays below this part of it.
constexpr double kMaxRmsOfBand = 0.5;

// Draws for each sample, on average, of which most meet a gap where little is left.
constexpr int kMaxDrawsOfSample = 20;

// Inliers among an inlier and its 8 neighbours.
constexpr int kMinAmid = 7;

int NumMarked(const PixelMask& mask) {
  return static_cast<int>(std::count(mask.begin(), mask.end(), 1));
}

}  // namespace

const PixelMask& CoherentRegion::Find(const InverseDepth& image, const InversePlane& plane,
                                      const PixelMask& inliers, float band, int min_region_pixels) {
  region_ = Amid(image, inliers, kMinAmid, std::move(region_));
  // The inliers are in one plane: whether pixels touch in the image is all that counts.
  components_ = FindComponents(image.width, image.height, region_, image.values, HUGE_VALF,
                               std::move(components_));
  sum_squares_.assign(components_.num_pixels.size(), 0);
  for (int v = 0; v < image.height; ++v) {
    const float y = image.ray_y[static_cast<size_t>(v)];
    const size_t row = image.Index(0, v);
    const auto first = components_.first_run[static_cast<size_t>(v)];
    const auto last = components_.first_run[static_cast<size_t>(v) + 1];
    for (size_t i = first; i < last; ++i) {
      const ComponentRun& run = components_.runs[i];
      double sum = sum_squares_[static_cast<size_t>(run.component)];
      for (size_t p = run.begin; p < run.end; ++p) {
        const float residual = image.values[p] - plane.At(image.ray_x[p - row], y);
        sum += residual * residual;
      }
      sum_squares_[static_cast<size_t>(run.component)] = sum;
    }
  }
  const double max_mean_square = kMaxRmsOfBand * kMaxRmsOfBand * band * band;
  for (const ComponentRun& run : components_.runs) {
    const auto component = static_cast<size_t>(run.component);
    const int32_t num_pixels = components_.num_pixels[component];
    const bool is_coherent =
        num_pixels >= min_region_pixels && sum_squares_[component] <= max_mean_square * num_pixels;
    if (!is_coherent) std::memset(&region_[run.begin], 0, run.end - run.begin);
  }
  return region_;
}

void PlaneSearch::ListMeasured() {
  measured_.num = 0;
  for (auto* plane : {&measured_.x, &measured_.y, &measured_.values}) {
    plane->resize(rest_.values.size() + kKernelPadding);
  }
  for (int v = 0; v < rest_.height; ++v) {
    const float* values = &rest_.values[rest_.Index(0, v)];
    for (int u = 0; u < rest_.width; ++u) {
      if (values[u] <= 0) continue;
      measured_.x[measured_.num] = rest_.ray_x[static_cast<size_t>(u)];
      measured_.y[measured_.num] = rest_.ray_y[static_cast<size_t>(v)];
      measured_.values[measured_.num++] = values[u];
    }
  }
  std::fill_n(&measured_.values[measured_.num], kKernelPadding, 0.0f);
}

std::optional<InversePlane> PlaneSearch::BestSample(float band, RandomIndex* random) const {
  std::optional<InversePlane> best;
  int best_count = 0;
  PlaneSamples samples(rest_, kMaxDrawsOfSample * config_.num_samples(), random);
  for (int i = 0; i < config_.num_samples(); ++i) {
    const std::optional<InversePlane> plane = samples.Next();
    if (!plane) break;
    const int count =
        CountPlaneInliers(measured_.x.data(), measured_.y.data(), measured_.values.data(),
                          measured_.num, plane->a, plane->b, plane->c, band, best_count);
    if (count > best_count) {
      best_count = count;
      best = plane;
    }
  }
  return best;
}

void PlaneSearch::Add(const InversePlane& plane, const PixelMask& region, int num_pixels) {
  candidates_.planes.push_back({plane, num_pixels});
  const auto mark = static_cast<uint8_t>(candidates_.planes.size());
  ForEachMarked(region.data(), 0, region.size(),
                [&](size_t i) { candidates_.region_of[i] = mark; });
}

const PlaneCandidates& PlaneSearch::Find(const InverseDepth& grid, double sigma) {
  candidates_.planes.clear();
  candidates_.region_of.assign(grid.values.size(), 0);
  if (grid.values.empty()) return candidates_;
  RandomIndex random(config_.seed());
  const float band = static_cast<float>(config_.inlier_sigmas() * sigma);
  const int min_pixels = std::max(
      3, static_cast<int>(config_.min_plane_fraction() * static_cast<double>(grid.values.size())));
  rest_ = grid;
  const int max_attempts = 2 * config_.max_planes();
  for (int attempt = 0; attempt < max_attempts; ++attempt) {
    if (static_cast<int>(candidates_.planes.size()) == config_.max_planes()) break;
    ListMeasured();
    std::optional<InversePlane> plane = BestSample(band, &random);
    if (!plane) break;
    for (int i = 0; plane && i < 3; ++i) plane = FitInliers(rest_, nullptr, *plane, band);
    if (!plane) continue;
    inliers_ = PlaneInliers(rest_, *plane, band, std::move(inliers_));
    if (NumMarked(inliers_) < min_pixels) break;
    const PixelMask& region = region_.Find(rest_, *plane, inliers_, band, min_pixels / 4);
    const int num_pixels = NumMarked(region);
    if (num_pixels >= min_pixels / 2) Add(*plane, region, num_pixels);
    for (size_t i = 0; i < inliers_.size(); ++i) {
      if (inliers_[i]) rest_.values[i] = 0;
    }
  }
  return candidates_;
}

}  // namespace declutter
