#include "modules/scene_renderer/disparity_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

namespace declutter {
namespace {

// Spacing of the grid the irregular field is made on; it is interpolated between [px].
constexpr int kGridStep_px = 8;

std::vector<float> WhiteNoise(size_t count, uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<float> normal;
  std::vector<float> noise(count);
  for (float& value : noise) value = normal(random);
  return noise;
}

// Sums of `length` neighbours along lines of `count` values `stride` apart; each line loses
// length - 1 values at its end.
void SumAlong(std::vector<float>* values, size_t first, size_t count, size_t stride,
              size_t length) {
  float* line = values->data() + first;
  std::vector<double> sum(count + 1, 0);
  for (size_t i = 0; i < count; ++i) sum[i + 1] = sum[i] + line[i * stride];
  for (size_t i = 0; i + length <= count; ++i) {
    line[i * stride] = static_cast<float>(sum[i + length] - sum[i]);
  }
}

// Columns of the constant, linear and quadratic parts of a field at (x, y) in [-1, 1].
Eigen::Matrix<double, 6, 1> Monomials(double x, double y) {
  Eigen::Matrix<double, 6, 1> m;
  m << 1, x, y, x * x, x * y, y * y;
  return m;
}

double Rms(const Eigen::VectorXd& values) {
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

// Removes what the first `count` columns of A explain.
Eigen::VectorXd Residual(const Eigen::MatrixXd& A, int count, const Eigen::VectorXd& values) {
  const Eigen::MatrixXd part = A.leftCols(count);
  return values - part * (part.transpose() * part).ldlt().solve(part.transpose() * values);
}

// White noise on a grid, smoothed by a Gaussian of sigma_cells.
Eigen::VectorXd GaussianField(int columns, int rows, double sigma_cells, uint64_t seed) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_cells));
  const Eigen::Index wide = columns + 2 * reach, high = rows + 2 * reach;
  const std::vector<float> white = WhiteNoise(static_cast<size_t>(wide * high), seed);
  Eigen::VectorXd kernel(2 * reach + 1);
  for (int i = -reach; i <= reach; ++i)
    kernel[i + reach] = std::exp(-0.5 * i * i / (sigma_cells * sigma_cells));
  const Eigen::MatrixXd grid =
      Eigen::Map<const Eigen::MatrixXf>(white.data(), wide, high).cast<double>();
  Eigen::MatrixXd along(columns, high);
  for (int u = 0; u < columns; ++u) {
    along.row(u) = kernel.transpose() * grid.middleRows(u, kernel.size());
  }
  Eigen::MatrixXd smooth(columns, rows);
  for (int v = 0; v < rows; ++v) smooth.col(v) = along.middleCols(v, kernel.size()) * kernel;
  return Eigen::Map<Eigen::VectorXd>(smooth.data(), smooth.size());
}

std::vector<float> Interpolate(const Eigen::VectorXd& grid, int columns, int width, int height) {
  std::vector<float> field;
  field.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
  for (int v = 0; v < height; ++v) {
    const Eigen::Index row = v / kGridStep_px;
    const double b = static_cast<double>(v % kGridStep_px) / kGridStep_px;
    for (int u = 0; u < width; ++u) {
      const Eigen::Index at = row * columns + u / kGridStep_px;
      const double a = static_cast<double>(u % kGridStep_px) / kGridStep_px;
      const double upper = (1 - a) * grid[at] + a * grid[at + 1];
      const double lower = (1 - a) * grid[at + columns] + a * grid[at + columns + 1];
      field.push_back(static_cast<float>((1 - b) * upper + b * lower));
    }
  }
  return field;
}

}  // namespace

std::vector<float> BoxNoise(int width, int height, int box_width, int box_height, uint64_t seed) {
  const size_t wide = static_cast<size_t>(width + box_width - 1);
  const size_t high = static_cast<size_t>(height + box_height - 1);
  std::vector<float> noise = WhiteNoise(wide * high, seed);
  for (size_t v = 0; v < high; ++v) {
    SumAlong(&noise, v * wide, wide, 1, static_cast<size_t>(box_width));
  }
  std::vector<float> field(static_cast<size_t>(width) * static_cast<size_t>(height), 0);
  const float scale = 1 / std::sqrt(static_cast<float>(box_width * box_height));
  for (size_t v = 0; v < static_cast<size_t>(height); ++v) {
    float* out = field.data() + v * static_cast<size_t>(width);
    for (size_t k = 0; k < static_cast<size_t>(box_height); ++k) {
      const float* in = noise.data() + (v + k) * wide;
      for (size_t u = 0; u < static_cast<size_t>(width); ++u) out[u] += scale * in[u];
    }
  }
  return field;
}

std::vector<float> SmoothField(int width, int height, double length_px, uint64_t seed) {
  const int columns = (width - 1) / kGridStep_px + 2, rows = (height - 1) / kGridStep_px + 2;
  Eigen::MatrixXd A(columns * rows, 6);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      A.row(row * columns + column) =
          Monomials(2.0 * column / (columns - 1) - 1, 2.0 * row / (rows - 1) - 1);
    }
  }
  // Smoothing white noise by a Gaussian s gives the correlation exp(-length^2 / (4 s^2)).
  const double sigma_px = length_px / (2 * std::sqrt(std::log(2.0)));
  const Eigen::VectorXd irregular =
      Residual(A, 6, GaussianField(columns, rows, sigma_px / kGridStep_px, seed));
  const std::vector<float> weights = WhiteNoise(3, seed + 1);
  const Eigen::Vector3d w = Eigen::Map<const Eigen::Vector3f>(weights.data()).cast<double>();
  const Eigen::VectorXd quadratic = Residual(A, 3, A.rightCols(3) * w);
  const double half = std::sqrt(0.5);
  return Interpolate(irregular * (half / Rms(irregular)) + quadratic * (half / Rms(quadratic)),
                     columns, width, height);
}

}  // namespace declutter
