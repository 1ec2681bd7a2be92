#include "modules/model_verifier/model_selection.h"

#include <algorithm>

namespace declutter {
namespace {

// Share of `a`, sampled on a grid, that lies deeper than the tolerance inside `b`.
double SharedVolume(const Solid& a, const SolidCaster& b) {
  constexpr int kSteps = 7;
  constexpr double kMinDepth = 0.004;  // [m]
  int num_inside = 0;
  int num_samples = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      for (int k = 0; k < kSteps; ++k) {
        const Eigen::Vector3d x =
            Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5) / kSteps - Eigen::Vector3d::Constant(0.5);
        if (a.shape == Shape::kCylinder && x.head<2>().norm() > 0.5) continue;
        ++num_samples;
        num_inside += b.SignedDistance(a.X_CO * x.cwiseProduct(a.size)) < -kMinDepth;
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
  double penalty = config.violation_weight() *
                   (candidate.evidence.num_violating + candidate.evidence.num_contradicting);
  for (Evidence extent : candidate.hypothesis.evidence) {
    if (extent == Evidence::kAssumed) penalty += config.assumption_penalty() * gain;
  }
  return gain - penalty;
}

}  // namespace

std::vector<Candidate> SelectModels(const ModelVerifierConfig& config,
                                    const std::vector<Hypothesis>& hypotheses,
                                    const DepthImage& image, const NormalImage& normals,
                                    const Plane& support) {
  std::vector<Candidate> candidates;
  for (const Hypothesis& hypothesis : hypotheses) {
    Candidate candidate{hypothesis, CastRays(hypothesis.solid, image, normals, support), 0};
    const auto num_explained = static_cast<double>(candidate.evidence.explained.size());
    if (num_explained < config.min_explained_px() ||
        candidate.evidence.num_violating + candidate.evidence.num_contradicting >
            config.max_violating_share() * num_explained) {
      continue;
    }
    candidates.push_back(std::move(candidate));
  }
  std::vector<char> is_taken(image.counts.size(), 0);
  std::vector<Candidate> selected;
  while (true) {
    size_t best = candidates.size();
    for (size_t i = 0; i < candidates.size(); ++i) {
      candidates[i].gain = Gain(config, candidates[i], is_taken);
      if (best == candidates.size() || candidates[i].gain > candidates[best].gain) best = i;
    }
    if (best == candidates.size() || candidates[best].gain < config.min_explained_px()) break;
    selected.push_back(std::move(candidates[best]));
    const Candidate& taken = selected.back();
    for (const auto& pixel : taken.evidence.explained) {
      is_taken[static_cast<size_t>(pixel.pixel)] = 1;
    }
    candidates.erase(candidates.begin() + static_cast<std::ptrdiff_t>(best));
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                    [&](const Candidate& c) {
                                      return Intersect(c.hypothesis.solid, taken.hypothesis.solid,
                                                       config.max_shared_volume());
                                    }),
                     candidates.end());
  }
  return selected;
}

}  // namespace declutter
