#include "tests/benchmark/stages.h"

#include <memory>

#include "modules/codec/codec.h"
#include "modules/feature_estimator/feature_estimator.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/model_verifier/model_verifier.h"
#include "modules/plane_filter/plane_filter.h"
#include "tests/benchmark/pcl_pipeline.h"

namespace declutter::benchmark {
namespace {

constexpr double kLeaf_m = 0.004;
constexpr int kNumThreads = 2;

// Makes one task for each run of a stage over all frames.
class Stages {
 public:
  Stages(const std::string& kind, const std::vector<BenchFrame>& frames)
      : kind_(kind), frames_(frames) {}

  using Run = std::function<void(size_t frame)>;

  Stage Ours(const std::string& name, const std::string& mode, const Run& run) {
    Stage stage;
    stage.name = name;
    stage.mode = mode;
    stage.ours = Add(name + " " + mode, run, false);
    return stage;
  }

  // The name of a task of the competitor.
  std::string Add(const std::string& name, const Run& run, bool is_slow) {
    made_.tasks.push_back({kind_ + " " + name, frames_.size(), run, is_slow});
    return made_.tasks.back().name;
  }

  void Add(const Stage& stage) { made_.stages.push_back(stage); }

  StageTasks Take() { return std::move(made_); }

 private:
  std::string kind_;
  const std::vector<BenchFrame>& frames_;
  StageTasks made_;
};

using PclFrames = std::vector<PclFrame>;

std::shared_ptr<const PclFrames> PclFramesOf(const std::vector<BenchFrame>& frames, double leaf_m) {
  auto made = std::make_shared<PclFrames>();
  for (const BenchFrame& frame : frames) {
    made->emplace_back(frame.depth, frame.tabletop, frame.paper_features, leaf_m);
  }
  return made;
}

template <typename Value>
void Keep(const Value& value) {
  ::benchmark::DoNotOptimize(&value);
}

}  // namespace

StageTasks MakeStageTasks(const std::string& kind, const std::vector<BenchFrame>& frames) {
  Stages stages(kind, frames);
  const auto pcl = PclFramesOf(frames, 0);
  const auto voxels = PclFramesOf(frames, kLeaf_m);
  const auto filter = std::make_shared<PlaneFilter>(PlaneFilterConfig());
  const auto estimator = std::make_shared<FeatureEstimator>(FeatureEstimatorConfig());
  const auto paper_estimator = std::make_shared<FeatureEstimator>(PaperFeatures());
  const HoughSegmenterConfig voting;
  const int num_iterations = voting.num_iterations();
  const auto segmenter = std::make_shared<HoughSegmenter>(voting);
  const auto verifier = std::make_shared<ModelVerifier>(ModelVerifierConfig());

  Stage plane = stages.Ours("plane_filter", "default",
                            [&frames, filter](size_t f) { Keep(filter->Filter(frames[f].depth)); });
  plane.pcl = stages.Add(
      "plane_filter pcl", [pcl](size_t f) { (*pcl)[f].FilterPlane(); }, true);
  plane.pcl_voxels = stages.Add(
      "plane_filter pcl voxels", [voxels](size_t f) { (*voxels)[f].FilterPlane(); }, true);
  stages.Add(plane);

  Stage features = stages.Ours("feature_estimator", "default", [&frames, estimator](size_t f) {
    Keep(estimator->Estimate(frames[f].tabletop));
  });
  features.pcl = stages.Add(
      "feature_estimator pcl", [pcl](size_t f) { (*pcl)[f].EstimateFeatures(1); }, true);
  features.pcl_openmp = stages.Add(
      "feature_estimator pcl openmp", [pcl](size_t f) { (*pcl)[f].EstimateFeatures(kNumThreads); },
      true);
  features.pcl_voxels = stages.Add(
      "feature_estimator pcl voxels", [voxels](size_t f) { (*voxels)[f].EstimateFeatures(1); },
      true);
  stages.Add(features);
  Stage paper_features =
      stages.Ours("feature_estimator", "paper", [&frames, paper_estimator](size_t f) {
        Keep(paper_estimator->Estimate(frames[f].tabletop));
      });
  paper_features.pcl = features.pcl;
  paper_features.pcl_openmp = features.pcl_openmp;
  paper_features.pcl_voxels = features.pcl_voxels;
  stages.Add(paper_features);

  Stage segment = stages.Ours("hough_segmenter", "default", [&frames, segmenter](size_t f) {
    Keep(segmenter->Segment(frames[f].tabletop, frames[f].features));
  });
  segment.pcl = stages.Add(
      "hough_segmenter pcl", [pcl, num_iterations](size_t f) { (*pcl)[f].Segment(num_iterations); },
      true);
  segment.pcl_voxels = stages.Add(
      "hough_segmenter pcl voxels",
      [voxels, num_iterations](size_t f) { (*voxels)[f].Segment(num_iterations); }, true);
  stages.Add(segment);

  stages.Add(stages.Ours("model_verifier", "default", [&frames, verifier](size_t f) {
    Keep(verifier->Verify(frames[f].depth, frames[f].hypotheses));
  }));
  stages.Add(stages.Ours(kWholeFrame, "default", [=, &frames](size_t f) {
    const DepthFrame& depth = frames[f].depth;
    const Tabletop& tabletop = filter->Filter(depth);
    const FeatureCloud& cloud = estimator->Estimate(tabletop);
    Keep(verifier->Verify(depth, segmenter->Segment(tabletop, cloud)));
  }));

  stages.Add(stages.Ours("depth_frame encode", "default",
                         [&frames](size_t f) { Keep(codec::Encode(frames[f].depth)); }));
  const auto messages = std::make_shared<std::vector<depth_frame_t>>();
  for (const BenchFrame& frame : frames) messages->push_back(codec::Encode(frame.depth));
  stages.Add(stages.Ours("depth_frame decode", "default",
                         [messages](size_t f) { Keep(codec::Decode((*messages)[f])); }));
  return stages.Take();
}

}  // namespace declutter::benchmark
