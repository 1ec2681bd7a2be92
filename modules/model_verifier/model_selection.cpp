#include "modules/model_verifier/model_selection.h"

#include <algorithm>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/box_splitting.h"
#include "modules/model_verifier/late_proposals.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/shared_space.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

constexpr size_t kMaxObjects = 255;       // ids fit the label image
constexpr int kMaxRounds = 3;             // of exchanges
constexpr double kMinImprovement = 1.02;  // of the gain, for an exchange
constexpr size_t kMaxLate = 64;           // candidates beside the hypotheses, in one frame
constexpr int8_t kUnknown = -1;

double MisfitShareOf(const Candidate& candidate, const Observation& observation,
                     std::vector<Eigen::Vector3d>* points_O) {
  const Solid& solid = candidate.hypothesis.solid;
  FindExplainedPoints(solid, candidate.evidence, observation, points_O);
  return MisfitShare(SystematicMisfit(solid, *points_O) /
                     MeasurementSigma(solid.X_CO.translation().z()));
}

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
  SelectBest(input);
  ProposeAboveBlockers(input);
  ProposeForUnexplained(input);
  for (int round = 0; round < kMaxRounds && Exchange(input); ++round) {
  }
}

void ModelSelection::SelectBest(const Input& input) {
  while (const auto best = Best(input)) {
    candidates_[*best].selection_gain = candidates_[*best].gain;
    Select(*best);
  }
}

// Tries candidates that reach down into selected ones as what stands on those: a side that goes on
// below may have been taken for theirs.
void ModelSelection::ProposeAboveBlockers(const Input& input) {
  constexpr double kMinHeight = 0.015;  // [m] that can be grasped
  const Plane& support = input.observation.support;
  const auto stands = [&](const Solid& solid) {
    return solid.X_CO.linear().col(2).dot(support.normal) > 0.99;
  };
  const size_t num = num_candidates_;
  for (size_t i = 0; i < num; ++i) {
    const Candidate& candidate = candidates_[i];
    if (candidate.is_out || candidate.is_selected || candidate.num_blockers == 0 ||
        !stands(candidate.hypothesis.solid)) {
      continue;
    }
    const double top = TopOf(candidate.hypothesis.solid, support);
    double floor = top - candidate.hypothesis.solid.height();
    const double bottom = floor;
    double rivals_gain = 0;
    for (const size_t blocker : BlockersOf(i)) {
      const Solid& solid = candidates_[blocker].hypothesis.solid;
      const double top_below = TopOf(solid, support);
      if (stands(solid) && top_below < top - kMinHeight) {
        floor = std::max(floor, top_below);
      } else {
        rivals_gain += candidates_[blocker].selection_gain;
      }
    }
    if (floor == bottom ||
        candidate.evidence.Balance() < std::max(config_.min_explained_px(), rivals_gain)) {
      continue;
    }
    Hypothesis upper = candidate.hypothesis;
    upper.solid.X_CO = upper.solid.X_CO * Eigen::Translation3d(0, 0, 0.5 * (floor - bottom));
    upper.solid.size.z() = top - floor;
    AddRefined(upper, config_.min_explained_px(), input);
  }
  SelectBest(input);
}

