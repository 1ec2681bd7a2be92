#include "modules/model_verifier/model_selection.h"

#include <algorithm>
#include <optional>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/box_splitting.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/systematic_misfit.h"

namespace declutter {
namespace {

constexpr size_t kMaxObjects = 255;       // ids fit the label image
constexpr int kMaxRounds = 3;             // of exchanges
constexpr double kMinImprovement = 1.02;  // of the gain, for an exchange

// Share of `a`, sampled on a grid, that lies deeper than the tolerance inside `b`.
double SharedVolume(const Solid& a, const SolidCaster& b) {
  constexpr int kSteps = 5;
  const double min_depth = std::min(0.004, 0.15 * a.size.minCoeff());  // [m]
  const Eigen::Isometry3d X_BA = b.X_OC() * a.X_CO;
  int num_inside = 0;
  int num_samples = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (int k = 0; k < kSteps; ++k) {
        const Eigen::Vector3d x =
            Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5) / kSteps - Eigen::Vector3d::Constant(0.5);
        if (a.shape == Shape::kCylinder && x.head<2>().norm() > 0.5) continue;
        ++num_samples;
        num_inside += b.SignedDistance(X_BA * x.cwiseProduct(a.size)) < -min_depth;
      }
    }
  }
  return static_cast<double>(num_inside) / num_samples;
}

// False when the sphere around one does not reach into the other.
bool MayIntersect(const Solid& a, const Solid& b) {
  const Eigen::Vector3d ab = b.X_CO.translation() - a.X_CO.translation();
  const auto reaches = [&](const Solid& sphere, const Solid& solid) {
    const Eigen::Vector3d ab_O = solid.X_CO.linear().transpose() * ab;
    return (ab_O.cwiseAbs() - 0.5 * solid.size).maxCoeff() < 0.5 * sphere.size.norm();
  };
  return reaches(a, b) && reaches(b, a);
}

bool Intersect(const Solid& a, const Solid& b, double max_shared_volume) {
  return MayIntersect(a, b) && (SharedVolume(a, SolidCaster(b)) > max_shared_volume ||
                                SharedVolume(b, SolidCaster(a)) > max_shared_volume);
}

// True when the image speaks enough for a candidate for it to be considered at all.
bool IsPlausible(const ModelVerifierConfig& config, const RayEvidence& evidence) {
  const auto num_explained = static_cast<double>(evidence.num_explained());
  return num_explained >= config.min_explained_px() &&
         evidence.num_violating + evidence.num_contradicting <=
             config.max_violating_share() * num_explained;
}

class Selection {
 public:
  Selection(const ModelVerifierConfig& config, const Observation& observation)
      : config_(config),
        observation_(observation),
        num_explaining_(observation.image.counts.size(), 0) {}

  void Add(const Hypothesis& hypothesis) {
    Candidate candidate{hypothesis, CastRays(hypothesis.solid, observation_)};
    if (IsPlausible(config_, candidate.evidence)) candidates_.push_back(std::move(candidate));
  }

  std::vector<Candidate> Run() {
    while (const auto best = Best()) Select(*best);
    for (int round = 0; round < kMaxRounds && Exchange(); ++round) {
    }
    std::vector<Candidate> selected;
    for (size_t i : selected_) selected.push_back(std::move(candidates_[i]));
    return selected;
  }

 private:
  // Gives the place of selected candidates to those that explain more when all others stay: some of
  // the pixels that they were selected for, later ones explain as well, two may fill the place of
  // one better, and one that explains much may be kept out by some that explain little. True when
  // one changed.
  bool Exchange() {
    bool has_changed = false;
    for (const size_t old : std::vector<size_t>(selected_)) {
      has_changed |= candidates_[old].is_selected && Replace({old}, std::nullopt);
    }
    for (size_t i = 0; i < candidates_.size(); ++i) {
      const Candidate& candidate = candidates_[i];
      if (!candidate.is_out && !candidate.is_selected && IsWorthTrying(candidate)) {
        has_changed |= Replace(BlockersOf(candidate), i);
      }
    }
    for (const size_t old : std::vector<size_t>(selected_)) {
      has_changed |= candidates_[old].is_selected && (Split(old) || CutLower(old));
    }
    return has_changed;
  }

