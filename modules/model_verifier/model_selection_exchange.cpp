#include <algorithm>

#include "modules/geometry/plane.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {

// Gives the place of selected candidates to those that explain more when all others stay: some of
// the pixels that they were selected for, later ones explain as well, two may fill the place of one
// better, or one that of two, and one that explains much may be kept out by some that explain
// little. True when one changed.
bool ModelSelection::Exchange(const Input& input) {
  bool has_changed = false;
  order_ = selected_;
  for (const size_t old : order_) {
    has_changed |= candidates_[old].is_selected && Replace(Only({old}), std::nullopt, input);
  }
  for (size_t i = 0; i < num_candidates_; ++i) {
    has_changed |= TryInPlaceOfBlockers(i, input);
  }
  order_ = selected_;
  for (const size_t old : order_) {
    has_changed |=
        candidates_[old].is_selected &&
        (SplitByArea(old, input) || SplitByCandidate(old, input) || CutLower(old, input) ||
         Reshape(old, input) || Unite(old, input) || JoinColumn(old, input));
  }
  return has_changed;
}

// Gives the place of those that keep a candidate out to it, where that is worth trying. True when
// it explains more, alone or with what it leaves of them.
bool ModelSelection::TryInPlaceOfBlockers(size_t index, const Input& input) {
  if (!IsWorthTrying(index)) return false;
  Candidate& candidate = candidates_[index];
  if (!candidate.is_refined && config_.refine()) {
    RefineCandidate(&candidate, input.observation, input);
    OnMoved(index);
    if (candidate.is_out) return false;
  }
  return Replace(BlockersOf(index), index, input) || ReplaceWithRest(index, input);
}

// True for a candidate that explains what nobody else does, or about as much as all those together
// that keep it out.
bool ModelSelection::IsWorthTrying(size_t index) {
  constexpr double kMinShare = 0.5;
  Candidate& candidate = candidates_[index];
  if (candidate.is_out || candidate.is_selected || candidate.num_blockers == 0) return false;
  if (Gain(&candidate) >= config_.min_explained_px()) return true;
  if (candidate.num_blockers == 1) return false;
  double gain = 0;
  for (const size_t i : BlockersOf(index)) gain += candidates_[i].selection_gain;
  return candidate.evidence.Balance() > kMinShare * gain;
}

// Gives the place of those that keep a candidate out to it and to what it leaves of them: their
// parts above its top, and solids laid over the rest. Only where much of what speaks for it is
// explained by nobody: of a carton that bulges, a little is. True when they explain more.
bool ModelSelection::ReplaceWithRest(size_t index, const Input& input) {
  constexpr double kMinNew = 0.2;  // of what speaks for it
  const Plane& support = input.observation.support;
  Candidate& candidate = candidates_[index];
  if (Gain(&candidate) <
      std::max(config_.min_explained_px(), kMinNew * candidate.evidence.Balance())) {
    return false;
  }
  const Solid& solid = candidate.hypothesis.solid;
  const double top = TopOf(solid, support);
  const auto reaches_through_top = [&](const Solid& other) {
    return IsUpright(solid, support) && IsUpright(other, support) &&
           ReachesThrough(other, top, support);
  };
  const size_t num_before = num_candidates_;
  const std::vector<size_t>& blockers = BlockersOf(index);
  for (const size_t i : blockers) {
    const Solid& blocker = candidates_[i].hypothesis.solid;
    if (!reaches_through_top(blocker)) {
      ProposeForRest(i, index, input);
    } else if (!IsOneColumn(candidate, blocker, input)) {
      AddUpperPart(i, top, input);
    }
  }
  if (num_candidates_ > num_before && Replace(blockers, index, input)) return true;
  num_candidates_ = num_before;
  return false;
}

const std::vector<size_t>& ModelSelection::BlockersOf(size_t index) {
  blockers_.clear();
  for (const size_t i : selected_) {
    if (AreRivals(index, i)) blockers_.push_back(i);
  }
  return blockers_;
}

const std::vector<size_t>& ModelSelection::Only(std::initializer_list<size_t> indices) {
  only_ = indices;
  return only_;
}

// Gives the place of selected candidates to others, beginning with `first`; takes that back and
// returns false unless they explain more than a share of what those did.
bool ModelSelection::Replace(const std::vector<size_t>& old, std::optional<size_t> first,
                             const Input& input, double share_of_old) {
  double old_gain = 0;
  for (const size_t i : old) {
    Release(i);
    old_gain += candidates_[i].gain_factor * Gain(&candidates_[i]);
    candidates_[i].is_out = true;
  }
  double new_gain = 0;
  instead_.clear();
  for (auto next = first ? first : Best(input); next; next = Best(input)) {
    candidates_[*next].selection_gain = Gain(&candidates_[*next]);
    new_gain += candidates_[*next].selection_gain;
    // Every further object must pay for itself, or the parts of one would replace the whole.
    if (instead_.size() >= old.size()) new_gain -= config_.min_explained_px();
    instead_.push_back(*next);
    Select(*next);
  }
  for (const size_t i : old) candidates_[i].is_out = false;
  if (new_gain > kMinImprovement * share_of_old * old_gain) return true;
  PutBack(old);
  return false;
}

// Takes the last replacement back.
void ModelSelection::PutBack(const std::vector<size_t>& old) {
  for (const size_t i : instead_) Release(i);
  for (const size_t i : old) Select(i);
}

}  // namespace declutter
