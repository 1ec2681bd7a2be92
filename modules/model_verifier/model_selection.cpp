#include "modules/model_verifier/model_selection.h"

#include <algorithm>

#include "modules/model_verifier/refinement.h"

namespace declutter {
namespace {

constexpr size_t kMaxObjects = 255;  // ids fit the label image

// Share of `a`, sampled on a grid, that lies deeper than the tolerance inside `b`.
double SharedVolume(const Solid& a, const SolidCaster& b) {
  constexpr int kSteps = 7;
  const double min_depth = std::min(0.004, 0.15 * a.size.minCoeff());  // [m]
  int num_inside = 0;
  int num_samples = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (int k = 0; k < kSteps; ++k) {
        const Eigen::Vector3d x =
            Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5) / kSteps - Eigen::Vector3d::Constant(0.5);
        if (a.shape == Shape::kCylinder && x.head<2>().norm() > 0.5) continue;
        ++num_samples;
        num_inside += b.SignedDistance(b.X_OC() * a.X_CO * x.cwiseProduct(a.size)) < -min_depth;
      }
    }
  }
  return static_cast<double>(num_inside) / num_samples;
}

bool Intersect(const Solid& a, const Solid& b, double max_shared_volume) {
  return SharedVolume(a, SolidCaster(b)) > max_shared_volume ||
         SharedVolume(b, SolidCaster(a)) > max_shared_volume;
}

double Gain(const ModelVerifierConfig& config, const Candidate& candidate,
            const std::vector<char>& is_taken) {
  double gain = 0;
  for (const auto& pixel : candidate.evidence.explained) {
    if (!is_taken[static_cast<size_t>(pixel.pixel)]) gain += pixel.fit;
  }
  gain *= candidate.evidence.pixel_weight;
  double penalty = config.violation_weight() *
                   (candidate.evidence.num_violating + candidate.evidence.num_contradicting);
  penalty += candidate.evidence.num_overhanging;
  for (Evidence extent : candidate.hypothesis.evidence) {
    if (extent == Evidence::kAssumed) penalty += config.assumption_penalty() * gain;
  }
  return gain - penalty;
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
        is_taken_(observation.image.counts.size(), 0) {}

  void Add(const Hypothesis& hypothesis) {
    Candidate candidate{hypothesis, CastRays(hypothesis.solid, observation_)};
    if (!IsPlausible(config_, candidate.evidence)) return;
    candidate.gain = Gain(config_, candidate, is_taken_);
    candidates_.push_back(std::move(candidate));
  }

  std::vector<Candidate> Run() {
    std::vector<Candidate> selected;
    while (!candidates_.empty() && selected.size() < kMaxObjects) {
      const auto best =
          std::max_element(candidates_.begin(), candidates_.end(),
                           [](const Candidate& a, const Candidate& b) { return a.gain < b.gain; });
      if (best->gain < config_.min_explained_px()) break;
      if (config_.refine() && RefineRivals(*best)) continue;
      selected.push_back(std::move(*best));
      candidates_.erase(best);
      Take(selected.back());
    }
    return selected;
  }

 private:
  // Refines the best candidate and those that could take its place; false when all were.
  bool RefineRivals(const Candidate& best) {
    constexpr double kMinGainOfRival = 0.7;  // of the best candidate's
    const Solid space = best.hypothesis.solid;
    const double min_gain = kMinGainOfRival * best.gain;
    bool has_changed = false;
    for (Candidate& candidate : candidates_) {
      if (candidate.is_refined || candidate.gain < min_gain ||
          !Intersect(candidate.hypothesis.solid, space, config_.max_shared_volume())) {
        continue;
      }
      candidate.hypothesis.solid = Refine(candidate.hypothesis.solid, observation_);
      candidate.evidence = CastRays(candidate.hypothesis.solid, observation_);
      candidate.gain = Gain(config_, candidate, is_taken_);
      candidate.is_refined = true;
      has_changed = true;
    }
    if (has_changed) {
      const auto is_out = [&](const Candidate& c) { return !IsPlausible(config_, c.evidence); };
      candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_out),
                        candidates_.end());
    }
    return has_changed;
  }

  void Take(const Candidate& taken) {
    for (const auto& pixel : taken.evidence.explained) {
      is_taken_[static_cast<size_t>(pixel.pixel)] = 1;
    }
    const auto is_out = [&](const Candidate& c) {
      return Intersect(c.hypothesis.solid, taken.hypothesis.solid, config_.max_shared_volume());
    };
    candidates_.erase(std::remove_if(candidates_.begin(), candidates_.end(), is_out),
                      candidates_.end());
    for (Candidate& candidate : candidates_) {
      candidate.gain = Gain(config_, candidate, is_taken_);
    }
  }

  const ModelVerifierConfig& config_;
  const Observation& observation_;
  std::vector<char> is_taken_;  // pixels that a selected solid explains
  std::vector<Candidate> candidates_;
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
