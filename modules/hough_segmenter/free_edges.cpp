#include "modules/hough_segmenter/free_edges.h"

#include <cmath>

namespace declutter {
namespace {

constexpr int kMaxGap = 5;  // [px] without object points across which an occluder is seen
constexpr float kSameHeight = 0.008f;  // [m] between a point and the face it may belong to

class EdgeTracer {
 public:
  EdgeTracer(const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
             const std::vector<int32_t>& labels)
      : image_(tabletop.objects), thinning_(tabletop.thinning), X_TC_(X_TC), labels_(labels) {}

  // What is first seen beside a face from pixel (u, v) in steps of (du, dv) is below it, or
  // nothing.
  bool IsFree(int u, int v, int du, int dv, float face_height) const {
    const int32_t label = LabelAt(u, v);
    for (int step = 1; step <= kMaxGap; ++step) {
      const int x = u + step * du * thinning_;
      const int y = v + step * dv * thinning_;
      if (x < 0 || y < 0 || x >= image_.camera.width || y >= image_.camera.height) return false;
      if (image_.CountAt(x, y) == 0) continue;
      if (LabelAt(x, y) == label) return false;  // a hole in the face
      const double height = X_TC_.matrix().row(2).head<3>().dot(image_.PointAt(x, y)) +
                            X_TC_.translation().z() - face_height;
      if (std::abs(height) > kSameHeight) return height < 0;
    }
    return true;
  }

  // Where the ray half way between a pixel and the next one meets the face.
  Eigen::Vector2f EdgePoint(int u, int v, int du, int dv, float face_height) const {
    const Eigen::Vector3d ray_T =
        X_TC_.linear() * image_.camera.Ray(u + 0.5 * thinning_ * du, v + 0.5 * thinning_ * dv);
    const Eigen::Vector3d origin_T = X_TC_.translation();
    const double z = (face_height - origin_T.z()) / ray_T.z();
    return (origin_T + z * ray_T).head<2>().cast<float>();
  }

 private:
  int32_t LabelAt(int u, int v) const {
    const int columns = (image_.camera.width + thinning_ - 1) / thinning_;
    return labels_[static_cast<size_t>(v / thinning_ * columns + u / thinning_)];
  }

  const DepthImage& image_;
  int thinning_;
  const Eigen::Isometry3d& X_TC_;
  const std::vector<int32_t>& labels_;
};

}  // namespace

void AddFreeEdges(const Tabletop& tabletop, const Eigen::Isometry3d& X_TC,
                  const std::vector<int32_t>& labels, const std::vector<size_t>& pixels,
                  TopPatches* patches) {
  constexpr int kSteps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  const EdgeTracer tracer(tabletop, X_TC, labels);
  const int thinning = tabletop.thinning;
  const int columns = (tabletop.objects.camera.width + thinning - 1) / thinning;
  const int rows = static_cast<int>(labels.size()) / columns;
  int row = 0;
  for (const size_t pixel : pixels) {
    const int32_t label = labels[pixel];
    if (label < 0) continue;
    // Most pixels are amid their face.
    const auto width = static_cast<size_t>(columns);
    if (pixel > width && pixel + width < labels.size() && labels[pixel - 1] == label &&
        labels[pixel + 1] == label && labels[pixel - width] == label &&
        labels[pixel + width] == label) {
      continue;
    }
    while (static_cast<int>(pixel) >= (row + 1) * columns) ++row;
    const int column = static_cast<int>(pixel) - row * columns;
    if (row == 0 || column == 0 || row + 1 == rows || column + 1 == columns) continue;
    TopPatch& patch = (*patches)[static_cast<size_t>(label)];
    for (const auto& [du, dv] : kSteps) {
      if (labels[static_cast<size_t>((row + dv) * columns + column + du)] == label) continue;
      const int u = column * thinning;
      const int v = row * thinning;
      if (!tracer.IsFree(u, v, du, dv, patch.height)) continue;
      patch.free_edge.push_back(tracer.EdgePoint(u, v, du, dv, patch.height));
    }
  }
}

}  // namespace declutter
