#include <algorithm>
#include <cmath>

#include "modules/model_verifier/column.h"
#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/free_space.h"
#include "modules/model_verifier/hidden_middle.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"

namespace declutter {
namespace {

constexpr double kMinShareOfBoth = 0.8;  // of what two explain, by one in their place

}  // namespace

// A solid that reaches from the far end of one to that of a candidate of its shape.
std::optional<Solid> ModelSelection::Through(const Solid& solid, const Candidate& candidate,
                                             const Input& input) {
  if (solid.shape == Shape::kCylinder) return CylinderThrough(solid, candidate.hypothesis.solid);
  std::vector<Eigen::Vector3d>& points_O = input.buffers->explained_O;
  FindExplainedPoints(solid, candidate.evidence, input.observation, &points_O);
  return ProlongedOver(points_O, solid);
}

// Adds one in place of two selected candidates. Nothing when others than those keep it out, or when
// of free space it takes more than both do, by a share of what the second one explains.
std::optional<size_t> ModelSelection::AddForBoth(size_t first, size_t second,
                                                 const Hypothesis& whole, double max_new_violating,
                                                 const Input& input) {
  const RayEvidence& a = candidates_[first].evidence;
  const RayEvidence& b = candidates_[second].evidence;
  const auto added = AddRefined(whole, 0, input);
  if (!added || candidates_[*added].evidence.num_violating >
                    a.num_violating + b.num_violating + max_new_violating * b.num_explained()) {
    return std::nullopt;
  }
  const std::vector<size_t>& blockers = BlockersOf(*added);
  const bool is_free = std::all_of(blockers.begin(), blockers.end(),
                                   [&](size_t i) { return i == first || i == second; });
  return is_free ? added : std::nullopt;
}

// Gives their place to it if it explains a share of what both do. True when that was done.
bool ModelSelection::ReplaceBoth(size_t first, size_t second, size_t whole, double share_of_both,
                                 const Input& input) {
  if (!Replace(Only({first, second}), whole, input, share_of_both)) return false;
  // What is less than both together is not to be divided again.
  candidates_[whole].gain_factor = 1 / share_of_both;
  candidates_[first].is_out = candidates_[second].is_out = true;
  return true;
}

// Gives the place of two selected candidates to one that goes on behind what hides its middle. As a
// sensor bends it, both may explain somewhat more, if little of free space is inside. True when
// that was done.
bool ModelSelection::Unite(size_t old, const Input& input) {
  constexpr double kMaxNewViolating = 0.5;  // of what the smaller one explains
  // Steps [m] between parts of one top: what noise makes, what a sensor that bends it adds over the
  // distance between their middles, and at most what a large carton has.
  constexpr double kNoiseStep = 0.0025;
  constexpr double kStepPerDistance = 0.02;
  constexpr double kMaxTopStep = 0.006;
  const Plane& support = input.observation.support;
  const Candidate& larger = candidates_[old];
  const Solid& solid = larger.hypothesis.solid;
  if (IsUpright(solid, support) != (solid.shape == Shape::kBox)) return false;
  const size_t num_before = num_candidates_;
  for (const size_t part : order_) {
    const Candidate& smaller = candidates_[part];
    const Solid& other = smaller.hypothesis.solid;
    if (part == old || !smaller.is_selected || other.shape != solid.shape ||
        smaller.evidence.num_explained() > larger.evidence.num_explained()) {
      continue;
    }
    const double distance = (other.X_CO.translation() - solid.X_CO.translation()).norm();
    if (std::abs(TopOf(other, support) - TopOf(solid, support)) >
        std::min(kMaxTopStep, kNoiseStep + kStepPerDistance * distance)) {
      continue;
    }
    const auto longer = Through(solid, smaller, input);
    if (!longer) continue;
    Hypothesis whole = larger.hypothesis;
    whole.solid = *longer;
    const auto added = AddForBoth(old, part, whole, kMaxNewViolating, input);
    if (added &&
        TotalSeenThrough({*added}, input) <
            kMaxSeenThrough + TotalSeenThrough({old, part}, input) &&
        ReplaceBoth(old, part, *added, kMinShareOfBoth * (1 - candidates_[*added].misfit_share),
                    input)) {
      return true;
    }
    num_candidates_ = num_before;
  }
  return false;
}

// Gives the place of a selected candidate of which no lower end was seen, and of one below with its
// outline, to one that reaches from its top to the end of that, also where something hides their
// middle: of the same outline, two that stand on each other look like one. As a carton bulges, both
// may explain somewhat more, if no free space is inside. True when that was done.
bool ModelSelection::JoinColumn(size_t old, const Input& input) {
  constexpr double kMaxNewViolating = 0.05;  // of what the lower one explains
  constexpr double kMinOfLower = 0.5;        // of what the lower one explains, by the whole
  const Plane& support = input.observation.support;
  const Candidate& upper = candidates_[old];
  const Solid& solid = upper.hypothesis.solid;
  if (!IsUpright(solid, support) || upper.hypothesis.evidence[2] != Evidence::kAssumed) {
    return false;
  }
  const double top = TopOf(solid, support), bottom = BottomOf(solid, support);
  const size_t num_before = num_candidates_;
  for (const size_t part : order_) {
    const Candidate& lower = candidates_[part];
    const Solid& other = lower.hypothesis.solid;
    if (part == old || !lower.is_selected || !IsUpright(other, support) ||
        TopOf(other, support) > top - kMinExtent || BottomOf(other, support) > bottom ||
        !HaveOneCrossSection(other, solid)) {
      continue;
    }
    Hypothesis whole = upper.hypothesis;
    whole.solid = Longer(solid, 2, -1, bottom - BottomOf(other, support));
    whole.evidence[2] = lower.hypothesis.evidence[2];
    const double min_explained =
        upper.evidence.num_explained() + kMinOfLower * lower.evidence.num_explained();
    const auto added = AddForBoth(old, part, whole, kMaxNewViolating, input);
    if (added && candidates_[*added].evidence.num_explained() > min_explained &&
        ReplaceBoth(old, part, *added, kMinShareOfBoth, input)) {
      return true;
    }
    num_candidates_ = num_before;
  }
  return false;
}

}  // namespace declutter
