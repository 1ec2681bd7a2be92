#pragma once

#include <string>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/model_verifier/model_verifier.pb.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "tests/accuracy/matching.h"
#include "tests/accuracy/scene_truth.h"

namespace declutter::experiments {

// A frame up to where methods differ, beside what is true. What one process hands to the next has
// been through its message, so that results are those of the graph.
struct PreparedFrame {
  accuracy::SceneTruth truth;
  DepthFrame depth;
  Tabletop tabletop;
  FeatureCloud features;
};
PreparedFrame Prepare(const RenderedScene& scene, FeatureMode mode);

// How objects are found in a prepared frame.
struct Method {
  std::string name;
  HoughSegmenterConfig segmenter;
  SideDetector detect = DetectSides;
  ModelVerifierConfig verifier;
};

struct Result {
  size_t num_hypotheses = 0;
  size_t num_right_hypotheses = 0;  // centre and extents within 20 mm of a true object
  ObjectList found;
  accuracy::FrameScore score;
};
Result RunMethod(const Method& method, const PreparedFrame& frame);

// Votes and filters, the solids left as the votes have them.
Method VotingAlone();
// The same with the solids fitted to their points: what the graph does.
Method Voting();
// 'Original': the fits of one iteration that draws as many samples as all iterations of voting do,
// without the filters of section 5, the solids left as they are.
Method SingleShot();

}  // namespace declutter::experiments
