#include "modules/model_verifier/model_selection.h"

#include <algorithm>

#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/shared_space.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

constexpr size_t kMaxObjects = 255;  // ids fit the label image
constexpr int kMaxRounds = 3;        // of exchanges
constexpr size_t kMaxLate = 256;     // candidates beside the hypotheses, in one frame
constexpr int8_t kUnknown = -1;

bool Overlap(const PixelWindow& a, const PixelWindow& b) {
  return a.u_begin < b.u_end && b.u_begin < a.u_end && a.v_begin < b.v_end && b.v_begin < a.v_end;
}

}  // namespace

void ModelSelection::Run(const std::vector<Hypothesis>& hypotheses, const Observation& observation,
                         FitBuffers* buffers) {
  const Input input{observation, buffers};
  num_explaining_.assign(static_cast<size_t>(observation.grid.num_pixels()), 0);
  selected_.clear();
  AddCandidates(hypotheses, input);
  ProposeLeaning(hypotheses, input);
  SelectBest(input);
  ProposeAboveBlockers(input);
  ProposeForUnexplained(input);
  ProposeUpperParts(input);
  for (int round = 0; round < kMaxRounds && Exchange(input); ++round) {
  }
}

void ModelSelection::SelectBest(const Input& input) {
  while (const auto best = Best(input)) {
    candidates_[*best].selection_gain = candidates_[*best].gain;
    Select(*best);
  }
}

void ModelSelection::AddCandidates(const std::vector<Hypothesis>& hypotheses, const Input& input) {
  max_candidates_ = hypotheses.size() + kMaxLate;
  if (candidates_.size() < max_candidates_) candidates_.resize(max_candidates_);
  num_candidates_ = 0;
  for (const Hypothesis& hypothesis : hypotheses) {
    Candidate& candidate = candidates_[num_candidates_];
    CastRays(hypothesis.solid, input.observation, &candidate.evidence);
    if (!IsPlausible(candidate.evidence)) continue;
    candidate.Begin(hypothesis);
    ++num_candidates_;
  }
  are_rivals_.assign(max_candidates_ * max_candidates_, kUnknown);
}

// True when the image speaks enough for a candidate for it to be considered at all.
bool ModelSelection::IsPlausible(const RayEvidence& evidence) const {
  const auto num_explained = static_cast<double>(evidence.num_explained());
  return num_explained >= config_.min_explained_px() &&
         evidence.num_violating + evidence.num_contradicting <=
             config_.max_violating_share() * num_explained;
}

// A hypothesis that comes late, as a candidate; nothing when it is not plausible, or explains less
// than min_px before it is refined.
std::optional<size_t> ModelSelection::AddRefined(const Hypothesis& hypothesis, double min_px,
                                                 const Input& input) {
  return AddRefined(hypothesis, min_px, input.observation, input);
}

// The same, refined on another observation.
std::optional<size_t> ModelSelection::AddRefined(const Hypothesis& hypothesis, double min_px,
                                                 const Observation& fitted, const Input& input) {
  if (num_candidates_ == max_candidates_) return std::nullopt;
  const size_t added = num_candidates_;
  Candidate& candidate = candidates_[added];
  CastRays(hypothesis.solid, input.observation, &candidate.evidence);
  if (candidate.evidence.num_explained() < min_px) return std::nullopt;
  candidate.Begin(hypothesis);
  RefineCandidate(&candidate, fitted, input);
  if (!IsPlausible(candidate.evidence)) return std::nullopt;
  ++num_candidates_;
  OnMoved(added);
  return added;
}

void ModelSelection::RefineCandidate(Candidate* candidate, const Observation& fitted,
                                     const Input& input) const {
  Solid* const solid = &candidate->hypothesis.solid;
  RayEvidence* const evidence = &candidate->evidence;
  std::optional<double> share;
  if (config_.refine()) {
    share = RefineOrClimb(fitted, input.observation, solid, evidence, input.buffers).misfit_share;
  }
  candidate->misfit_share =
      share ? *share
            : MisfitShareOf(*solid, *evidence, input.observation, &input.buffers->explained_O);
  candidate->is_refined = true;
}

