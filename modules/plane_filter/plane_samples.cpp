#include "modules/plane_filter/plane_samples.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "modules/geometry/for_each_processor.h"

namespace declutter {
namespace {

// Half widths of the windows that samples lie in, in turn: far-apart pixels rarely share a small
// plane, and near ones fix a large plane badly.
constexpr int kReaches[] = {14, 6};

using Triple = std::array<Eigen::Vector2i, 3>;

std::optional<InversePlane> PlaneThrough(const InverseDepth& grid, const Triple& pixels) {
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

int Scaled(uint32_t bits, int num) {
  return static_cast<int>(RandomIndex::Scaled(bits, static_cast<size_t>(num)));
}

// num pairs of random bits: x and y of a pixel, and whether its value is not 0.
DECLUTTER_FOR_EACH_PROCESSOR void DrawPixels(RandomIndex random, size_t num, const float* values,
                                             size_t width, size_t height, uint32_t* x, uint32_t* y,
                                             uint8_t* is_measured) {
  for (size_t i = 0; i < num; ++i) {
    x[i] = random.Bits();
    y[i] = random.Bits();
  }
  for (size_t i = 0; i < num; ++i) {
    const size_t v = RandomIndex::Scaled(y[i], height);
    is_measured[i] = values[v * width + RandomIndex::Scaled(x[i], width)] > 0;
  }
}

}  // namespace

PlaneSamples::PlaneSamples(const InverseDepth& grid, int max_draws, RandomIndex* random)
    : grid_(grid), max_draws_(max_draws), random_(random) {
  LookAhead();
}

PlaneSamples::~PlaneSamples() { random_->Skip(2 * next_); }

void PlaneSamples::LookAhead() {
  random_->Skip(2 * next_);
  next_ = 0;
  DrawPixels(*random_, kNumAhead, grid_.values.data(), static_cast<size_t>(grid_.width),
             static_cast<size_t>(grid_.height), first_.data(), second_.data(), is_measured_.data());
}

// To the next pixel with a measurement, which is not the last one looked at.
void PlaneSamples::SkipGaps() {
  while (num_drawn_ < max_draws_) {
    if (next_ + kPairsOfDraw > kNumAhead) LookAhead();
    const uint8_t* from = &is_measured_[next_];
    const size_t room = kNumAhead - kPairsOfDraw + 1 - next_;
    const void* found = std::memchr(from, 1, room);
    const auto num_gaps = found == nullptr
                              ? static_cast<int>(room)
                              : static_cast<int>(static_cast<const uint8_t*>(found) - from);
    const int num_skipped = std::min(num_gaps, max_draws_ - num_drawn_);
    next_ += static_cast<size_t>(num_skipped);
    num_drawn_ += num_skipped;
    if (found != nullptr) return;
  }
}

// Nothing where it meets a gap.
std::optional<InversePlane> PlaneSamples::Draw(int reach) {
  Triple pixels;
  pixels[0] = {Scaled(first_[next_], grid_.width), Scaled(second_[next_], grid_.height)};
  ++next_;
  for (const size_t i : {1, 2}) {
    const Eigen::Vector2i offset(Scaled(second_[next_], 2 * reach + 1) - reach,
                                 Scaled(first_[next_], 2 * reach + 1) - reach);
    ++next_;
    const Eigen::Vector2i pixel = pixels[0] + offset;
    if (pixel.x() < 0 || pixel.x() >= grid_.width || pixel.y() < 0 || pixel.y() >= grid_.height ||
        grid_.values[grid_.Index(pixel.x(), pixel.y())] <= 0) {
      return std::nullopt;
    }
    pixels[i] = pixel;
  }
  return PlaneThrough(grid_, pixels);
}

std::optional<InversePlane> PlaneSamples::Next() {
  while (true) {
    SkipGaps();
    if (num_drawn_ == max_draws_) return std::nullopt;
    const int reach = kReaches[num_drawn_++ % 2];
    const std::optional<InversePlane> plane = Draw(reach);
    if (plane) return plane;
  }
}

}  // namespace declutter
