#include "modules/hough_segmenter/parameter_space.h"

#include <algorithm>
#include <cmath>

namespace declutter {
namespace {

constexpr float kMaxAngle = 0.10f;     // [rad] between lines of one peak
constexpr float kMaxDistance = 0.01f;  // [m] between lines or circles of one peak

bool IsNear(const LineModel& a, const LineModel& b) {
  const float s = std::clamp(b.tangent().dot(a.PointAt(0.5f * (a.s_min + a.s_max))),
                             b.s_min - 0.02f, b.s_max + 0.02f);
  return a.n.dot(b.n) > std::cos(kMaxAngle) &&
         std::abs(a.n.dot(b.PointAt(s)) - a.rho) < kMaxDistance &&
         std::min(a.s_max, a.tangent().dot(b.PointAt(b.s_max))) >
             std::max(a.s_min, a.tangent().dot(b.PointAt(b.s_min)));
}

bool IsNear(const CircleModel& a, const CircleModel& b) {
  return (a.c - b.c).norm() < kMaxDistance && std::abs(a.r - b.r) < kMaxDistance &&
         std::min(a.z_max, b.z_max) >= std::max(a.z_min, b.z_min);
}

// Adds weight * model to a sum that Normalise turns into the mean.
void AddTo(LineModel* sum, const LineModel& m, float weight) {
  sum->n += weight * m.n;
  sum->rho += weight * m.rho;
  sum->s_min += weight * m.s_min;
  sum->s_max += weight * m.s_max;
}

void AddTo(CircleModel* sum, const CircleModel& m, float weight) {
  sum->c += weight * m.c;
  sum->r += weight * m.r;
}

void Normalise(LineModel* sum, float weight) {
  sum->n.normalize();
  sum->rho /= weight;
  sum->s_min /= weight;
  sum->s_max /= weight;
}

void Normalise(CircleModel* sum, float weight) {
  sum->c /= weight;
  sum->r /= weight;
}

LineModel ZeroSum(const LineModel& model) {
  LineModel sum = model;
  sum.n.setZero();
  sum.rho = sum.s_min = sum.s_max = 0;
  return sum;
}

CircleModel ZeroSum(const CircleModel& model) {
  CircleModel sum = model;
  sum.c.setZero();
  sum.r = 0;
  return sum;
}

}  // namespace

template <typename Model>
std::optional<typename ParameterSpace<Model>::Peak> ParameterSpace<Model>::HighestPeak() const {
  const Fit<Model>* best = nullptr;
  float best_density = 0;
  for (const Fit<Model>& vote : votes_) {
    float density = 0;
    for (const Fit<Model>& other : votes_) {
      if (IsNear(vote.model, other.model)) density += other.support;
    }
    if (density > best_density) {
      best_density = density;
      best = &vote;
    }
  }
  if (best == nullptr) return std::nullopt;
  Peak peak;
  peak.strongest = best->model;
  peak.model = ZeroSum(best->model);
  for (const Fit<Model>& vote : votes_) {
    if (!IsNear(best->model, vote.model)) continue;
    AddTo(&peak.model, vote.model, vote.support);
    peak.density += vote.support;
    ++peak.num_votes;
  }
  Normalise(&peak.model, peak.density);
  return peak;
}

template <typename Model>
void ParameterSpace<Model>::Remove(const Model& model) {
  votes_.erase(std::remove_if(votes_.begin(), votes_.end(),
                              [&](const auto& vote) { return IsNear(model, vote.model); }),
               votes_.end());
}

template <typename Model>
void ParameterSpace<Model>::KeepSupported(const std::vector<SideCell>& cells,
                                          const std::vector<char>& is_free) {
  const auto is_lost = [&](const Fit<Model>& vote) {
    float free_points = 0;
    for (int i : vote.inliers) {
      if (is_free[static_cast<size_t>(i)]) free_points += cells[static_cast<size_t>(i)].weight;
    }
    return free_points < 0.5f * vote.num_points;
  };
  votes_.erase(std::remove_if(votes_.begin(), votes_.end(), is_lost), votes_.end());
}

template class ParameterSpace<LineModel>;
template class ParameterSpace<CircleModel>;

}  // namespace declutter
