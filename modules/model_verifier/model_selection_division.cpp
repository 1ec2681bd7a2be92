#include <algorithm>
#include <cmath>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/free_space.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {

// Gives the place of a box that is seen through to one that fills a part of it and what may fill
// the rest: one patch of the height of several may have been taken for one top face. True when that
// explains more and less is seen through.
bool ModelSelection::SplitByCandidate(size_t old, const Input& input) {
  constexpr size_t kMaxTries = 4;
  constexpr double kMinSeenShare = 0.015;  // of what it explains: a larger one has longer edges
  constexpr double kMaxTopStep = 0.010;    // [m] between what may be of one patch
  constexpr double kMaxSeenShare = 0.5;    // of what is seen through it, through the parts
  const Plane& support = input.observation.support;
  const Solid& solid = candidates_[old].hypothesis.solid;
  const RayEvidence& evidence = candidates_[old].evidence;
  const double min_seen =
      std::max<double>(kMaxSeenThrough, kMinSeenShare * evidence.num_explained());
  if (solid.shape != Shape::kBox || !IsUpright(solid, support) ||
      evidence.num_violating < min_seen) {
    return false;
  }
  // Of a top alone hardly anything is deep enough inside to tell that.
  const int num_seen = solid.size.minCoeff() < kMinExtent
                           ? evidence.num_violating
                           : NumSeenThrough(solid, input.observation, &input.buffers->evidence);
  if (num_seen < min_seen) return false;
  FindPartsInside(old);
  if (inside_.size() > kMaxTries) inside_.resize(kMaxTries);
  const double top = TopOf(solid, support);
  const auto is_beside = [&](size_t i) {
    return std::abs(TopOf(candidates_[i].hypothesis.solid, support) - top) < kMaxTopStep;
  };
  for (const size_t part : inside_) {
    // Those before it may have moved it.
    const Candidate& candidate = candidates_[part];
    if (candidate.is_out || candidate.num_blockers != 1 || !AreRivals(part, old)) continue;
    const size_t num_before = num_candidates_;
    ProposeForRest(old, part, input);
    if (Replace(Only({old}), part, input)) {
      if (std::all_of(instead_.begin(), instead_.end(), is_beside) &&
          TotalSeenThrough(instead_, input) < kMaxSeenShare * num_seen) {
        return true;
      }
      PutBack(Only({old}));
    }
    num_candidates_ = num_before;
  }
  return false;
}

// Makes inside_ the candidates that fit well and only a selected one keeps out, those that explain
// most first.
void ModelSelection::FindPartsInside(size_t old) {
  constexpr double kMinFit = 0.8;    // of a pixel: noise leaves 8 / 9
  constexpr double kMaxShare = 0.9;  // of what the selected one explains
  inside_.clear();
  Release(old);
  const double max_gain = kMaxShare * Gain(&candidates_[old]);
  for (size_t i = 0; i < num_candidates_; ++i) {
    Candidate& candidate = candidates_[i];
    if (i == old || !IsFree(candidate) || !AreRivals(i, old)) continue;
    const double gain = Gain(&candidate);
    if (gain >= config_.min_explained_px() && gain <= max_gain &&
        candidate.evidence.Balance() + candidate.evidence.num_overhanging() >=
            kMinFit * candidate.evidence.num_explained()) {
      inside_.push_back(i);
    }
  }
  Select(old);
  std::stable_sort(inside_.begin(), inside_.end(), [this](size_t a, size_t b) {
    return candidates_[a].gain > candidates_[b].gain;
  });
}

// Adds solids over what a selected candidate explains and neither another selected one does nor
// `part`, which is to take a part of its place.
void ModelSelection::ProposeForRest(size_t old, size_t part, const Input& input) {
  const Observation& observation = input.observation;
  Release(old);
  Select(part);
  is_own_.assign(num_explaining_.size(), 0);
  for (const int32_t pixel : candidates_[old].evidence.explained) {
    is_own_[static_cast<size_t>(pixel)] = num_explaining_[static_cast<size_t>(pixel)] == 0;
  }
  unclaimed_ = observation.grid;
  for (const int32_t pixel : candidates_[part].evidence.explained) {
    unclaimed_.z[unclaimed_.Index(pixel)] = 0;
  }
  const Observation unclaimed = observation.At(unclaimed_);
  AddOver(is_own_, candidates_[old].evidence.window, std::nullopt, unclaimed, input);
  Release(part);
  Select(old);
}

// [px] that see through candidates.
int ModelSelection::TotalSeenThrough(const std::vector<size_t>& indices, const Input& input) {
  int num = 0;
  for (const size_t i : indices) {
    num += NumSeenThrough(candidates_[i].hypothesis.solid, input.observation,
                          &input.buffers->evidence);
  }
  return num;
}

}  // namespace declutter
