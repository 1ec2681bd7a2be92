#include "modules/hough_segmenter/rectangle.h"

#include <algorithm>
#include <cmath>

#include "modules/hough_segmenter/quantile.h"
#include "modules/hough_segmenter/solid_completion.h"

namespace declutter {
namespace {

constexpr float kEdgeTolerance = 0.015f;  // [m] between a face and the edge of the top face
constexpr int kMinNear = 10;              // [px] of a top face that begins at a face
constexpr float kBin = 0.004f;            // [m] of the profile of a top face

}  // namespace

Hypothesis MakeBox(const Rectangle& r) {
  Hypothesis hypothesis;
  const float bottom = BottomOf(r.z_min);
  const Eigen::Vector2f centre =
      0.5f * (r.a_min + r.a_max) * r.axis + 0.5f * (r.b_min + r.b_max) * r.perpendicular();
  hypothesis.solid.shape = Shape::kBox;
  hypothesis.solid.X_CO.linear() =
      Eigen::AngleAxisd(std::atan2(r.axis.y(), r.axis.x()), Eigen::Vector3d::UnitZ())
          .toRotationMatrix();
  hypothesis.solid.X_CO.translation() =
      Eigen::Vector3f(centre.x(), centre.y(), 0.5f * (bottom + r.z_max)).cast<double>();
  hypothesis.solid.size =
      Eigen::Vector3f(r.a_max - r.a_min, r.b_max - r.b_min, r.z_max - bottom).cast<double>();
  if (r.depth_is_assumed) hypothesis.evidence[1] = Evidence::kAssumed;
  if (bottom > 0) hypothesis.evidence[2] = Evidence::kAssumed;
  hypothesis.component = r.component;
  hypothesis.num_votes = r.num_votes;
  hypothesis.num_inliers = r.num_points;
  hypothesis.score = r.score;
  return hypothesis;
}

Rectangle FromFace(const Face& face) {
  Rectangle r;
  // Body behind the face: b runs along -n, so that perpendicular() = -n.
  const LineModel& line = face.model;
  r.axis = line.tangent();
  r.a_min = line.s_min;
  r.a_max = line.s_max;
  r.b_min = r.b_max = -line.rho;
  r.z_min = line.z_min;
  r.z_max = line.z_max;
  r.component = face.component;
  r.num_votes = face.num_votes;
  r.num_points = face.num_points;
  r.score = face.agreement;
  return r;
}

void RectangleFinder::FindPositions(const PlanarPoints& points, const Eigen::Vector2f& axis) {
  const auto find = [&points](float tx, float ty, std::vector<float>* positions) {
    positions->resize(points.size() + kCellBlock);
    PositionsAlong(points.x(), points.y(), points.size(), tx, ty, positions->data());
    positions->resize(points.size());
  };
  find(axis.x(), axis.y(), &a_);
  find(-axis.y(), axis.x(), &b_);
}

Rectangle RectangleFinder::Around(const TopPatch& patch, const Eigen::Vector2f& axis) {
  Rectangle r;
  r.axis = axis;
  FindPositions(patch.points, axis);
  const Range a_range = Quantiles(&a_, 0.005, 0.995);
  const Range b_range = Quantiles(&b_, 0.005, 0.995);
  r.a_min = a_range.low;
  r.a_max = a_range.high;
  r.b_min = b_range.low;
  r.b_max = b_range.high;
  r.z_max = patch.height;
  r.z_min = std::max(0.0f, patch.height - kTopOnlyDepth);
  r.component = patch.component;
  r.num_points = static_cast<int>(patch.points.size());
  return r;
}

bool IsAttached(const Face& face, const TopPatch& patch) {
  const LineModel& line = face.model;
  if (std::abs(line.z_max - patch.height) > kTopTolerance || line.z_min >= patch.height) {
    return false;
  }
  Eigen::AlignedBox2f box;  // of the patch, by position along the face and depth behind it
  for (const Eigen::Vector2f& p : patch.hull) {
    box.extend(Eigen::Vector2f(line.tangent().dot(p), line.rho - line.n.dot(p)));
  }
  if (box.min().x() >= line.s_max || box.max().x() <= line.s_min ||
      box.min().y() >= 2 * kEdgeTolerance || box.max().y() <= -kEdgeTolerance) {
    return false;
  }
  int num_near = 0;
  for (size_t i = 0; i < patch.points.size(); ++i) {
    const Eigen::Vector2f p = patch.points[i];
    const float depth = line.rho - line.n.dot(p);
    const float s = line.tangent().dot(p);
    num_near +=
        depth > -kEdgeTolerance && depth < 2 * kEdgeTolerance && s > line.s_min && s < line.s_max;
    if (num_near == kMinNear) return true;
  }
  return false;
}

void SnapToFaces(const std::vector<const Face*>& faces, Rectangle* r) {
  for (const Face* face : faces) {
    const LineModel& line = face->model;
    const Eigen::Vector2f middle = line.PointAt(0.5f * (line.s_min + line.s_max));
    const auto snap = [&](const Eigen::Vector2f& axis, float* low, float* high) {
      const float cosine = axis.dot(line.n);
      if (std::abs(cosine) < 0.985f) return false;
      float* edge = cosine > 0 ? high : low;
      const float x = axis.dot(middle);
      if (std::abs(x - *edge) > kEdgeTolerance) return false;
      *edge = x;
      return true;
    };
    if (snap(r->axis, &r->a_min, &r->a_max) || snap(r->perpendicular(), &r->b_min, &r->b_max)) {
      r->z_min = std::min(r->z_min, line.z_min);
      r->num_votes += face->num_votes;
      r->num_points += face->num_points;
      r->score = std::max(r->score, face->agreement);
    }
  }
}

std::optional<Rectangle> RectangleFinder::GrowOver(const Face& face, const TopPatch& patch,
                                                   float max_extent) {
  Rectangle r = FromFace(face);
  FindPositions(patch.points, r.axis);
  profile_.assign(static_cast<size_t>(max_extent / kBin), 0);
  size_t num_depths = 0;
  for (size_t i = 0; i < b_.size(); ++i) {
    const float depth = b_[i] - r.b_min;
    if (a_[i] < r.a_min || a_[i] > r.a_max || depth < 0) continue;
    const auto bin = static_cast<size_t>(depth / kBin);
    if (bin >= profile_.size()) continue;
    ++profile_[bin];
    b_[num_depths++] = depth;
  }
  b_.resize(num_depths);
  int front = 0;
  for (size_t bin = 0; bin < std::min<size_t>(profile_.size(), 8); ++bin) {
    front = std::max(front, profile_[bin]);
  }
  size_t end = 0;
  for (size_t bin = 0; bin < profile_.size(); ++bin) {
    if (3 * profile_[bin] >= front && profile_[bin] >= 2) end = bin + 1;
    if (bin > end + 3) break;
  }
  const float limit = static_cast<float>(end) * kBin;
  b_.erase(std::remove_if(b_.begin(), b_.end(), [&](float depth) { return depth > limit; }),
           b_.end());
  if (b_.size() < 30) return std::nullopt;
  r.b_max = r.b_min + Quantile(&b_, 0.99);
  r.z_max = patch.height;
  r.num_points += static_cast<int>(b_.size());
  return r;
}

std::optional<Rectangle> FromCorner(const Face& front, const Face& side) {
  const LineModel& f = front.model;
  const LineModel& g = side.model;
  if (std::abs(f.n.dot(g.n)) > 0.17f) return std::nullopt;
  if (std::min(f.z_max, g.z_max) - std::max(f.z_min, g.z_min) < 0.01f) return std::nullopt;
  if (std::abs(f.z_max - g.z_max) > kTopTolerance) return std::nullopt;
  Rectangle r = FromFace(front);
  // The nearer end of the side face is at the front face, the farther end at the back.
  const float b0 = r.perpendicular().dot(g.PointAt(g.s_min));
  const float b1 = r.perpendicular().dot(g.PointAt(g.s_max));
  const float a = r.axis.dot(g.PointAt(0.5f * (g.s_min + g.s_max)));
  const bool is_at_max = r.axis.dot(g.n) > 0;
  if (std::abs(std::min(b0, b1) - r.b_min) > 2 * kEdgeTolerance) return std::nullopt;
  if (std::abs(a - (is_at_max ? r.a_max : r.a_min)) > 2 * kEdgeTolerance) return std::nullopt;
  (is_at_max ? r.a_max : r.a_min) = a;
  r.b_max = std::max(b0, b1);
  r.z_min = std::min(f.z_min, g.z_min);
  r.z_max = std::max(f.z_max, g.z_max);
  r.num_votes += side.num_votes;
  r.num_points += side.num_points;
  return r;
}

}  // namespace declutter