  // Gives the place of a box with much free space inside to two side by side: one patch of the
  // height of both may have been taken for one top face. True when that explains more.
  bool Split(size_t old) {
    constexpr double kMaxFreeShare = 0.05;  // of the explained pixels: beyond what noise makes
    constexpr int kMaxFree = 60;            // [px] that edges leave
    const Hypothesis hypothesis = candidates_[old].hypothesis;
    const RayEvidence& evidence = candidates_[old].evidence;
    const int num_free = evidence.num_violating + evidence.num_contradicting;
    if (hypothesis.solid.shape != Shape::kBox || num_free < kMaxFree ||
        num_free < kMaxFreeShare * evidence.num_explained()) {
      return false;
    }
    const auto parts = SplitBox(hypothesis.solid, ExplainedPoints(candidates_[old]));
    if (!parts) return false;
    return ReplaceBy({(*parts)[0], (*parts)[1]}, old);
  }

  // Gives the place of a cylinder whose radius changes on its way down to its upper part: it may
  // stand on another that continues its side. True when that explains more.
  bool CutLower(size_t old) {
    constexpr double kMaxMisfit = 0.6;  // [sigma]
    const Solid solid = candidates_[old].hypothesis.solid;
    if (solid.shape != Shape::kCylinder) return false;
    const std::vector<Eigen::Vector3d> points_O = ExplainedPoints(candidates_[old]);
    const double sigma = MeasurementSigma(solid.X_CO.translation().z());
    const double misfit = LayerMisfit(solid, points_O) / sigma;
    if (misfit < kMaxMisfit) return false;
    const auto step = StepOf(solid, points_O);
    if (!step) return false;
    Solid upper = solid;
    upper.size.z() = 0.5 * solid.height() - *step;
    upper.X_CO = solid.X_CO * Eigen::Translation3d(0, 0, 0.5 * (0.5 * solid.height() + *step));
    return ReplaceBy({upper}, old, 1 - MisfitShare(misfit));
  }

  // Proposes parts of a selected candidate in its place, of whose gain only a share counts.
  bool ReplaceBy(const std::vector<Solid>& parts, size_t old, double share_of_old = 1) {
    const Hypothesis hypothesis = candidates_[old].hypothesis;
    std::optional<size_t> first;
    for (const Solid& part : parts) {
      Candidate candidate{hypothesis, CastRays(part, observation_)};
      candidate.hypothesis.solid = part;
      if (part.shape == Shape::kCylinder) candidate.hypothesis.evidence[2] = Evidence::kAssumed;
      if (config_.refine()) {
        RefineIfNoWorse(observation_, observation_, &candidate.hypothesis.solid,
                        &candidate.evidence);
      }
      if (!IsPlausible(config_, candidate.evidence)) continue;
      candidate.is_refined = true;
      candidate.misfit_share = MisfitShareOf(candidate);
      for (const size_t i : selected_) {
        candidate.num_blockers += AreRivals(candidate, candidates_[i]);
      }
      candidates_.push_back(std::move(candidate));
      const size_t added = candidates_.size() - 1;
      if (!first || Gain(candidates_[added]) > Gain(candidates_[*first])) first = added;
    }
    return first && candidates_[*first].num_blockers <= 1 && Replace({old}, first, share_of_old);
  }

  double MisfitShareOf(const Candidate& candidate) const {
    const Solid& solid = candidate.hypothesis.solid;
    return MisfitShare(SystematicMisfit(solid, ExplainedPoints(candidate)) /
                       MeasurementSigma(solid.X_CO.translation().z()));
  }

  std::vector<Eigen::Vector3d> ExplainedPoints(const Candidate& candidate) const {
    const DepthImage& image = observation_.image;
    const Eigen::Isometry3d X_OC = candidate.hypothesis.solid.X_CO.inverse();
    std::vector<Eigen::Vector3d> points_O;
    for (const auto& pixel : candidate.evidence.explained) {
      points_O.push_back(
          X_OC * image.PointAt(pixel.pixel % image.camera.width, pixel.pixel / image.camera.width));
    }
    return points_O;
  }

  // True for a candidate that explains what nobody else does, or about as much as all those
  // together that keep it out.
  bool IsWorthTrying(const Candidate& candidate) const {
    constexpr double kMinShare = 0.5;
    if (candidate.num_blockers == 0) return false;
    if (Gain(candidate) >= config_.min_explained_px()) return true;
    if (candidate.num_blockers == 1) return false;
    double gain = 0;
    for (const size_t i : BlockersOf(candidate)) gain += candidates_[i].gain;
    return candidate.evidence.Balance() > kMinShare * gain;
  }

  std::vector<size_t> BlockersOf(const Candidate& candidate) const {
    std::vector<size_t> blockers;
    for (const size_t i : selected_) {
      if (AreRivals(candidate, candidates_[i])) blockers.push_back(i);
    }
    return blockers;
  }

