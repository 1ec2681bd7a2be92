#include "modules/hough_segmenter/parameter_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

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

// Votes whose keys differ by more than this are not near.
float KeyOf(const LineModel& line) { return std::atan2(line.n.y(), line.n.x()); }
float KeyOf(const CircleModel& circle) { return circle.c.x(); }
float MaxKeyDifference(const LineModel&) { return kMaxAngle; }
float MaxKeyDifference(const CircleModel&) { return kMaxDistance; }
float PeriodOf(const LineModel&) { return static_cast<float>(2 * M_PI); }
float PeriodOf(const CircleModel&) { return std::numeric_limits<float>::infinity(); }

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
void ParameterSpace<Model>::Add(const Fit<Model>& fit) {
  Vote& vote = votes_.Add();
  vote.fit = fit;
  vote.key = KeyOf(fit.model);
  vote.num_open = fit.num_points;
  vote.is_left = true;
}

template <typename Model>
void ParameterSpace<Model>::Connect() {
  order_.resize(votes_.size());
  std::iota(order_.begin(), order_.end(), size_t{0});
  std::sort(order_.begin(), order_.end(), [this](size_t i, size_t j) {
    return std::pair(votes_[i].key, i) < std::pair(votes_[j].key, j);
  });
  pairs_.clear();
  for (size_t i : order_) votes_[i].num_neighbours = 0;
  for (size_t k = 0; k < votes_.size(); ++k) {
    // Those next in order, around the circle for angles.
    for (size_t step = 0; step < votes_.size(); ++step) {
      const size_t i = order_[k];
      const size_t j = order_[(k + step) % votes_.size()];
      const float turn = k + step < votes_.size() ? 0 : PeriodOf(votes_[i].fit.model);
      if (votes_[j].key + turn - votes_[i].key > MaxKeyDifference(votes_[i].fit.model)) break;
      if (i != j && !IsNear(votes_[i].fit.model, votes_[j].fit.model)) continue;
      pairs_.emplace_back(i, j);
      ++votes_[i].num_neighbours;
      if (i != j) ++votes_[j].num_neighbours;
    }
  }
  size_t sum = 0;
  for (size_t i = 0; i < votes_.size(); ++i) {
    votes_[i].first_neighbour = sum;
    sum += votes_[i].num_neighbours;
    votes_[i].num_neighbours = 0;
    votes_[i].density = 0;
  }
  neighbours_.resize(sum);
  const auto connect = [this](size_t i, size_t j) {
    neighbours_[votes_[i].first_neighbour + votes_[i].num_neighbours++] = j;
    votes_[i].density += votes_[j].fit.support;
  };
  for (const auto& [i, j] : pairs_) {
    connect(i, j);
    if (i != j) connect(j, i);
  }
}

template <typename Model>
template <typename Visit>
void ParameterSpace<Model>::ForEachLeftNear(size_t vote, Visit visit) const {
  const size_t begin = votes_[vote].first_neighbour;
  for (size_t k = begin; k < begin + votes_[vote].num_neighbours; ++k) {
    if (votes_[neighbours_[k]].is_left) visit(neighbours_[k]);
  }
}

template <typename Model>
std::optional<typename ParameterSpace<Model>::Peak> ParameterSpace<Model>::HighestPeak() const {
  std::optional<size_t> best;
  for (size_t i = 0; i < votes_.size(); ++i) {
    if (votes_[i].is_left && (!best || votes_[i].density > votes_[*best].density)) best = i;
  }
  if (!best) return std::nullopt;
  Peak peak;
  peak.strongest = *best;
  peak.model = ZeroSum(votes_[*best].fit.model);
  ForEachLeftNear(*best, [&](size_t i) {
    const Fit<Model>& fit = votes_[i].fit;
    AddTo(&peak.model, fit.model, fit.support);
    peak.density += fit.support;
    ++peak.num_votes;
  });
  Normalise(&peak.model, peak.density);
  return peak;
}

template <typename Model>
void ParameterSpace<Model>::Forget(size_t vote) {
  ForEachLeftNear(vote, [&](size_t i) { votes_[i].density -= votes_[vote].fit.support; });
  votes_[vote].is_left = false;
}

template <typename Model>
void ParameterSpace<Model>::Remove(const Peak& peak) {
  ForEachLeftNear(peak.strongest, [this](size_t i) { Forget(i); });
}

template <typename Model>
void ParameterSpace<Model>::Explain(const std::vector<SideCell>& cells, const CellSet& explained) {
  for (size_t i = 0; i < votes_.size(); ++i) {
    Vote& vote = votes_[i];
    if (!vote.is_left) continue;
    vote.fit.inliers.ForEachIn(explained, [&](size_t c) { vote.num_open -= cells[c].weight; });
    if (vote.num_open < 0.5f * vote.fit.num_points) Forget(i);
  }
}

template class ParameterSpace<LineModel>;
template class ParameterSpace<CircleModel>;

}  // namespace declutter
