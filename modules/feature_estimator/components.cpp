#include "modules/feature_estimator/components.h"

#include <algorithm>
#include <utility>

#include "modules/feature_estimator/lanes.h"
#include "modules/geometry/pixel_runs.h"

namespace declutter {
namespace {

// The longest distance over which points connect, by the depth of the nearer one.
class Reach {
 public:
  explicit Reach(const Connection& connection)
      : distance_m_(static_cast<float>(connection.distance_m)),
        distance_per_z2_(static_cast<float>(connection.distance_per_z2)) {}

  DECLUTTER_LANES float At(float z) const {
    return std::max(distance_m_, distance_per_z2_ * z * z);
  }

 private:
  float distance_m_, distance_per_z2_;
};

DECLUTTER_LANES bool AreConnected(const PointImage& points, const Reach& reach, size_t a,
                                  size_t b) {
  const float x = points.x[a] - points.x[b];
  const float y = points.y[a] - points.y[b];
  const float z = points.z[a] - points.z[b];
  const float distance = reach.At(std::min(points.z[a], points.z[b]));
  // Where there is no point, or none at either, z is out of reach.
  return (x * x + y * y + z * z <= distance * distance) &
         (std::max(points.z[a], points.z[b]) < PointImage::kFar);
}

// Marks in joined[1 .. num - 1] the elements from begin on that have a point connected with that of
// the element before, and in edges those that a run begins or ends with.
DECLUTTER_FOR_EACH_PROCESSOR void MarkEdges(const PointImage& points, const Reach& reach,
                                            size_t begin, size_t num, uint8_t* joined,
                                            uint8_t* edges) {
  for (size_t i = 1; i < num; ++i) {
    joined[i] = AreConnected(points, reach, begin + i - 1, begin + i);
  }
  const float* z = &points.z[begin];
  for (size_t i = 0; i < num; ++i) {
    edges[i] = RunEdges(z[i] < PointImage::kFar, joined[i], joined[i + 1]);
  }
}

// Cuts the rows into runs.
void FindRuns(const PointImage& points, const Reach& reach, Components* image) {
  const auto width = static_cast<size_t>(points.width);
  image->runs.clear();
  image->first_run.clear();
  image->joined.assign(width + 1, 0);
  image->edges.resize(width);
  for (int j = 0; j < points.height; ++j) {
    image->first_run.push_back(image->runs.size());
    const size_t begin = points.Index(0, j);
    MarkEdges(points, reach, begin, width, image->joined.data(), image->edges.data());
    AppendRuns(image->edges, begin, &image->runs);
  }
  image->first_run.push_back(image->runs.size());
  for (PointRun& run : image->runs) {
    run.z_min = run.z_max = points.z[run.begin];
    for (size_t p = run.begin + 1; p < run.end; ++p) {
      run.z_min = std::min(run.z_min, points.z[p]);
      run.z_max = std::max(run.z_max, points.z[p]);
    }
  }
}

// Joins the runs of one component. Runs of one set are not compared again, and few runs of
// different sets are near each other.
class Joiner {
 public:
  Joiner(const PointImage& points, const Connection& connection, Components* image)
      : points_(points),
        reach_(connection),
        reach_px_(std::max(1, connection.reach_px / points.thinning)),
        image_(*image),
        sets_(image->sets) {
    sets_.Reset(image->runs.size());
  }

  // Next rows first: nearly all runs are then in the right set.
  void JoinAll() {
    for (int row = 1; row <= reach_px_; ++row) JoinRows(row);
    JoinRows(0);
  }

 private:
  // Joins runs with those `distance` rows further down.
  void JoinRows(int distance) {
    const auto down = static_cast<size_t>(distance);
    const size_t shift = down * static_cast<size_t>(points_.stride);
    for (size_t j = 0; j + down < static_cast<size_t>(points_.height); ++j) {
      size_t first = image_.first_run[j + down];
      for (size_t a = image_.first_run[j]; a < image_.first_run[j + 1]; ++a) {
        const PointRun& run = image_.runs[a];
        const size_t from = run.begin + shift - margin(), to = run.end + shift + margin();
        while (first < image_.first_run[j + down + 1] && image_.runs[first].end <= from) ++first;
        for (size_t b = distance == 0 ? a + 1 : first;
             b < image_.first_run[j + down + 1] && image_.runs[b].begin < to; ++b) {
          if (sets_.Root(a) != sets_.Root(b) && Touch(run, image_.runs[b], shift)) {
            sets_.Join(a, b);
          }
        }
      }
    }
  }

  // True when a point of run a connects with one of run b, which is `shift` elements further.
  bool Touch(const PointRun& a, const PointRun& b, size_t shift) const {
    const float gap = std::max(a.z_min - b.z_max, b.z_min - a.z_max);
    if (gap > reach_.At(std::min(a.z_max, b.z_max))) return false;
    const size_t begin = std::max(a.begin + shift, b.begin - margin());
    const size_t end = std::min(a.end + shift, b.end + margin());
    for (size_t p = begin; p < end; ++p) {
      const size_t last = std::min(p + margin() + 1, b.end);
      for (size_t q = std::max(p - margin(), b.begin); q < last; ++q) {
        if (AreConnected(points_, reach_, p - shift, q)) return true;
      }
    }
    return false;
  }

  size_t margin() const { return static_cast<size_t>(reach_px_); }

  const PointImage& points_;
  Reach reach_;
  int reach_px_;
  Components& image_;
  DisjointSets& sets_;
};

}  // namespace

Components FindComponents(const PointImage& points, const Connection& connection, int min_points,
                          Components recycled) {
  Components components = std::move(recycled);
  components.num_components = 0;
  FindRuns(points, Reach(connection), &components);
  Joiner(points, connection, &components).JoinAll();

  std::vector<PointRun>& runs = components.runs;
  components.num_points.assign(runs.size(), 0);
  for (size_t i = 0; i < runs.size(); ++i) {
    components.num_points[components.sets.Root(i)] +=
        static_cast<int32_t>(runs[i].end - runs[i].begin);
  }
  for (size_t i = 0; i < runs.size(); ++i) {
    const size_t root = components.sets.Root(i);
    if (components.num_points[root] < min_points) continue;
    if (root == i) runs[i].component = components.num_components++;
    runs[i].component = runs[root].component;
  }
  return components;
}

}  // namespace declutter
