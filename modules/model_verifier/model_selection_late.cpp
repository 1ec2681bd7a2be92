#include <algorithm>
#include <cmath>

#include "modules/model_verifier/column.h"
#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {

// Adds boxes that lean.
void ModelSelection::ProposeLeaning(const std::vector<Hypothesis>& hypotheses, const Input& input) {
  constexpr double kMinShareBefore = 0.7;  // of the points it was laid over, before it is refined
  selected_solids_.clear();
  for (const Hypothesis& hypothesis : hypotheses) selected_solids_.push_back(hypothesis.solid);
  for (const LateProposal& proposal :
       late_proposer_.ProposeLeaning(selected_solids_, input.observation)) {
    AddProposal(proposal, kMinShareBefore, input);
  }
}

// Adds what nothing voted for, so that it must explain most of what it was laid over, as well as
// noise allows, and little of what others do.
void ModelSelection::AddProposal(const LateProposal& proposal, double min_share_before,
                                 const Input& input) {
  constexpr double kMinShare = 0.7;     // of the points it was laid over that a solid explains
  constexpr double kMinFit = 0.8;       // of a pixel: noise leaves 8 / 9
  constexpr double kMinUnshared = 0.8;  // of what speaks for it, from pixels of its own
  const auto added = AddRefined(proposal.hypothesis, min_share_before * proposal.num_px, input);
  if (!added) return;
  Candidate& candidate = candidates_[*added];
  const RayEvidence& evidence = candidate.evidence;
  if (Gain(&candidate) < kMinShare * proposal.num_px ||
      evidence.Fit() < kMinFit * evidence.num_explained() ||
      UnsharedFit(evidence) < kMinUnshared * evidence.Fit()) {
    --num_candidates_;
  }
}

// Tries candidates that reach down into selected ones as what stands on those: a side that goes on
// below may have been taken for theirs.
void ModelSelection::ProposeAboveBlockers(const Input& input) {
  const Plane& support = input.observation.support;
  const size_t num = num_candidates_;
  for (size_t i = 0; i < num; ++i) {
    const Candidate& candidate = candidates_[i];
    if (candidate.is_out || candidate.is_selected || candidate.num_blockers == 0 ||
        !IsUpright(candidate.hypothesis.solid, support)) {
      continue;
    }
    const double top = TopOf(candidate.hypothesis.solid, support);
    double floor = top - candidate.hypothesis.solid.height();
    const double bottom = floor;
    double rivals_gain = 0;
    for (const size_t blocker : BlockersOf(i)) {
      const Solid& solid = candidates_[blocker].hypothesis.solid;
      const double top_below = TopOf(solid, support);
      if (IsUpright(solid, support) && top_below < top - kMinExtent) {
        floor = std::max(floor, top_below);
      } else {
        rivals_gain += candidates_[blocker].selection_gain;
      }
    }
    if (floor == bottom ||
        candidate.evidence.Balance() < std::max(config_.min_explained_px(), rivals_gain)) {
      continue;
    }
    AddUpperPart(i, floor, input);
  }
  SelectBest(input);
}

// Adds the parts of selected candidates above others that they keep out: what stands on something
// may have been taken to reach down through it. Exchanges decide between one and both.
void ModelSelection::ProposeUpperParts(const Input& input) {
  const Plane& support = input.observation.support;
  for (const size_t upper : selected_) {
    const Solid& solid = candidates_[upper].hypothesis.solid;
    if (!IsUpright(solid, support)) continue;
    const double top = TopOf(solid, support);
    std::optional<size_t> best;
    for (size_t i = 0; i < num_candidates_; ++i) {
      Candidate& candidate = candidates_[i];
      if (candidate.is_out || candidate.is_selected || candidate.num_blockers != 1 ||
          !AreRivals(i, upper) || !IsUpright(candidate.hypothesis.solid, support)) {
        continue;
      }
      const double floor = TopOf(candidate.hypothesis.solid, support);
      if (!ReachesThrough(solid, floor, support) || Gain(&candidate) <= 0) continue;
      if (!best || Gain(&candidate) > Gain(&candidates_[*best])) best = i;
    }
    if (!best) continue;
    const auto lower =
        AddRefined(Hypothesis(candidates_[*best].hypothesis), config_.min_explained_px(), input);
    if (!lower) continue;
    const double floor = TopOf(candidates_[*lower].hypothesis.solid, support);
    if (floor > top - kMinExtent || IsOneColumn(candidates_[*lower], solid, input)) {
      --num_candidates_;
    } else {
      AddUpperPart(upper, floor, input);
    }
  }
}

// True when an upright solid looks like the upper part of a candidate that was put below it.
bool ModelSelection::IsOneColumn(const Candidate& lower, const Solid& upper, const Input& input) {
  const Solid& solid = lower.hypothesis.solid;
  if (HaveOneCrossSection(solid, upper)) return true;
  if (!AreFlush(solid, upper)) return false;
  std::vector<Eigen::Vector3d>& points_O = input.buffers->explained_O;
  FindExplainedPoints(solid, lower.evidence, input.observation, &points_O);
  return !IsTopSeen(solid, points_O, lower.evidence.pixel_weight);
}

// The part of an upright candidate above a floor [m] over the support plane, as another candidate.
void ModelSelection::AddUpperPart(size_t index, double floor, const Input& input) {
  Hypothesis upper = candidates_[index].hypothesis;
  upper.solid =
      Longer(upper.solid, 2, -1, BottomOf(upper.solid, input.observation.support) - floor);
  AddRefined(upper, config_.min_explained_px(), input);
}

// Tries solids over what no selected one explains.
void ModelSelection::ProposeForUnexplained(const Input& input) {
  constexpr double kMinShareBefore = 0.5;  // of the points it was laid over, before it is refined
  selected_solids_.clear();
  is_explained_ = num_explaining_;
  for (const size_t i : selected_) {
    const Hypothesis& hypothesis = candidates_[i].hypothesis;
    selected_solids_.push_back(hypothesis.solid);
    if (hypothesis.evidence[2] != Evidence::kAssumed) continue;
    // What is below may be its own lower part.
    const Solid longer = ExtendedToSupport(hypothesis.solid, input.observation.support);
    RayEvidence& evidence = input.buffers->evidence;
    CastRays(longer, input.observation, &evidence);
    for (const int32_t pixel : evidence.explained) {
      is_explained_[static_cast<size_t>(pixel)] = 1;
    }
  }
  for (const LateProposal& proposal : late_proposer_.ProposeForUnexplained(
           selected_solids_, is_explained_, config_.min_explained_px(), input.observation)) {
    AddProposal(proposal, kMinShareBefore, input);
  }
  SelectBest(input);
}

}  // namespace declutter
