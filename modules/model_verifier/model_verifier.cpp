#include "modules/model_verifier/model_verifier.h"

#include <algorithm>

#include "modules/model_verifier/confidence.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/uncertainty.h"

namespace declutter {
namespace {

// Fills the empty label image: each pixel belongs to the object whose surface it fits best; what is
// seen inside an open cylinder belongs to it when nothing else explains it.
void Label(const std::vector<RayEvidence>& evidence, ObjectList* list) {
  std::vector<int32_t> best(list->labels.size(), 0);  // in kFitUnit
  for (size_t i = 0; i < evidence.size(); ++i) {
    for (size_t k = 0; k < evidence[i].explained.size(); ++k) {
      const auto pixel = static_cast<size_t>(evidence[i].explained[k]);
      if (evidence[i].fits[k] <= best[pixel]) continue;
      best[pixel] = evidence[i].fits[k];
      list->labels[pixel] = static_cast<uint8_t>(i + 1);
    }
  }
  for (size_t i = 0; i < evidence.size(); ++i) {
    for (int32_t pixel : evidence[i].hollow) {
      uint8_t& label = list->labels[static_cast<size_t>(pixel)];
      if (label == 0) label = static_cast<uint8_t>(i + 1);
    }
  }
}

// The grid of all pixels without those of objects.
PixelGrid WithoutLabelled(PixelGrid grid, const std::vector<uint8_t>& labels) {
  for (int v = 0; v < grid.rows; ++v) {
    float* z = &grid.z[static_cast<size_t>(v) * grid.stride];
    const uint8_t* label = &labels[static_cast<size_t>(v) * static_cast<size_t>(grid.columns)];
    for (int u = 0; u < grid.columns; ++u) z[u] = label[u] == 0 ? z[u] : 0;
  }
  return grid;
}

// Renumbers what is left after objects below the least confidence are gone.
void DropUncertain(double min_confidence, ObjectList* list) {
  std::vector<uint8_t> new_id(list->objects.size() + 1, 0);
  std::vector<ObjectModel> kept;
  for (const ObjectModel& object : list->objects) {
    if (object.confidence < min_confidence) continue;
    new_id[static_cast<size_t>(object.id)] = static_cast<uint8_t>(kept.size() + 1);
    kept.push_back(object);
  }
  for (ObjectModel& object : kept) {
    object.id = new_id[static_cast<size_t>(object.id)];
    object.supported_by = new_id[static_cast<size_t>(object.supported_by)];
  }
  for (uint8_t& label : list->labels) label = new_id[label];
  list->objects = std::move(kept);
}

}  // namespace

ModelVerifier::ModelVerifier(const ModelVerifierConfig& config) : config_(config) {}

ObjectList ModelVerifier::Verify(const DepthFrame& frame, const HypothesisList& hypotheses) const {
  ObjectList list;
  list.header = frame.header;
  list.mode = hypotheses.mode;
  list.camera = frame.image.camera;
  list.X_WC = frame.X_WC;
  list.planes = hypotheses.planes;
  list.labels.assign(static_cast<size_t>(list.camera.num_pixels()), 0);
  if (list.planes.empty() || frame.image.empty()) return list;

  const Plane& support = list.planes[0];
  ObservedImage observed;
  observed.Set(frame.image, support);
  // Models are selected by every second pixel; what is selected is measured with all.
  const Observation observation = observed.every_pixel();
  const Observation coarse = observed.every_second_pixel();
  for (Candidate& candidate : SelectModels(config_, hypotheses.hypotheses, coarse)) {
    ObjectModel object;
    object.solid = candidate.hypothesis.solid;
    if (config_.refine()) {
      RefineIfNoWorse(observation, coarse, &object.solid, &candidate.evidence);
    }
    object.evidence = candidate.hypothesis.evidence;
    object.num_votes = candidate.hypothesis.num_votes;
    list.objects.push_back(object);
  }
  SettleOnSupports(coarse, &list.objects);
  std::vector<RayEvidence> evidence;
  for (ObjectModel& object : list.objects) {
    evidence.push_back(CastRays(object.solid, observation));
    object.num_explained = evidence.back().num_explained();
    object.num_occluded = evidence.back().num_occluded;
    object.num_violating = evidence.back().num_violating;
    object.id = static_cast<int32_t>(evidence.size());
  }
  Label(evidence, &list);
  const PixelGrid unlabelled_grid = WithoutLabelled(observation.grid, list.labels);
  const Observation unlabelled{frame.image, unlabelled_grid, observation.normals, support};
  for (size_t i = 0; i < list.objects.size(); ++i) {
    ObjectModel& object = list.objects[i];
    object.confidence = static_cast<float>(
        Confidence(object, evidence[i], NumUnexplained(object.solid, unlabelled)));
    const SolidEnds ends = EndsOf(object.solid, object.evidence, evidence[i], coarse);
    object.evidence = ExtentEvidence(ends);
    object.covariance = CovarianceOf(object.solid, ends, evidence[i], observation);
  }
  DropUncertain(config_.min_confidence(), &list);
  return list;
}

}  // namespace declutter
