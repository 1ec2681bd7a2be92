#include "modules/plane_filter/plane_search.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include "modules/geometry/for_each_processor.h"
#include "modules/geometry/marked_pixels.h"
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

int NumMarked(const PixelMask& mask) {
  return static_cast<int>(std::count(mask.begin(), mask.end(), 1));
}

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

// Where draws begin, one after the other, when all those before begin at a gap.
constexpr size_t kNumAhead = 8;
DECLUTTER_FOR_EACH_PROCESSOR void LookAhead(RandomIndex random, size_t width, size_t height,
                                            uint64_t* pixels) {
  for (size_t i = 0; i < kNumAhead; ++i) {
    const size_t u = random(width);
    pixels[i] = random(height) * width + u;
  }
}

// Leaves out draws, at most max_num, that begin at a gap, and returns how many.
int SkipGaps(const InverseDepth& grid, int max_num, RandomIndex* random) {
  uint64_t pixels[kNumAhead];
  int num = 0;
  while (num < max_num) {
    LookAhead(*random, static_cast<size_t>(grid.width), static_cast<size_t>(grid.height), pixels);
    uint32_t measured = 1u << kNumAhead;
    for (size_t i = 0; i < kNumAhead; ++i) {
      measured |= static_cast<uint32_t>(grid.values[pixels[i]] > 0) << i;
    }
    const int num_gaps = std::min(__builtin_ctz(measured), max_num - num);
    random->Skip(2 * static_cast<size_t>(num_gaps));
    num += num_gaps;
    if (num_gaps < static_cast<int>(kNumAhead)) break;
  }
  return num;
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
  // Draws that meet a gap are repeated, but not for ever.
  const int num_samples = config_.num_samples(), max_draws = 20 * num_samples;
  for (int sampled = 0, drawn = 0; sampled < num_samples && drawn < max_draws; ++drawn) {
    drawn += SkipGaps(rest_, max_draws - drawn, random);
    if (drawn == max_draws) break;
    const std::optional<InversePlane> plane = SamplePlane(rest_, kSampleReaches[drawn % 2], random);
    if (!plane) continue;
    ++sampled;
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

const PlaneCandidates& PlaneSearch::Find(const InverseDepth& grid) {
  candidates_.planes.clear();
  candidates_.region_of.assign(grid.values.size(), 0);
  if (grid.values.empty()) return candidates_;
  RandomIndex random(config_.seed());
  const float band = static_cast<float>(config_.inlier_sigmas() * config_.inverse_depth_sigma());
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
