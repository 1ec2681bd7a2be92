#include "modules/model_verifier/model_selection.h"

#include <algorithm>

#include "modules/model_verifier/cylinder_refinement.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/shared_space.h"

namespace declutter {
namespace {

constexpr size_t kMaxObjects = 255;       // ids fit the label image
constexpr int kMaxRounds = 3;             // of exchanges
constexpr double kMinImprovement = 1.02;  // of the gain, for an exchange
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
  while (const auto best = Best(input)) Select(*best);
  for (int round = 0; round < kMaxRounds && Exchange(input); ++round) {
  }
}

void ModelSelection::AddCandidates(const std::vector<Hypothesis>& hypotheses, const Input& input) {
  if (candidates_.size() < hypotheses.size()) candidates_.resize(hypotheses.size());
  num_candidates_ = 0;
  for (const Hypothesis& hypothesis : hypotheses) {
    Candidate& candidate = candidates_[num_candidates_];
    CastRays(hypothesis.solid, input.observation, &candidate.evidence);
    if (!IsPlausible(candidate.evidence)) continue;
    candidate.hypothesis = hypothesis;
    candidate.is_refined = candidate.may_climb = false;
    candidate.is_out = candidate.is_selected = false;
    candidate.is_gain_known = false;
    candidate.num_blockers = 0;
    ++num_candidates_;
  }
  are_rivals_.assign(num_candidates_ * num_candidates_, kUnknown);
}

// True when the image speaks enough for a candidate for it to be considered at all.
bool ModelSelection::IsPlausible(const RayEvidence& evidence) const {
  const auto num_explained = static_cast<double>(evidence.num_explained());
  return num_explained >= config_.min_explained_px() &&
         evidence.num_violating + evidence.num_contradicting <=
             config_.max_violating_share() * num_explained;
}

// Gives each selected candidate's place to those that explain more when all others stay: some of
// the pixels that it was selected for, later ones explain as well, and two may fill the place of
// one better. True when one changed.
bool ModelSelection::Exchange(const Input& input) {
  bool has_changed = false;
  for (const size_t old : std::vector<size_t>(selected_)) {
    Release(old);
    const double old_gain = Gain(candidates_[old]);
    double new_gain = 0;
    std::vector<size_t> instead;
    candidates_[old].is_out = true;
    while (const auto best = Best(input)) {
      // Every further object must pay for itself, or the parts of one would replace the whole.
      new_gain += candidates_[*best].gain - (instead.empty() ? 0 : config_.min_explained_px());
      instead.push_back(*best);
      Select(*best);
    }
    candidates_[old].is_out = false;
    if (new_gain > kMinImprovement * old_gain) {
      has_changed = true;
      continue;
    }
    for (size_t i : instead) Release(i);
    Select(old);
  }
  return has_changed;
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
      if (!candidate.is_gain_known) candidate.gain = Gain(candidate);
      candidate.is_gain_known = true;
      if (!best || candidate.gain > candidates_[*best].gain) best = i;
    }
    if (!best || candidates_[*best].gain < config_.min_explained_px()) return std::nullopt;
    if (!config_.refine()) return best;
    if (!RefineRivals(candidates_[*best], input) && !Climb(*best, input)) return best;
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
    const bool has_moved =
        RefineIfNoWorse(input.observation, input.observation, &candidate.hypothesis.solid,
                        &candidate.evidence, input.buffers);
    candidate.is_refined = true;
    candidate.may_climb = !has_moved && candidate.hypothesis.solid.shape == Shape::kCylinder;
    if (has_moved) OnMoved(i);
    has_changed = true;
  }
  return has_changed;
}

// Lets a cylinder that no fit could refine climb; false when it need not.
bool ModelSelection::Climb(size_t index, const Input& input) {
  Candidate& candidate = candidates_[index];
  if (!candidate.may_climb) return false;
  candidate.may_climb = false;
  ClimbCylinder(input.observation, &candidate.hypothesis.solid, &candidate.evidence,
                &input.buffers->evidence);
  OnMoved(index);
  return true;
}

bool ModelSelection::IsFree(const Candidate& candidate) const {
  return candidate.num_blockers == 0 && !candidate.is_out && !candidate.is_selected;
}

bool ModelSelection::AreRivals(size_t a, size_t b) {
  int8_t& known = are_rivals_[a * num_candidates_ + b];
  if (known == kUnknown) {
    known = ShareSpace(candidates_[a].hypothesis.solid, candidates_[b].hypothesis.solid,
                       config_.max_shared_volume());
    are_rivals_[b * num_candidates_ + a] = known;
  }
  return known != 0;
}

// Forgets what was known of a candidate in its old place.
void ModelSelection::OnMoved(size_t index) {
  Candidate& candidate = candidates_[index];
  for (size_t i = 0; i < num_candidates_; ++i) {
    are_rivals_[index * num_candidates_ + i] = are_rivals_[i * num_candidates_ + index] = kUnknown;
  }
  candidate.is_out = !IsPlausible(candidate.evidence);
  candidate.is_gain_known = false;
  candidate.num_blockers = 0;
  for (size_t i : selected_) candidate.num_blockers += AreRivals(index, i);
}

double ModelSelection::Gain(const Candidate& candidate) const {
  const RayEvidence& evidence = candidate.evidence;
  int64_t fit_sum = 0;
  for (size_t i = 0; i < evidence.explained.size(); ++i) {
    const bool is_free = num_explaining_[static_cast<size_t>(evidence.explained[i])] == 0;
    fit_sum += is_free ? evidence.fits[i] : 0;
  }
  const double gain = static_cast<double>(evidence.pixel_weight * fit_sum) / kFitUnit;
  double penalty = config_.violation_weight() *
                   (evidence.num_violating + evidence.num_contradicting + evidence.num_overhanging);
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
