#include "tests/benchmark/bench_frame.h"

#include <cstdlib>
#include <filesystem>

#include "modules/feature_estimator/feature_estimator.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/kinect_source/recording_reader.h"
#include "modules/plane_filter/plane_filter.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter::benchmark {

FeatureEstimatorConfig PaperFeatures() {
  FeatureEstimatorConfig config;
  config.set_mode("paper");
  config.set_paper_normal_radius_m(0.020);
  config.set_rsd_radius_m(0.020);
  return config;
}

BenchFrame MakeFrame(const DepthFrame& depth) {
  BenchFrame frame;
  frame.depth = depth;
  frame.tabletop = PlaneFilter(PlaneFilterConfig()).Filter(frame.depth);
  frame.features = FeatureEstimator(FeatureEstimatorConfig()).Estimate(frame.tabletop);
  frame.paper_features = FeatureEstimator(PaperFeatures()).Estimate(frame.tabletop);
  frame.hypotheses = HoughSegmenter(HoughSegmenterConfig()).Segment(frame.tabletop, frame.features);
  return frame;
}

BenchFrame MakeFrame(const RenderedScene& scene) {
  DepthFrame depth;
  depth.header.frame = "scene";
  depth.image = scene.depth;
  return MakeFrame(depth);
}

std::vector<BenchFrame> RenderedFrames(int num) {
  std::vector<BenchFrame> frames;
  for (int seed = 1; seed <= num; ++seed) {
    frames.push_back(
        MakeFrame(Render(ParseScene("clutter {}", "clutter"), static_cast<uint64_t>(seed))));
  }
  return frames;
}

std::vector<BenchFrame> RecordedFrames(int num) {
  std::vector<BenchFrame> frames;
  const char* data = std::getenv("DECLUTTER_DATA");
  if (data == nullptr || !std::filesystem::is_directory(data)) return frames;
  KinectSourceConfig config;
  config.set_input(data);
  RecordingReader reader(config);
  const size_t step = reader.num_frames() / static_cast<size_t>(num + 1) + 1;
  for (size_t i = 1; const auto recorded = reader.Next(); ++i) {
    if (i % step == 0 && recorded->depth.header.error.empty()) {
      frames.push_back(MakeFrame(recorded->depth));
    }
  }
  return frames;
}

}  // namespace declutter::benchmark
