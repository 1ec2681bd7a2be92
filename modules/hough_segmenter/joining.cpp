#include "modules/hough_segmenter/joining.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kSameHeight = 0.005f;  // [m] between the parts of one top face

// Faces on one line with a gap between them, as an occluder in front leaves them, as one.
std::optional<Face> Join(const Face& a, const Face& b, float max_extent) {
  const LineModel& f = a.model;
  const LineModel& g = b.model;
  if (f.n.dot(g.n) < 0.995f || std::abs(f.z_max - g.z_max) > kTopTolerance) return std::nullopt;
  const Eigen::Vector2f p = g.PointAt(0.5f * (g.s_min + g.s_max));
  if (std::abs(f.n.dot(p) - f.rho) > 0.01f) return std::nullopt;
  Face joined = a;
  const Eigen::Vector2f q0 = g.PointAt(g.s_min);
  const Eigen::Vector2f q1 = g.PointAt(g.s_max);
  LineModel& line = joined.model;
  line.n = (static_cast<float>(a.num_points) * f.n + static_cast<float>(b.num_points) * g.n)
               .normalized();
  const Eigen::Vector2f t = line.tangent();
  const Eigen::Vector2f p0 = f.PointAt(f.s_min);
  const Eigen::Vector2f p1 = f.PointAt(f.s_max);
  line.rho = 0.25f * line.n.dot(p0 + p1 + q0 + q1);
  line.s_min = std::min(t.dot(p0), t.dot(q0));
  line.s_max = std::max(t.dot(p1), t.dot(q1));
  line.z_min = std::min(f.z_min, g.z_min);
  line.z_max = std::max(f.z_max, g.z_max);
  if (line.length() > max_extent) return std::nullopt;
  joined.num_points += b.num_points;
  joined.num_votes += b.num_votes;
  return joined;
}

// [m] between the boxes around two hulls, in the direction in which they are farther apart.
float GapBetween(const TopPatch& a, const TopPatch& b) {
  Eigen::AlignedBox2f box_a, box_b;
  for (const Eigen::Vector2f& p : a.hull) box_a.extend(p);
  for (const Eigen::Vector2f& p : b.hull) box_b.extend(p);
  return (box_a.min() - box_b.max()).cwiseMax(box_b.min() - box_a.max()).maxCoeff();
}

}  // namespace

void AppendJoinedFaces(float max_extent, size_t max_joined, std::vector<Face>* faces) {
  const size_t num = faces->size();
  for (size_t i = 0; i < num; ++i) {
    for (size_t j = i + 1; j < num && faces->size() < num + max_joined; ++j) {
      if (const auto joined = Join((*faces)[i], (*faces)[j], max_extent)) faces->push_back(*joined);
    }
  }
}

void JoinPatches(const TopPatches& tops, float max_extent, size_t max_joined, TopPatches* joined) {
  joined->Clear();
  for (size_t i = 0; i < tops.size(); ++i) {
    for (size_t j = i + 1; j < tops.size() && joined->size() < max_joined; ++j) {
      if (std::abs(tops[i].height - tops[j].height) > kSameHeight ||
          GapBetween(tops[i], tops[j]) > max_extent) {
        continue;
      }
      TopPatch& both = joined->Add();
      both = tops[i];
      const auto num_i = static_cast<float>(tops[i].points.size());
      const auto num_j = static_cast<float>(tops[j].points.size());
      both.height = (num_i * tops[i].height + num_j * tops[j].height) / (num_i + num_j);
      both.points.Append(tops[j].points);
      both.free_edge.insert(both.free_edge.end(), tops[j].free_edge.begin(),
                            tops[j].free_edge.end());
      both.hull.insert(both.hull.end(), tops[j].hull.begin(), tops[j].hull.end());
    }
  }
}

}  // namespace declutter
