#include "modules/hough_segmenter/model_fits.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace declutter {
namespace {

template <typename Model>
void SetHeights(const std::vector<SideCell>& cells, Fit<Model>* fit) {
  fit->model.z_min = std::numeric_limits<float>::max();
  fit->model.z_max = std::numeric_limits<float>::lowest();
  for (int i : fit->inliers) {
    const float z = cells[static_cast<size_t>(i)].z;
    fit->model.z_min = std::min(fit->model.z_min, z);
    fit->model.z_max = std::max(fit->model.z_max, z);
  }
}

}  // namespace

LineModel LineThrough(const SideCell& a, const SideCell& b) {
  LineModel line;
  const Eigen::Vector2f t = (b.p - a.p).normalized();
  line.n = {t.y(), -t.x()};
  if (line.n.dot(a.n + b.n) < 0) line.n = -line.n;
  line.rho = 0.5f * line.n.dot(a.p + b.p);
  return line;
}

std::optional<CircleModel> CircleThrough(const SideCell& a, const SideCell& b) {
  const float sine = a.n.x() * b.n.y() - a.n.y() * b.n.x();
  if (std::abs(sine) < 0.1f) return std::nullopt;
  const Eigen::Vector2f ab = b.p - a.p;
  // c = a.p - ra * a.n = b.p - rb * b.n
  const float ra = -(ab.x() * b.n.y() - ab.y() * b.n.x()) / sine;
  const float rb = -(ab.x() * a.n.y() - ab.y() * a.n.x()) / sine;
  if (ra <= 0 || rb <= 0) return std::nullopt;
  CircleModel circle;
  circle.r = 0.5f * (ra + rb);
  circle.c = 0.5f * (a.p - circle.r * a.n + b.p - circle.r * b.n);
  return circle;
}

void FitToInliers(const std::vector<SideCell>& cells, LineFit* fit) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double total = 0;
  for (int i : fit->inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    const double w = cell.weight / (cell.sigma * cell.sigma);
    mean += w * cell.p.cast<double>();
    total += w;
  }
  mean /= total;
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (int i : fit->inliers) {
    const SideCell& cell = cells[static_cast<size_t>(i)];
    const Eigen::Vector2d q = cell.p.cast<double>() - mean;
    scatter += cell.weight / (cell.sigma * cell.sigma) * q * q.transpose();
  }
  // Direction of the larger axis of the scatter; the normal is across it.
  const double angle = 0.5 * std::atan2(2 * scatter(0, 1), scatter(0, 0) - scatter(1, 1));
  Eigen::Vector2f n(static_cast<float>(-std::sin(angle)), static_cast<float>(std::cos(angle)));
  if (n.dot(fit->model.n) < 0) n = -n;
  fit->model.n = n;
  fit->model.rho = n.dot(mean.cast<float>());
}

void FitToInliers(const std::vector<SideCell>& cells, CircleFit* fit) {
  Eigen::Vector3d x(fit->model.c.x(), fit->model.c.y(), fit->model.r);
  for (int iteration = 0; iteration < 4; ++iteration) {
    Eigen::Matrix3d H = Eigen::Matrix3d::Identity() * 1e-9;
    Eigen::Vector3d g = Eigen::Vector3d::Zero();
    for (int i : fit->inliers) {
      const SideCell& cell = cells[static_cast<size_t>(i)];
      const double w = cell.weight / (cell.sigma * cell.sigma);
      const Eigen::Vector2d q = cell.p.cast<double>() - x.head<2>();
      const double distance = std::max(q.norm(), 1e-6);
      const Eigen::Vector3d J(-q.x() / distance, -q.y() / distance, -1.0);
      H += w * J * J.transpose();
      g += w * J * (distance - x.z());
    }
    x -= H.ldlt().solve(g);
  }
  if (!x.allFinite() || x.z() <= 0) return;
  fit->model.c = x.head<2>().cast<float>();
  fit->model.r = static_cast<float>(x.z());
}

void SetExtent(const std::vector<SideCell>& cells, LineFit* fit) {
  const Eigen::Vector2f t = fit->model.tangent();
  fit->model.s_min = std::numeric_limits<float>::max();
  fit->model.s_max = std::numeric_limits<float>::lowest();
  for (int i : fit->inliers) {
    const float s = t.dot(cells[static_cast<size_t>(i)].p);
    fit->model.s_min = std::min(fit->model.s_min, s);
    fit->model.s_max = std::max(fit->model.s_max, s);
  }
  SetHeights(cells, fit);
}

void SetExtent(const std::vector<SideCell>& cells, CircleFit* fit) { SetHeights(cells, fit); }

}  // namespace declutter
