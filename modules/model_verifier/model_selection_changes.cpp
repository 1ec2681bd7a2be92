#include <algorithm>
#include <cmath>

#include "modules/geometry/plane.h"
#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/extents.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {

// Gives the place of a box with much free space inside to two side by side: one patch of the height
// of both may have been taken for one top face. True when that explains more.
bool ModelSelection::SplitByArea(size_t old, const Input& input) {
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
  const auto parts = box_splitter_.Split(solid, points_O);
  if (!parts) return false;
  parts_.assign(parts->begin(), parts->end());
  return ReplaceByParts(parts_, old, 1, input);
}

// Gives the place of a selected candidate to one of the other shape, laid over its pixels; where
// others keep that one out, their place, too. True when that explains more.
bool ModelSelection::Reshape(size_t old, const Input& input) {
  constexpr int kMaxPx = 2000;  // [px]: where more is seen, votes tell the shape
  Candidate& candidate = candidates_[old];
  const Solid& solid = candidate.hypothesis.solid;
  if (candidate.is_reshaped || !IsUpright(solid, input.observation.support)) return false;
  is_own_.assign(num_explaining_.size(), 0);
  int num_own_px = 0;
  for (const int32_t pixel : candidate.evidence.explained) {
    if (num_explaining_[static_cast<size_t>(pixel)] > 1) continue;
    is_own_[static_cast<size_t>(pixel)] = 1;
    num_own_px += candidate.evidence.pixel_weight;
  }
  if (num_own_px >= kMaxPx) return false;
  candidate.is_reshaped = true;
  Release(old);
  const double gain = Gain(&candidate);
  const auto best =
      AddOver(is_own_, candidate.evidence.window, solid.shape, input.observation, input);
  const bool is_better = best && candidates_[*best].num_blockers == 0 &&
                         Gain(&candidates_[*best]) > kMinImprovement * gain;
  Select(old);
  if (is_better) return Replace(Only({old}), best, input);
  return best && TryInPlaceOfBlockers(*best, input);
}

// Adds solids over the marked pixels of a window, refined on another observation; of the shapes,
// one may be left out. The one that explains the most.
std::optional<size_t> ModelSelection::AddOver(const std::vector<uint8_t>& is_marked,
                                              const PixelWindow& window,
                                              std::optional<Shape> but_shape,
                                              const Observation& fitted, const Input& input) {
  constexpr double kMinShare = 0.5;  // of the points it is laid over
  const int pixel_weight = input.observation.grid.pixel_weight();
  const Eigen::Isometry3d X_TC = TableFrame(input.observation.support);
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  std::optional<size_t> best;
  for (const SurfacePart& part : part_finder_.Find(
           is_marked, window, X_TC, static_cast<size_t>(config_.min_explained_px() / pixel_weight),
           input.observation)) {
    const double min_px = kMinShare * pixel_weight * static_cast<double>(part.num_points());
    for (const Hypothesis& hypothesis : part_completion_.SolidsOver(part, X_CT)) {
      if (hypothesis.solid.shape == but_shape) continue;
      const auto added = AddRefined(hypothesis, min_px, fitted, input);
      if (added && (!best || Gain(&candidates_[*added]) > Gain(&candidates_[*best]))) best = added;
    }
  }
  return best;
}

// Gives the place of an upright cylinder whose radius changes on its way down to its upper part: it
// may stand on another that continues its side. True when that explains more.
bool ModelSelection::CutLower(size_t old, const Input& input) {
  constexpr double kMaxMisfit = 0.6;  // [sigma]
  const Solid& solid = candidates_[old].hypothesis.solid;
  if (solid.shape != Shape::kCylinder || !IsUpright(solid, input.observation.support)) return false;
  std::vector<Eigen::Vector3d>& points_O = input.buffers->explained_O;
  FindExplainedPoints(solid, candidates_[old].evidence, input.observation, &points_O);
  const double misfit =
      LayerMisfit(solid, points_O) / MeasurementSigma(solid.X_CO.translation().z());
  if (misfit < kMaxMisfit) return false;
  const auto step = StepOf(solid, points_O);
  if (!step) return false;
  const Solid upper = Longer(solid, 2, -1, -(0.5 * solid.height() + *step));
  if (StackInstead(old, upper, *step, input)) return true;
  parts_.assign(1, upper);
  return ReplaceByParts(parts_, old, 1 - MisfitShare(misfit), input);
}

// Gives the place of a cylinder to an upper part of it and what that stands on, if both together
// explain clearly more.
bool ModelSelection::StackInstead(size_t old, const Solid& upper, double step, const Input& input) {
  constexpr double kMinShare = 1.3;  // of what the one explains
  parts_.assign(1, upper);
  FindLowerParts(old, step);
  const size_t num_before = num_candidates_;
  if (ReplaceByParts(parts_, old, kMinShare, input)) {
    if (instead_.size() == 2) return true;
    PutBack(Only({old}));
  }
  num_candidates_ = num_before;
  return false;
}

// Appends to parts_ what reaches from cylinders through the step of a candidate's side, that one
// among them, down from there.
void ModelSelection::FindLowerParts(size_t old, double step) {
  constexpr size_t kMaxParts = 5;
  constexpr double kMaxOffset = 0.010;  // [m] between the axes
  constexpr double kMinCosine = 0.99;   // of the angle between them
  const Solid& solid = candidates_[old].hypothesis.solid;
  const Eigen::Isometry3d X_OC = solid.X_CO.inverse();
  for (size_t i = 0; i < num_candidates_ && parts_.size() < kMaxParts; ++i) {
    const Solid& other = candidates_[i].hypothesis.solid;
    if (other.shape != Shape::kCylinder || candidates_[i].is_out) continue;
    const Eigen::Vector3d centre_O = X_OC * other.X_CO.translation();
    const double top = centre_O.z() + 0.5 * other.height();
    if (X_OC.linear().row(2).dot(other.X_CO.linear().col(2)) < kMinCosine ||
        centre_O.head<2>().norm() > kMaxOffset || top < step - kMinExtent) {
      continue;
    }
    const Solid lower = Longer(other, 2, 1, std::min(0.0, step - top));
    if (lower.height() > kMinExtent) parts_.push_back(lower);
  }
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
         Replace(Only({old}), first, input, share_of_old);
}

}  // namespace declutter
