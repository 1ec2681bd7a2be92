#include "tests/paper/method.h"

#include <nlohmann/json.hpp>

#include "modules/codec/codec.h"
#include "modules/feature_estimator/feature_estimator.h"
#include "modules/model_verifier/model_verifier.h"
#include "modules/plane_filter/plane_filter.h"
#include "modules/ransac_segmenter/single_shot.h"
#include "modules/scene_renderer/scene_folder.h"
#include "tests/accuracy/solid_comparison.h"

namespace declutter::experiments {
namespace {

constexpr int kNumIterations = 25;  // I of section 4
constexpr int64_t kUtime = 33333;   // [us] part of the seed: the same for every frame

template <typename Value>
Value ThroughItsMessage(const Value& value) {
  return codec::Decode(codec::Encode(value));
}

bool IsRight(const Solid& solid, const accuracy::SceneTruth& truth) {
  constexpr double kTolerance = 0.020;  // [m]
  for (const accuracy::TrueObject& object : truth.objects) {
    if (object.shape != solid.shape || !object.solid) continue;
    // Comparing volumes takes long: only where it can matter.
    const Eigen::Vector3d offset = object.solid->X_CO.translation() - solid.X_CO.translation();
    if (offset.norm() > kTolerance) continue;
    if (accuracy::IsWithin(accuracy::CompareSolids(solid, *object.solid), kTolerance)) return true;
  }
  return false;
}

}  // namespace

PreparedFrame Prepare(const RenderedScene& scene, FeatureMode mode) {
  PreparedFrame frame;
  frame.truth = accuracy::ParseSceneTruth(DescribeScene(scene, "scene"));
  frame.truth.labels = scene.labels;
  frame.depth.header.utime = kUtime;
  frame.depth.header.frame = "scene";
  frame.depth.image = scene.depth;
  frame.depth = ThroughItsMessage(frame.depth);
  FeatureEstimatorConfig features;
  if (mode == FeatureMode::kPaper) features.set_mode("paper");
  frame.tabletop = ThroughItsMessage(PlaneFilter(PlaneFilterConfig()).Filter(frame.depth));
  frame.features = ThroughItsMessage(FeatureEstimator(features).Estimate(frame.tabletop));
  return frame;
}

Result RunMethod(const Method& method, const PreparedFrame& frame) {
  const HypothesisList hypotheses = ThroughItsMessage(
      HoughSegmenter(method.segmenter, method.detect).Segment(frame.tabletop, frame.features));
  Result result;
  result.num_hypotheses = hypotheses.hypotheses.size();
  for (const Hypothesis& hypothesis : hypotheses.hypotheses) {
    result.num_right_hypotheses += IsRight(hypothesis.solid, frame.truth);
  }
  result.found = ThroughItsMessage(ModelVerifier(method.verifier).Verify(frame.depth, hypotheses));
  result.score = accuracy::MatchObjects(frame.truth, result.found);
  return result;
}

Method VotingAlone() {
  Method method = Voting();
  method.name = "votes";
  method.verifier.set_refine(false);
  return method;
}

Method Voting() {
  Method method;
  method.name = "votes, refined";
  method.segmenter.set_num_iterations(kNumIterations);
  return method;
}

Method SingleShot() {
  Method method;
  method.name = "single-shot RANSAC";
  method.detect = FitSidesOnce;
  HoughSegmenterConfig& config = method.segmenter;
  config.set_num_samples(config.num_samples() * kNumIterations);
  config.set_filter_runs(false);
  config.set_filter_arcs(false);
  config.set_filter_heights(false);
  config.set_filter_normals(false);
  config.set_filter_curvature(false);
  config.set_filter_radius(false);
  method.verifier.set_refine(false);
  return method;
}

}  // namespace declutter::experiments