// The candidate that explains the most pixels nobody else explains; nothing when it explains too
// few. It and all that could take its place are refined.
std::optional<size_t> ModelSelection::Best(const Input& input) {
  if (selected_.size() >= kMaxObjects) return std::nullopt;
  while (true) {
    std::optional<size_t> best;
    for (size_t i = 0; i < num_candidates_; ++i) {
      Candidate& candidate = candidates_[i];
      if (!IsFree(candidate)) continue;
      if (!best || Gain(&candidate) > Gain(&candidates_[*best])) best = i;
    }
    if (!best || Gain(&candidates_[*best]) < config_.min_explained_px()) return std::nullopt;
    if (!config_.refine() || !RefineRivals(candidates_[*best], input)) return best;
  }
}

// Refines the best candidate and those that could take its place; false when all were.
bool ModelSelection::RefineRivals(const Candidate& best, const Input& input) {
  constexpr double kMinGainOfRival = 0.7;  // of the best candidate's
  const Solid space = best.hypothesis.solid;
  const double min_gain = kMinGainOfRival * best.gain;
  bool has_changed = false;
  for (size_t i = 0; i < num_candidates_; ++i) {
    Candidate& candidate = candidates_[i];
    if (candidate.is_refined || !IsFree(candidate) || candidate.gain < min_gain ||
        !ShareSpace(candidate.hypothesis.solid, space, config_.max_shared_volume())) {
      continue;
    }
    RefineCandidate(&candidate, input.observation, input);
    OnMoved(i);
    has_changed = true;
  }
  return has_changed;
}

bool ModelSelection::IsFree(const Candidate& candidate) const {
  return candidate.num_blockers == 0 && !candidate.is_out && !candidate.is_selected;
}

bool ModelSelection::AreRivals(size_t a, size_t b) {
  int8_t& known = are_rivals_[a * max_candidates_ + b];
  if (known == kUnknown) {
    known = ShareSpace(candidates_[a].hypothesis.solid, candidates_[b].hypothesis.solid,
                       config_.max_shared_volume());
    are_rivals_[b * max_candidates_ + a] = known;
  }
  return known != 0;
}

// Forgets what was known of a candidate in its old place.
void ModelSelection::OnMoved(size_t index) {
  Candidate& candidate = candidates_[index];
  for (size_t i = 0; i < num_candidates_; ++i) {
    are_rivals_[index * max_candidates_ + i] = are_rivals_[i * max_candidates_ + index] = kUnknown;
  }
  candidate.is_out = !IsPlausible(candidate.evidence);
  candidate.is_gain_known = false;
  candidate.num_blockers = 0;
  for (size_t i : selected_) candidate.num_blockers += AreRivals(index, i);
}

// Counted again only where others have come or gone.
double ModelSelection::Gain(Candidate* candidate) const {
  if (!candidate->is_gain_known) candidate->gain = CountGain(*candidate);
  candidate->is_gain_known = true;
  return candidate->gain;
}

// [px] that speak for a solid and are explained by no selected one.
double ModelSelection::UnsharedFit(const RayEvidence& evidence) const {
  return FitAlone(evidence, num_explaining_, 0);
}

double ModelSelection::CountGain(const Candidate& candidate) const {
  const RayEvidence& evidence = candidate.evidence;
  const double gain = UnsharedFit(evidence);
  double penalty =
      config_.violation_weight() * (evidence.num_violating + evidence.num_contradicting +
                                    NumOverhangingAlone(evidence, num_explaining_)) +
      candidate.misfit_share * gain;
  for (Evidence extent : candidate.hypothesis.evidence) {
    if (extent == Evidence::kAssumed) penalty += config_.assumption_penalty() * gain;
  }
  return gain - penalty;
}

void ModelSelection::Select(size_t index) {
  selected_.push_back(index);
  candidates_[index].is_selected = true;
  Mark(index, 1);
}

void ModelSelection::Release(size_t index) {
  selected_.erase(std::find(selected_.begin(), selected_.end(), index));
  candidates_[index].is_selected = false;
  Mark(index, -1);
}

// Counts a selected or released candidate in, or out, where others explain or fill the same.
void ModelSelection::Mark(size_t index, int change) {
  const Candidate& selected = candidates_[index];
  for (int32_t pixel : selected.evidence.explained) {
    uint8_t& num = num_explaining_[static_cast<size_t>(pixel)];
    num = static_cast<uint8_t>(num + change);
  }
  for (size_t i = 0; i < num_candidates_; ++i) {
    Candidate& candidate = candidates_[i];
    if (Overlap(candidate.evidence.window, selected.evidence.window)) {
      candidate.is_gain_known = false;
    }
    if (i == index || candidate.is_selected) continue;
    candidate.num_blockers += change * static_cast<int>(AreRivals(i, index));
  }
}

}  // namespace declutter
