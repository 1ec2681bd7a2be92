#include "modules/scene_renderer/sensor_model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace declutter {
namespace {

constexpr PinholeCamera kCamera{640, 480, 525, 525, 319.5, 239.5};
constexpr double kScale_m = 0.001;

// A wall that faces the camera at z_m.
IdealImage WallAt(double z_m) {
  Solid wall;
  wall.X_CO.translation() = Eigen::Vector3d(0, 0, z_m + 0.05);
  wall.size = Eigen::Vector3d(10, 10, 0.1);
  return CastRays(kCamera, {wall});
}

// A table 0.6 m below the camera, which looks down by pitch_rad, and a box on it.
IdealImage BoxOnTable(double pitch_rad, const Eigen::Vector3d& size) {
  Eigen::Matrix3d R_WC;
  R_WC << 1, 0, 0, 0, -std::sin(pitch_rad), std::cos(pitch_rad), 0, -std::cos(pitch_rad),
      -std::sin(pitch_rad);
  Eigen::Isometry3d X_WC = Eigen::Isometry3d::Identity();
  X_WC.linear() = R_WC;
  X_WC.translation().z() = 0.6;
  const Eigen::Isometry3d X_CW = X_WC.inverse();
  const Solid box{Shape::kBox, X_CW * Eigen::Translation3d(0, 0.7, size.z() / 2), size};
  const Solid table{Shape::kBox, X_CW * Eigen::Translation3d(0, 0.8, -0.05), {4, 4, 0.1}};
  return CastRays(kCamera, {box, table});
}

double Disparity(const SceneNoise& noise, double z) { return noise.disparity_constant() / z; }

// Correlation of residuals in D, planes of 64 x 48 px taken out, at a lag of (du, dv).
struct Residuals {
  std::vector<double> values;  // NaN where there is no depth

  Residuals(const IdealImage& ideal, const DepthImage& image, const SceneNoise& noise)
      : values(ideal.z.size(), std::nan("")) {
    for (int v = 0; v < 480; v += 48) {
      for (int u = 0; u < 640; u += 64) RemovePlane(image, noise, u, v);
    }
  }

  void RemovePlane(const DepthImage& image, const SceneNoise& noise, int u_begin, int v_begin) {
    Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    const auto each = [&](auto&& visit) {
      for (int v = v_begin; v < v_begin + 48; ++v) {
        for (int u = u_begin; u < u_begin + 64; ++u) {
          if (image.CountAt(u, v) == 0) continue;
          visit(v * 640 + u, Eigen::Vector3d(1, u - u_begin, v - v_begin),
                Disparity(noise, image.DepthAt(u, v)));
        }
      }
    };
    each([&](int, const Eigen::Vector3d& x, double D) {
      A += x * x.transpose();
      b += x * D;
    });
    const Eigen::Vector3d plane = A.ldlt().solve(b);
    each([&](int pixel, const Eigen::Vector3d& x, double D) {
      values[static_cast<size_t>(pixel)] = D - plane.dot(x);
    });
  }

