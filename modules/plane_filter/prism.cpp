#include "modules/plane_filter/prism.h"

#include "modules/plane_filter/pixel_kernels.h"

namespace declutter {
namespace {

// Corners that move the border of the hull by less are noise [m].
constexpr double kHullTolerance = 0.003;

}  // namespace

std::vector<Eigen::Vector2d> HullInPlane(const InverseDepth& image, const InversePlane& plane,
                                         const PixelMask& region) {
  const Eigen::Matrix3d R_TC = TableFrame(plane.ToPlane()).linear();
  std::vector<Eigen::Vector2d> points;
  const auto add = [&](int u, int v) {
    const Eigen::Vector3d ray(image.ray_x[static_cast<size_t>(u)],
                              image.ray_y[static_cast<size_t>(v)], 1);
    const double value = plane.a * ray.x() + plane.b * ray.y() + plane.c;
    if (value > 0) points.push_back((R_TC * ray).head<2>() / value);
  };
  // A plane keeps lines straight: the ends of the rows have the hull of all pixels.
  for (int v = 0; v < image.height; ++v) {
    const uint8_t* row = &region[image.Index(0, v)];
    int first = 0;
    while (first < image.width && !row[first]) ++first;
    if (first == image.width) continue;
    int last = image.width - 1;
    while (!row[last]) --last;
    add(first, v);
    add(last, v);
  }
  return SimplifyHull(ConvexHull(std::move(points)), kHullTolerance);
}

Prism::Prism(const InversePlane& plane, const std::vector<Eigen::Vector2d>& hull_T, double margin_m)
    : base_(hull_T, margin_m) {
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
