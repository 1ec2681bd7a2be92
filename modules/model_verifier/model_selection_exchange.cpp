#include <algorithm>

#include "modules/geometry/plane.h"
#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

constexpr double kMinImprovement = 1.02;  // of the gain

}  // namespace

// Gives the place of selected candidates to those that explain more when all others stay: some of
// the pixels that they were selected for, later ones explain as well, two may fill the place of one
// better, and one that explains much may be kept out by some that explain little. True when one
// changed.
bool ModelSelection::Exchange(const Input& input) {
  bool has_changed = false;
  order_ = selected_;
  for (const size_t old : order_) {
    has_changed |= candidates_[old].is_selected && Replace(Only(old), std::nullopt, input);
  }
  for (size_t i = 0; i < num_candidates_; ++i) {
    if (IsWorthTrying(i)) has_changed |= Replace(BlockersOf(i), i, input);
  }
  order_ = selected_;
  for (const size_t old : order_) {
    has_changed |= candidates_[old].is_selected &&
                   (Split(old, input) || CutLower(old, input) || Reshape(old, input));
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

const std::vector<size_t>& ModelSelection::BlockersOf(size_t index) {
  blockers_.clear();
  for (const size_t i : selected_) {
    if (AreRivals(index, i)) blockers_.push_back(i);
  }
  return blockers_;
}

const std::vector<size_t>& ModelSelection::Only(size_t index) {
  only_.assign(1, index);
  return only_;
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
  for (const size_t i : instead_) Release(i);
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
  const auto parts = box_splitter_.Split(solid, points_O);
  return parts && ReplaceByParts({(*parts)[0], (*parts)[1]}, old, 1, input);
}

// Gives the place of a selected candidate that explains less than noise would leave of its pixels
// to one of the other shape, laid over the same. True when that explains more.
bool ModelSelection::Reshape(size_t old, const Input& input) {
  constexpr double kMaxShare = 0.9;  // of what noise leaves of its pixels
  constexpr int kMaxPx = 2000;       // [px]: where more is seen, votes tell the shape
  const Observation& observation = input.observation;
  const Candidate& candidate = candidates_[old];
  const Solid& solid = candidate.hypothesis.solid;
  if (!IsUpright(solid, observation.support)) return false;
  is_own_.assign(num_explaining_.size(), 0);
  int num_own_px = 0;
  for (const int32_t pixel : candidate.evidence.explained) {
    if (num_explaining_[static_cast<size_t>(pixel)] > 1) continue;
    is_own_[static_cast<size_t>(pixel)] = 1;
    num_own_px += candidate.evidence.pixel_weight;
  }
  Release(old);
  const double gain = Gain(&candidates_[old]);
  const double noise_in_tolerances = MeasurementSigma(solid.X_CO.translation().z()) /
                                     SurfaceTolerance(solid.X_CO.translation().z());
  std::optional<size_t> best;
  if (num_own_px < kMaxPx &&
      gain < kMaxShare * (1 - noise_in_tolerances * noise_in_tolerances) * num_own_px) {
    best = BestOver(is_own_, candidate, input);
  }
  const bool is_better = best && candidates_[*best].num_blockers == 0 &&
                         Gain(&candidates_[*best]) > kMinImprovement * gain;
  Select(old);
  return is_better && Replace(Only(old), best, input);
}

// The candidate of the other shape that explains the most of some pixels that one explains.
std::optional<size_t> ModelSelection::BestOver(const std::vector<uint8_t>& is_marked,
                                               const Candidate& candidate, const Input& input) {
  constexpr double kMinShare = 0.5;  // of the points it is laid over
  const Shape shape = candidate.hypothesis.solid.shape;
  const int pixel_weight = input.observation.grid.pixel_weight();
  const Eigen::Isometry3d X_TC = TableFrame(input.observation.support);
  const Eigen::Isometry3d X_CT = X_TC.inverse();
  std::optional<size_t> best;
  for (const SurfacePart& part : part_finder_.Find(
           is_marked, candidate.evidence.window, X_TC,
           static_cast<size_t>(config_.min_explained_px() / pixel_weight), input.observation)) {
    const double min_px = kMinShare * pixel_weight * static_cast<double>(part.num_points());
    for (const Hypothesis& hypothesis : part_completion_.SolidsOver(part, X_CT)) {
      if (hypothesis.solid.shape == shape) continue;
      const auto added = AddRefined(hypothesis, min_px, input);
      if (added && (!best || Gain(&candidates_[*added]) > Gain(&candidates_[*best]))) best = added;
    }
  }
  return best;
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
bool ModelSelection::ReplaceByParts(std::initializer_list<Solid> parts, size_t old,
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
         Replace(Only(old), first, input, share_of_old);
}

}  // namespace declutter