  double Covariance(int du, int dv) const {
    double sum = 0;
    int count = 0;
    for (int v = 0; v + dv < 480; ++v) {
      for (int u = 0; u + du < 640; ++u) {
        const double product = values[static_cast<size_t>(v * 640 + u)] *
                               values[static_cast<size_t>((v + dv) * 640 + u + du)];
        if (std::isnan(product)) continue;
        sum += product;
        ++count;
      }
    }
    return sum / count;
  }
};

TEST(SensorModelTest, NoNoiseRoundsDepthToCountsOnly) {
  SceneNoise noise;
  noise.set_model("none");
  const DepthImage image = Sense(WallAt(0.9004), noise, kScale_m, 1, 0);
  for (const uint16_t count : image.counts) ASSERT_EQ(count, 900);
}

TEST(SensorModelTest, WhiteNoiseHasTheStatedSigmaAndNoCorrelation) {
  SceneNoise noise;
  noise.set_model("white");
  const IdealImage ideal = WallAt(0.9);
  const DepthImage image = Sense(ideal, noise, 1e-4, 1, 0);
  const Residuals residuals(ideal, image, noise);
  // Sigma and the rounding of D, which spans 2.3 mm there.
  const double step_m = 0.9 * 0.9 / 347;
  const double expected_m = std::hypot(0.0012 + 0.0019 * 0.25, step_m / std::sqrt(12.0));
  EXPECT_NEAR(std::sqrt(residuals.Covariance(0, 0)) * step_m, expected_m, 0.03e-3);
  EXPECT_NEAR(residuals.Covariance(1, 0) / residuals.Covariance(0, 0), 0, 0.02);
}

TEST(SensorModelTest, ResidualsOfATableHaveTheMeasuredSigmaAndCorrelation) {
  const SceneNoise noise;
  const IdealImage ideal = BoxOnTable(0.75, {0.001, 0.001, 0.001});
  const Residuals residuals(ideal, Sense(ideal, noise, kScale_m, 1, 0), noise);
  const double variance = residuals.Covariance(0, 0);
  EXPECT_NEAR(std::sqrt(variance), 0.70, 0.05);
  const double along_u[] = {.73, .60, .49, .40, .31, .22, .14, .10};
  for (int lag = 1; lag <= 8; ++lag) {
    EXPECT_NEAR(residuals.Covariance(lag, 0) / variance, along_u[lag - 1], 0.08) << "lag " << lag;
  }
  const double along_v[] = {.58, .35, .17, .04, 0};
  for (int lag = 1; lag <= 5; ++lag) {
    EXPECT_NEAR(residuals.Covariance(0, lag) / variance, along_v[lag - 1], 0.08) << "lag " << lag;
  }
}

TEST(SensorModelTest, HalfOfTheNoiseVarianceStaysFromFrameToFrame) {
  const SceneNoise noise;
  const IdealImage ideal = WallAt(0.9);
  const Residuals first(ideal, Sense(ideal, noise, 1e-4, 1, 0), noise);
  const Residuals second(ideal, Sense(ideal, noise, 1e-4, 1, 1), noise);
  double sum = 0;
  int count = 0;
  for (size_t i = 0; i < first.values.size(); ++i) {
    if (std::isnan(first.values[i]) || std::isnan(second.values[i])) continue;
    sum += first.values[i] * second.values[i];
    ++count;
  }
  EXPECT_NEAR(sum / count / first.Covariance(0, 0), 0.5, 0.1);
}

TEST(SensorModelTest, PullsTheTopOutlineTowardTheCameraAndPushesTheBackgroundAway) {
  SceneNoise noise;
  noise.set_distortion_counts(0);
  noise.set_hole_fraction(0);
  const IdealImage ideal = BoxOnTable(0.64, {0.2, 0.1, 0.12});
  const DepthImage image = Sense(ideal, noise, 1e-4, 1, 0);
  const auto mean_bias_m = [&](int rows_above_outline) {
    double sum = 0;
    for (int u = 290; u < 350; ++u) {
      int v = 0;
      while (ideal.solid[static_cast<size_t>(v * 640 + u)] != 0) ++v;
      v -= rows_above_outline;
      sum += image.DepthAt(u, v) - static_cast<double>(ideal.z[static_cast<size_t>(v * 640 + u)]);
    }
    return sum / 60;
  };
  EXPECT_NEAR(mean_bias_m(0), -0.0023, 0.0012);
  EXPECT_NEAR(mean_bias_m(1), 0.0040, 0.0015);
}

TEST(SensorModelTest, LosesPixelsAtGrazingIncidenceAndAtRandom) {
  const SceneNoise noise;
  // From the horizon down to 14 degrees below it the table is seen at more than 78 degrees from
  // its normal.
  const IdealImage ideal = BoxOnTable(0.25, {0.001, 0.001, 0.001});
  const DepthImage image = Sense(ideal, noise, kScale_m, 1, 0);
  int num_grazing = 0, num_seen = 0, num_holes = 0;
  for (size_t i = 0; i < ideal.z.size(); ++i) {
    if (ideal.solid[i] != 1) continue;
    const bool measured = image.counts[i] != 0;
    if (static_cast<double>(ideal.incidence[i]) < std::cos(noise.max_incidence_rad())) {
      num_grazing += measured ? 1 : 0;
      continue;
    }
    ++num_seen;
    num_holes += measured ? 0 : 1;
  }
  EXPECT_EQ(num_grazing, 0);
  EXPECT_NEAR(static_cast<double>(num_holes) / num_seen, 0.007, 0.001);
}

TEST(SensorModelTest, SameSeedAndFrameGiveTheSameImage) {
  const SceneNoise noise;
  const IdealImage ideal = BoxOnTable(0.75, {0.1, 0.1, 0.1});
  const DepthImage image = Sense(ideal, noise, kScale_m, 5, 2);
  EXPECT_EQ(image.counts, Sense(ideal, noise, kScale_m, 5, 2).counts);
  EXPECT_NE(image.counts, Sense(ideal, noise, kScale_m, 6, 2).counts);
}

}  // namespace
}  // namespace declutter
