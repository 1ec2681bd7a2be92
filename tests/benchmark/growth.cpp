#include "tests/benchmark/growth.h"

#include "modules/feature_estimator/feature_estimator.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/model_verifier/model_verifier.h"
#include "modules/plane_filter/plane_filter.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter::benchmark {
namespace {

RenderedScene RenderText(const std::string& text) { return Render(ParseScene(text, "scene"), 1); }

HoughSegmenterConfig WithIterations(int num_iterations) {
  HoughSegmenterConfig config;
  config.set_num_iterations(num_iterations);
  return config;
}

// Adds a row for frame number f and the task of voting.
void AddRow(const std::string& value, size_t f, int num_iterations, Growth* growth) {
  const auto frames = growth->frames;
  const std::string prefix = growth->with + " " + value + " ";
  GrowthRow row;
  row.value = value;
  row.num_object_points = (*frames)[f].tabletop.num_object_points;
  row.segment = prefix + "hough_segmenter";
  const auto segmenter = std::make_shared<HoughSegmenter>(WithIterations(num_iterations));
  growth->tasks.push_back({row.segment, 1, [frames, f, segmenter](size_t) {
                             segmenter->Segment((*frames)[f].tabletop, (*frames)[f].features);
                           }});
  growth->rows.push_back(row);
}

void AddWholeRow(const std::string& value, size_t f, Growth* growth) {
  AddRow(value, f, HoughSegmenterConfig().num_iterations(), growth);
  const auto frames = growth->frames;
  const std::string prefix = growth->with + " " + value + " ";
  GrowthRow& row = growth->rows.back();
  row.plane = prefix + "plane_filter";
  const auto filter = std::make_shared<PlaneFilter>(PlaneFilterConfig());
  growth->tasks.push_back(
      {row.plane, 1, [frames, f, filter](size_t) { filter->Filter((*frames)[f].depth); }});
  row.features = prefix + "feature_estimator";
  const auto estimator = std::make_shared<FeatureEstimator>(FeatureEstimatorConfig());
  growth->tasks.push_back({row.features, 1, [frames, f, estimator](size_t) {
                             estimator->Estimate((*frames)[f].tabletop);
                           }});
  row.verify = prefix + "model_verifier";
  const auto verifier = std::make_shared<ModelVerifier>(ModelVerifierConfig());
  growth->tasks.push_back({row.verify, 1, [frames, f, verifier](size_t) {
                             verifier->Verify((*frames)[f].depth, (*frames)[f].hypotheses);
                           }});
}

}  // namespace

Growth GrowthWithObjects() {
  const std::string loose =
      " min_touching_pairs: 0 num_stacked: 0 min_half_hidden: 0 max_median_gap_m: 10"
      " max_gap_m: 0.1 min_visible_px: 100 }";
  const std::vector<std::pair<std::string, std::string>> scenes = {
      {"1", "object { box { size_x_m: 0.12 size_y_m: 0.08 size_z_m: 0.15 } y_m: 0.64 }"},
      {"5", "clutter { num_boxes: 3 num_cylinders: 2" + loose},
      {"17", "clutter { num_boxes: 11 num_cylinders: 6" + loose},
      {"40", "clutter { num_boxes: 26 num_cylinders: 14 extent_x_m: 1 extent_y_m: 0.8" + loose},
  };
  auto frames = std::make_shared<std::vector<BenchFrame>>();
  for (const auto& [value, text] : scenes) frames->push_back(MakeFrame(RenderText(text)));
  Growth growth{"objects", {}, {}, frames};
  for (size_t f = 0; f < scenes.size(); ++f) AddWholeRow(scenes[f].first, f, &growth);
  return growth;
}

Growth GrowthWithImageSize() {
  const std::vector<std::pair<std::string, int>> sizes = {
      {"320x240", 320}, {"640x480", 640}, {"1280x960", 1280}};
  // The same scene each time.
  Scene scene = RenderText("clutter {}").scene;
  auto frames = std::make_shared<std::vector<BenchFrame>>();
  for (const auto& [value, width] : sizes) {
    const double scale = width / 640.0;
    SceneCamera* camera = scene.mutable_camera();
    camera->set_width(width);
    camera->set_height(width * 3 / 4);
    camera->set_fx(scale * 525);
    camera->set_fy(scale * 525);
    camera->clear_cx();
    camera->clear_cy();
    frames->push_back(MakeFrame(Render(scene, 1)));
  }
  Growth growth{"image", {}, {}, frames};
  for (size_t f = 0; f < sizes.size(); ++f) AddWholeRow(sizes[f].first, f, &growth);
  return growth;
}

Growth GrowthWithIterations() {
  auto frames = std::make_shared<std::vector<BenchFrame>>(RenderedFrames(1));
  Growth growth{"I", {}, {}, frames};
  for (const int num_iterations : {5, 10, 15, 25, 50, 75, 100, 125, 150}) {
    AddRow(std::to_string(num_iterations), 0, num_iterations, &growth);
  }
  return growth;
}

}  // namespace declutter::benchmark
