#include "modules/feature_estimator/components.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace declutter {
namespace {

constexpr int32_t kNoPatch = -1;

// Disjoint sets of elements, each named by its smallest element, in given memory.
class DisjointSets {
 public:
  explicit DisjointSets(std::vector<int32_t>* parent) : parent_(*parent) {
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

  std::vector<int32_t>& parent_;
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

// Sets for each point the last one of the run of points of its patch that it is in.
void FindRunEnds(ComponentImage* image) {
  const std::vector<int32_t>& patch = image->patch;
  for (size_t k = image->elements.size(); k-- > 0;) {
    const int32_t p = image->elements[k];
    const auto i = static_cast<size_t>(p);
    image->run_end[i] = patch[i + 1] == patch[i] ? image->run_end[i + 1] : p;
  }
}

}  // namespace

ComponentImage LabelComponents(const PointImage& points, const Connection& connection,
                               int min_points, ComponentImage recycled) {
  ComponentImage components = std::move(recycled);
  components.num_components = 0;
  components.label.assign(points.x.size(), -1);
  components.patch.assign(points.x.size(), kNoPatch);
  components.num_points.assign(points.x.size(), 0);
  components.run_end.resize(points.x.size());
  components.parent.resize(points.x.size());
  components.elements.clear();
  for (int j = 0; j < points.height; ++j) {
    for (size_t p = points.Index(0, j); p < points.Index(points.width, j); ++p) {
      if (points.HasPoint(p)) components.elements.push_back(static_cast<int32_t>(p));
    }
  }
  DisjointSets sets(&components.parent);
  const auto for_each_point = [&components](const auto& visit) {
    for (const int32_t p : components.elements) visit(static_cast<size_t>(p));
  };
  const auto connect = [&](size_t a, size_t b) {
    if (AreConnected(points, connection, a, b)) sets.Unite(a, b);
  };

  // Direct neighbours first: nearly all points are then in the right set, and the long reach only
  // looks at pairs of different sets.
  const auto reach = static_cast<size_t>(std::max(1, connection.reach_px / points.thinning));
  const auto stride = static_cast<size_t>(points.stride);
  for_each_point([&](size_t p) {
    connect(p, p + 1);
    connect(p, p + stride);
  });
  int32_t* patch = components.patch.data();
  for_each_point([&](size_t p) { patch[p] = sets.Find(p); });
  FindRunEnds(&components);
  for_each_point([&](size_t p) {
    for (size_t row = 0; row <= reach; ++row) {
      const size_t first = p + row * stride - (row == 0 ? 0 : reach);
      const size_t last = p + row * stride + reach;
      if (patch[first] == patch[p] && static_cast<size_t>(components.run_end[first]) >= last) {
        continue;
      }
      for (size_t q = first; q <= last; ++q) {
        if (patch[q] != patch[p] && patch[q] != kNoPatch) connect(p, q);
      }
    }
  });

  for_each_point([&](size_t p) { ++components.num_points[static_cast<size_t>(sets.Find(p))]; });
  for_each_point([&](size_t p) {
    const auto root = static_cast<size_t>(sets.Find(p));
    if (components.num_points[root] < min_points) return;
    if (root == p) components.label[root] = components.num_components++;
    components.label[p] = components.label[root];
  });
  return components;
}

}  // namespace declutter