  // Gives the place of selected candidates to others, beginning with `first`; takes that back and
  // returns false unless they explain more.
  bool Replace(const std::vector<size_t>& old, std::optional<size_t> first,
               double share_of_old = 1) {
    double old_gain = 0;
    for (const size_t i : old) {
      Release(i);
      old_gain += Gain(candidates_[i]);
      candidates_[i].is_out = true;
    }
    double new_gain = 0;
    std::vector<size_t> instead;
    for (auto next = first ? first : Best(); next; next = Best()) {
      new_gain += Gain(candidates_[*next]);
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

  // The candidate that explains the most pixels nobody else explains; nothing when it explains too
  // few. It and all that could take its place are refined.
  std::optional<size_t> Best() {
    if (selected_.size() >= kMaxObjects) return std::nullopt;
    for (Candidate& candidate : candidates_) {
      if (IsFree(candidate)) candidate.gain = Gain(candidate);
    }
    while (true) {
      std::optional<size_t> best;
      for (size_t i = 0; i < candidates_.size(); ++i) {
        if (!IsFree(candidates_[i])) continue;
        if (!best || candidates_[i].gain > candidates_[*best].gain) best = i;
      }
      if (!best || candidates_[*best].gain < config_.min_explained_px()) return std::nullopt;
      if (!config_.refine() || !RefineRivals(candidates_[*best])) return best;
    }
  }

  // Refines the best candidate and those that could take its place; false when all were.
  bool RefineRivals(const Candidate& best) {
    constexpr double kMinGainOfRival = 0.7;  // of the best candidate's
    const Solid space = best.hypothesis.solid;
    const double min_gain = kMinGainOfRival * best.gain;
    bool has_changed = false;
    for (Candidate& candidate : candidates_) {
      if (candidate.is_refined || !IsFree(candidate) || candidate.gain < min_gain ||
          !Intersect(candidate.hypothesis.solid, space, config_.max_shared_volume())) {
        continue;
      }
      RefineIfNoWorse(observation_, observation_, &candidate.hypothesis.solid, &candidate.evidence);
      candidate.is_refined = true;
      candidate.misfit_share = MisfitShareOf(candidate);
      candidate.is_out = !IsPlausible(config_, candidate.evidence);
      candidate.num_blockers = 0;
      for (size_t i : selected_) candidate.num_blockers += AreRivals(candidate, candidates_[i]);
      candidate.gain = Gain(candidate);
      has_changed = true;
    }
    return has_changed;
  }

  bool IsFree(const Candidate& candidate) const {
    return candidate.num_blockers == 0 && !candidate.is_out && !candidate.is_selected;
  }

  bool AreRivals(const Candidate& a, const Candidate& b) const {
    return Intersect(a.hypothesis.solid, b.hypothesis.solid, config_.max_shared_volume());
  }

  double Gain(const Candidate& candidate) const {
    const RayEvidence& evidence = candidate.evidence;
    double gain = 0;
    for (const auto& pixel : evidence.explained) {
      if (num_explaining_[static_cast<size_t>(pixel.pixel)] == 0) gain += pixel.fit;
    }
    gain *= evidence.pixel_weight;
    double penalty =
        config_.violation_weight() *
            (evidence.num_violating + evidence.num_contradicting + evidence.num_overhanging) +
        candidate.misfit_share * gain;
    for (Evidence extent : candidate.hypothesis.evidence) {
      if (extent == Evidence::kAssumed) penalty += config_.assumption_penalty() * gain;
    }
    return gain - penalty;
  }

  void Select(size_t index) {
    selected_.push_back(index);
    candidates_[index].is_selected = true;
    Mark(candidates_[index], 1);
  }

  void Release(size_t index) {
    selected_.erase(std::find(selected_.begin(), selected_.end(), index));
    candidates_[index].is_selected = false;
    Mark(candidates_[index], -1);
  }

  void Mark(const Candidate& selected, int change) {
    for (const auto& pixel : selected.evidence.explained) {
      num_explaining_[static_cast<size_t>(pixel.pixel)] += change;
    }
    for (Candidate& candidate : candidates_) {
      if (!candidate.is_selected && &candidate != &selected && AreRivals(candidate, selected)) {
        candidate.num_blockers += change;
      }
    }
  }

  const ModelVerifierConfig& config_;
  const Observation& observation_;
  std::vector<int> num_explaining_;  // selected solids on each pixel
  std::vector<Candidate> candidates_;
  std::vector<size_t> selected_;
};

}  // namespace

std::vector<Candidate> SelectModels(const ModelVerifierConfig& config,
                                    const std::vector<Hypothesis>& hypotheses,
                                    const Observation& observation) {
  Selection selection(config, observation);
  for (const Hypothesis& hypothesis : hypotheses) selection.Add(hypothesis);
  return selection.Run();
}

}  // namespace declutter