// Tries solids over what no selected one explains. Nothing voted for them, so that they must
// explain most of what they were laid over, as well as noise allows, and little of what others do.
void ModelSelection::ProposeForUnexplained(const Input& input) {
  constexpr double kMinShare =
      0.5;  // of the points it was laid over that a solid explains, before and after it is refined
  constexpr double kMinFit = 0.8;       // of a pixel: noise leaves 8 / 9
  constexpr double kMinUnshared = 0.6;  // of what speaks for it, from pixels of its own
  std::vector<Solid> selected;
  std::vector<uint8_t> is_explained = num_explaining_;
  for (const size_t i : selected_) {
    const Hypothesis& hypothesis = candidates_[i].hypothesis;
    selected.push_back(hypothesis.solid);
    if (hypothesis.evidence[2] != Evidence::kAssumed) continue;
    // What is below may be its own lower part.
    const Solid longer = ExtendedToSupport(hypothesis.solid, input.observation.support);
    for (const int32_t pixel : CastRays(longer, input.observation).explained) {
      is_explained[static_cast<size_t>(pixel)] = 1;
    }
  }
  for (const LateProposal& proposal : declutter::ProposeForUnexplained(
           selected, is_explained, config_.min_explained_px(), input.observation)) {
    const auto added = AddRefined(proposal.hypothesis, kMinShare * proposal.num_px, input);
    if (!added) continue;
    Candidate& candidate = candidates_[*added];
    const RayEvidence& evidence = candidate.evidence;
    if (Gain(&candidate) < kMinShare * proposal.num_px ||
        evidence.Fit() < kMinFit * evidence.num_explained() ||
        UnsharedFit(evidence) < kMinUnshared * evidence.Fit()) {
      --num_candidates_;
    }
  }
  SelectBest(input);
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

// Gives the place of selected candidates to those that explain more when all others stay: some of
// the pixels that they were selected for, later ones explain as well, two may fill the place of one
// better, and one that explains much may be kept out by some that explain little. True when one
// changed.
bool ModelSelection::Exchange(const Input& input) {
  bool has_changed = false;
  for (const size_t old : std::vector<size_t>(selected_)) {
    has_changed |= candidates_[old].is_selected && Replace({old}, std::nullopt, input);
  }
  for (size_t i = 0; i < num_candidates_; ++i) {
    if (IsWorthTrying(i)) has_changed |= Replace(BlockersOf(i), i, input);
  }
  for (const size_t old : std::vector<size_t>(selected_)) {
    has_changed |= candidates_[old].is_selected && (Split(old, input) || CutLower(old, input));
  }
  return has_changed;
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

std::vector<size_t> ModelSelection::BlockersOf(size_t index) {
  std::vector<size_t> blockers;
  for (const size_t i : selected_) {
    if (AreRivals(index, i)) blockers.push_back(i);
  }
  return blockers;
}

// Gives the place of selected candidates to others, beginning with `first`; takes that back and
// returns false unless they explain more than a share of what those did.
bool ModelSelection::Replace(const std::vector<size_t>& old, std::optional<size_t> first,
                             const Input& input, double share_of_old) {
  double old_gain = 0;
  for (const size_t i : old) {
    Release(i);
    old_gain += Gain(&candidates_[i]);
    candidates_[i].is_out = true;
  }
  double new_gain = 0;
  std::vector<size_t> instead;
  for (auto next = first ? first : Best(input); next; next = Best(input)) {
    candidates_[*next].selection_gain = Gain(&candidates_[*next]);
    new_gain += candidates_[*next].selection_gain;
    // Every further object must pay for itself, or the parts of one would replace the whole.
    if (instead.size() >= old.size()) new_gain -= config_.min_explained_px();
    instead.push_back(*next);
    Select(*next);
  }
  for (const size_t i : old) candidates_[i].is_out = false;
  if (new_gain > kMinImprovement * share_of_old * old_gain) return true;
  for (const size_t i : instead) Release(i);
  for (const size_t i : old) Select(i);
  return false;
}

// Gives the place of a box with much free space inside to two side by side: one patch of the height
// of both may have been taken for one top face. True when that explains more.
bool ModelSelection::Split(size_t old, const Input& input) {
  constexpr double kMaxFreeShare = 0.05;  // of the explained pixels: beyond what noise makes
  constexpr int kMaxFree = 60;            // [px] that edges leave
  const Solid& solid = candidates_[old].hypothesis.solid;
  const RayEvidence& evidence = candidates_[old].evidence;
  const int num_free = evidence.num_violating + evidence.num_contradicting;
  if (solid.shape != Shape::kBox || num_free < kMaxFree ||
      num_free < kMaxFreeShare * evidence.num_explained()) {
    return false;
  }
  std::vector<Eigen::Vector3d>& points_O = input.buffers->explained_O;
  FindExplainedPoints(solid, evidence, input.observation, &points_O);
  const auto parts = SplitBox(solid, points_O);
  return parts && ReplaceByParts({(*parts)[0], (*parts)[1]}, old, 1, input);
}

// Gives the place of a cylinder whose radius changes on its way down to its upper part: it may
// stand on another that continues its side. True when that explains more.
bool ModelSelection::CutLower(size_t old, const Input& input) {
  constexpr double kMaxMisfit = 0.6;  // [sigma]
  const Solid& solid = candidates_[old].hypothesis.solid;
  if (solid.shape != Shape::kCylinder) return false;
  std::vector<Eigen::Vector3d>& points_O = input.buffers->explained_O;
  FindExplainedPoints(solid, candidates_[old].evidence, input.observation, &points_O);
  const double misfit =
      LayerMisfit(solid, points_O) / MeasurementSigma(solid.X_CO.translation().z());
  if (misfit < kMaxMisfit) return false;
  const auto step = StepOf(solid, points_O);
  if (!step) return false;
  Solid upper = solid;
  upper.size.z() = 0.5 * solid.height() - *step;
  upper.X_CO = solid.X_CO * Eigen::Translation3d(0, 0, 0.5 * (0.5 * solid.height() + *step));
  return ReplaceByParts({upper}, old, 1 - MisfitShare(misfit), input);
}

// Proposes parts of a selected candidate in its place, of whose gain only a share counts.
bool ModelSelection::ReplaceByParts(const std::vector<Solid>& parts, size_t old,
                                    double share_of_old, const Input& input) {
  Hypothesis hypothesis = candidates_[old].hypothesis;
  std::optional<size_t> first;
  for (const Solid& part : parts) {
    hypothesis.solid = part;
    if (part.shape == Shape::kCylinder) hypothesis.evidence[2] = Evidence::kAssumed;
    const auto added = AddRefined(hypothesis, 0, input);
    if (added && (!first || Gain(&candidates_[*added]) > Gain(&candidates_[*first]))) first = added;
  }
  return first && candidates_[*first].num_blockers <= 1 &&
         Replace({old}, first, input, share_of_old);
}

// A hypothesis that comes late, as a candidate; nothing when it is not plausible, or explains less
// than min_px before it is refined.
std::optional<size_t> ModelSelection::AddRefined(const Hypothesis& hypothesis, double min_px,
                                                 const Input& input) {
  if (num_candidates_ == max_candidates_) return std::nullopt;
  const size_t added = num_candidates_;
  Candidate& candidate = candidates_[added];
  CastRays(hypothesis.solid, input.observation, &candidate.evidence);
  if (candidate.evidence.num_explained() < min_px) return std::nullopt;
  candidate.Begin(hypothesis);
  if (config_.refine()) {
    RefineOrClimb(input.observation, input.observation, &candidate.hypothesis.solid,
                  &candidate.evidence, input.buffers);
  }
  if (!IsPlausible(candidate.evidence)) return std::nullopt;
  candidate.is_refined = true;
  candidate.misfit_share = MisfitShareOf(candidate, input.observation, &input.buffers->explained_O);
  ++num_candidates_;
  OnMoved(added);
  return added;
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
    RefineOrClimb(input.observation, input.observation, &candidate.hypothesis.solid,
                  &candidate.evidence, input.buffers);
    candidate.is_refined = true;
    candidate.misfit_share =
        MisfitShareOf(candidate, input.observation, &input.buffers->explained_O);
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
  int64_t fit_sum = 0;
  for (size_t i = 0; i < evidence.explained.size(); ++i) {
    const bool is_free = num_explaining_[static_cast<size_t>(evidence.explained[i])] == 0;
    fit_sum += is_free ? evidence.fits[i] : 0;
  }
  return static_cast<double>(evidence.pixel_weight * fit_sum) / kFitUnit;
}

double ModelSelection::CountGain(const Candidate& candidate) const {
  const RayEvidence& evidence = candidate.evidence;
  const double gain = UnsharedFit(evidence);
  double penalty =
      config_.violation_weight() *
          (evidence.num_violating + evidence.num_contradicting + evidence.num_overhanging) +
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
