#pragma once

#include <string>
#include <vector>

#include "modules/feature_estimator/feature_estimator.pb.h"
#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"
#include "modules/scene_renderer/scene_renderer.h"

namespace declutter::benchmark {

// A frame with what every stage gets.
struct BenchFrame {
  DepthFrame depth;
  Tabletop tabletop;
  FeatureCloud features;        // default mode
  FeatureCloud paper_features;  // with PaperFeatures()
  HypothesisList hypotheses;
};

// Normals and RSD with a radius of 20 mm: the work of the competitor.
FeatureEstimatorConfig PaperFeatures();

BenchFrame MakeFrame(const DepthFrame& depth);
BenchFrame MakeFrame(const RenderedScene& scene);

// Scenes of 17 objects in dense clutter, with the noise of a real sensor.
std::vector<BenchFrame> RenderedFrames(int num);

// From the folder of recordings in the environment variable DECLUTTER_DATA; none without it.
std::vector<BenchFrame> RecordedFrames(int num);

}  // namespace declutter::benchmark
