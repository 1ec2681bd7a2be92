#include "modules/feature_estimator/components.h"

#include <algorithm>
#include <numeric>

namespace declutter {
namespace {

constexpr int32_t kNoPatch = -1;

// Disjoint sets of elements, each named by its smallest element.
class DisjointSets {
 public:
  explicit DisjointSets(size_t size) : parent_(size) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  int32_t Find(size_t element) {
    auto root = static_cast<int32_t>(element);
    while (Parent(root) != root) root = Parent(root) = Parent(Parent(root));
    return root;
  }

  void Unite(size_t a, size_t b) {
    const int32_t root_a = Find(a), root_b = Find(b);
    Parent(std::max(root_a, root_b)) = std::min(root_a, root_b);
  }

 private:
  int32_t& Parent(int32_t element) { return parent_[static_cast<size_t>(element)]; }

  std::vector<int32_t> parent_;
};

// a has a point.
bool AreConnected(const PointImage& points, const Connection& connection, size_t a, size_t b) {
  const float x = points.x[a] - points.x[b];
  const float y = points.y[a] - points.y[b];
  const float z = points.z[a] - points.z[b];
  const float depth = std::min(points.z[a], points.z[b]);
  const float distance = std::max(static_cast<float>(connection.distance_m),
                                  static_cast<float>(connection.distance_per_z2) * depth * depth);
  return points.HasPoint(b) && x * x + y * y + z * z <= distance * distance;
}

// Per element the last one of the run of equal labels that it is in.
std::vector<size_t> FindRunEnds(const std::vector<int32_t>& label) {
  std::vector<size_t> run_end(label.size());
  for (size_t i = label.size(); i-- > 0;) {
    const bool goes_on = i + 1 < label.size() && label[i + 1] == label[i];
    run_end[i] = goes_on ? run_end[i + 1] : i;
  }
  return run_end;
}

}  // namespace

ComponentImage LabelComponents(const PointImage& points, const Connection& connection,
                               int min_points) {
  DisjointSets sets(points.x.size());
  const auto reach = static_cast<size_t>(std::max(1, connection.reach_px / points.thinning));
  const auto for_each_point = [&points](const auto& visit) {
    for (int j = 0; j < points.height; ++j) {
      for (int i = 0; i < points.width; ++i) {
        if (points.HasPoint(points.Index(i, j))) visit(points.Index(i, j));
      }
    }
  };
  const auto connect = [&](size_t a, size_t b) {
    if (AreConnected(points, connection, a, b)) sets.Unite(a, b);
  };

  // Direct neighbours first: nearly all points are then in the right set, and the long reach only
  // looks at pairs of different sets.
  const auto stride = static_cast<size_t>(points.stride);
  for_each_point([&](size_t p) {
    connect(p, p + 1);
    connect(p, p + stride);
  });
  std::vector<int32_t> patch(points.x.size(), kNoPatch);
  for_each_point([&](size_t p) { patch[p] = sets.Find(p); });
  const std::vector<size_t> run_end = FindRunEnds(patch);
  for_each_point([&](size_t p) {
    for (size_t row = 0; row <= reach; ++row) {
      const size_t first = p + row * stride - (row == 0 ? 0 : reach);
      const size_t last = p + row * stride + reach;
      if (patch[first] == patch[p] && run_end[first] >= last) continue;
      for (size_t q = first; q <= last; ++q) {
        if (patch[q] != patch[p] && patch[q] != kNoPatch) connect(p, q);
      }
    }
  });

  std::vector<int32_t> num_points(points.x.size(), 0);
  for_each_point([&](size_t p) { ++num_points[static_cast<size_t>(sets.Find(p))]; });
  ComponentImage components;
  components.label.assign(points.x.size(), -1);
  for_each_point([&](size_t p) {
    const auto root = static_cast<size_t>(sets.Find(p));
    if (num_points[root] < min_points) return;
    if (root == p) components.label[root] = components.num_components++;
    components.label[p] = components.label[root];
  });
  return components;
}

}  // namespace declutter
