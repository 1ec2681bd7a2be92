#include "modules/plane_filter/prism.h"

#include <cstring>
#include <utility>

#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

// Corners that move the border of the hull by less are noise [m].
constexpr double kHullTolerance = 0.003;

}  // namespace

const std::vector<Eigen::Vector2d>& PlaneHull::Find(const InverseDepth& image,
                                                    const InversePlane& plane,
                                                    const std::vector<uint8_t>& labels,
                                                    uint8_t label) {
  const Eigen::Matrix3d R_TC = TableFrame(plane.ToPlane()).linear();
  points_.clear();
  const auto add = [&](size_t u, int v) {
    const Eigen::Vector3d ray(image.ray_x[u], image.ray_y[static_cast<size_t>(v)], 1);
    const double value = plane.a * ray.x() + plane.b * ray.y() + plane.c;
    if (value > 0) points_.push_back((R_TC * ray).head<2>() / value);
  };
  // A plane keeps lines straight: the ends of the rows have the hull of all pixels.
  const auto width = static_cast<size_t>(image.width);
  for (int v = 0; v < image.height; ++v) {
    const uint8_t* row = &labels[image.Index(0, v)];
    const void* first = std::memchr(row, label, width);
    if (first == nullptr) continue;
    add(static_cast<size_t>(static_cast<const uint8_t*>(first) - row), v);
    size_t last = width - 1;
    while (row[last] != label) --last;
    add(last, v);
  }
  ConvexHull(&points_, &hull_);
  hull_ = SimplifyHull(std::move(hull_), kHullTolerance);
  return hull_;
}

Prism::Prism(const InversePlane& plane, const std::vector<Eigen::Vector2d>& hull_T, double margin_m,
             Prism recycled)
    : base_(hull_T, margin_m, std::move(recycled.base_)) {
  const Eigen::Matrix3d R_TC = TableFrame(plane.ToPlane()).linear();
  x_axis_ = R_TC.row(0).transpose().cast<float>();
  y_axis_ = R_TC.row(1).transpose().cast<float>();
}

void Prism::MarkContained(const InverseDepth& image, int v, const uint8_t* marked,
                          uint8_t* contained) const {
  const std::vector<Eigen::Vector3f>& edges = base_.edges();
  const RegionView region{x_axis_.data(), y_axis_.data(), edges.empty() ? nullptr : edges[0].data(),
                          edges.size()};
  declutter::MarkContained(image.ray_x.data(), image.ray_y[static_cast<size_t>(v)],
                           &image.values[image.Index(0, v)], marked,
                           static_cast<size_t>(image.width), region, contained);
}

}  // namespace declutter
