#include "modules/scene_renderer/sensor_model.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "modules/scene_renderer/disparity_noise.h"
#include "modules/scene_renderer/shadow.h"

namespace declutter {
namespace {

// The depth from which on the independent noise grows.
constexpr double kWhiteNoiseDepth_m = 0.4;

// Independent random streams of one seed.
uint64_t Stream(uint64_t seed, uint64_t stream) {
  std::seed_seq sequence{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32),
                         static_cast<uint32_t>(stream), static_cast<uint32_t>(stream >> 32)};
  uint32_t words[2];
  sequence.generate(words, words + 2);
  return (static_cast<uint64_t>(words[0]) << 32) | words[1];
}

std::vector<float> Disparity(const IdealImage& ideal, double disparity_constant) {
  std::vector<float> disparity(ideal.z.size(), 0);
  for (size_t i = 0; i < disparity.size(); ++i) {
    if (ideal.solid[i] >= 0) disparity[i] = static_cast<float>(disparity_constant) / ideal.z[i];
  }
  return disparity;
}

// Mean of the disparities of the same solid in a window of the matcher, along u or along v.
std::vector<float> AverageAlong(const IdealImage& ideal, const std::vector<float>& disparity,
                                int length, bool along_u) {
  const int width = ideal.camera.width, height = ideal.camera.height;
  const int reach = length / 2;
  std::vector<float> averaged(disparity.size(), 0);
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int pixel = v * width + u;
      const int16_t solid = ideal.solid[static_cast<size_t>(pixel)];
      if (solid < 0) continue;
      const int position = along_u ? u : v;
      const int begin = std::max(-reach, -position);
      const int end = std::min(reach, (along_u ? width : height) - 1 - position);
      float sum = 0;
      int count = 0;
      for (int k = begin; k <= end; ++k) {
        const size_t other = static_cast<size_t>(pixel + (along_u ? k : k * width));
        if (ideal.solid[other] != solid) continue;
        sum += disparity[other];
        ++count;
      }
      averaged[static_cast<size_t>(pixel)] = sum / static_cast<float>(count);
    }
  }
  return averaged;
}

uint16_t ToCount(double z, double depth_scale_m) {
  const double count = std::round(z / depth_scale_m);
  return count >= 1 && count <= 65535 ? static_cast<uint16_t>(count) : uint16_t{0};
}

void SenseRealistically(const IdealImage& ideal, const SceneNoise& noise, uint64_t seed,
                        uint64_t frame, DepthImage* image) {
  const int width = ideal.camera.width, height = ideal.camera.height;
  const double K = noise.disparity_constant();
  std::vector<float> disparity =
      AverageAlong(ideal, AverageAlong(ideal, Disparity(ideal, K), noise.match_width_px(), true),
                   noise.match_height_px(), false);

  const auto box_noise = [&](uint64_t of) {
    return BoxNoise(width, height, noise.noise_width_px(), noise.noise_height_px(), of);
  };
  const std::vector<float> frozen = box_noise(Stream(seed, 0));
  const std::vector<float> moving = box_noise(Stream(seed, 100 + frame));
  const std::vector<float> field =
      SmoothField(width, height, noise.distortion_length_px(), Stream(noise.sensor_seed(), 1));
  const float a = static_cast<float>(noise.sigma_counts() * std::sqrt(noise.frozen_fraction()));
  const float b = static_cast<float>(noise.sigma_counts() * std::sqrt(1 - noise.frozen_fraction()));
  const float c = static_cast<float>(noise.distortion_counts());

  const std::vector<uint8_t> shadow = ShadowMask(ideal, noise, Stream(seed, 2));
  const double min_incidence = std::cos(noise.max_incidence_rad());
  std::mt19937_64 random(Stream(seed, 200 + frame * 2 + (uint64_t{1} << 32)));
  std::bernoulli_distribution is_hole(noise.hole_fraction());
  for (size_t i = 0; i < disparity.size(); ++i) {
    const bool hole = is_hole(random);
    if (ideal.solid[i] < 0 || hole || shadow[i]) continue;
    if (static_cast<double>(ideal.incidence[i]) < min_incidence) continue;
    const float D = std::round(disparity[i] + a * frozen[i] + b * moving[i] + c * field[i]);
    if (D >= 1) image->counts[i] = ToCount(K / static_cast<double>(D), image->depth_scale_m);
  }
}

// [m] before depths are rounded.
double WhiteSigma(const SceneNoise& noise, double z) {
  const double beyond_m = z - kWhiteNoiseDepth_m;
  return noise.white_sigma_m() + noise.white_sigma_per_m() * beyond_m * beyond_m;
}

void SenseWithWhiteNoise(const IdealImage& ideal, const SceneNoise& noise, uint64_t seed,
                         uint64_t frame, DepthImage* image) {
  const double K = noise.disparity_constant();
  std::mt19937_64 random(Stream(seed, 100 + frame));
  std::normal_distribution<double> normal;
  for (size_t i = 0; i < ideal.z.size(); ++i) {
    const double z = static_cast<double>(ideal.z[i]);
    const double noisy = z + WhiteSigma(noise, z) * normal(random);
    if (ideal.solid[i] < 0 || noisy <= 0) continue;
    const double D = std::round(K / noisy);
    if (D >= 1) image->counts[i] = ToCount(K / D, image->depth_scale_m);
  }
}

}  // namespace

DepthImage Sense(const IdealImage& ideal, const SceneNoise& noise, double depth_scale_m,
                 uint64_t seed, uint64_t frame) {
  DepthImage image;
  image.camera = ideal.camera;
  image.depth_scale_m = depth_scale_m;
  image.counts.assign(ideal.z.size(), 0);
  if (noise.model() == "real_sensor") {
    SenseRealistically(ideal, noise, seed, frame, &image);
  } else if (noise.model() == "white") {
    SenseWithWhiteNoise(ideal, noise, seed, frame, &image);
  } else {
    for (size_t i = 0; i < ideal.z.size(); ++i) {
      image.counts[i] = ToCount(static_cast<double>(ideal.z[i]), depth_scale_m);
    }
  }
  return image;
}

double DepthSigma(const SceneNoise& noise, double z) {
  const double count_m = z * z / noise.disparity_constant();
  const double rounding_m = count_m / std::sqrt(12.0);
  const double sigma_m =
      noise.model() == "white" ? WhiteSigma(noise, z) : noise.sigma_counts() * count_m;
  return std::hypot(sigma_m, rounding_m);
}

int PixelsPerSample(const SceneNoise& noise) {
  return noise.model() == "white" ? 1 : noise.noise_width_px() * noise.noise_height_px();
}

}  // namespace declutter
