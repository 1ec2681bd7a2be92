#include "modules/model_verifier/model_verifier.h"

#include <algorithm>
#include <cmath>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/confidence.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/systematic_misfit.h"
#include "modules/model_verifier/uncertainty.h"

namespace declutter {
namespace {

// [px] between the pixels that models are selected by; what is selected is measured with all.
constexpr int kSelectionStep = 2;

// In [0, 1]: how much of the confidence in a cylinder the shape of its side leaves. None where the
// side is clearly tapered, as that of a bowl is; less where its radius changes with height by more
// than noise.
double ShareOfSide(const Solid& cylinder, const RayEvidence& evidence, const DepthImage& image) {
  // 6 degrees. The distortion of a sensor tilts 5 cm of a surface by 2.4 (rms).
  constexpr double kMaxTaper = 0.1;
  // Whose noise is that of one independent sample, in all six layers.
  constexpr double kPixelsPerLayer = 6 * 36;
  const double sigma = MeasurementSigma(cylinder.X_CO.translation().z());
  const Eigen::Isometry3d X_OC = cylinder.X_CO.inverse();
  std::vector<Eigen::Vector3d> points_O;
  for (const auto& pixel : evidence.explained) {
    points_O.push_back(
        X_OC * image.PointAt(pixel.pixel % image.camera.width, pixel.pixel / image.camera.width));
  }
  const Taper taper = TaperOf(cylinder, points_O, sigma);
  if (std::abs(taper.slope) - 2 * taper.sd > kMaxTaper) return 0;
  const double misfit = LayerMisfit(cylinder, points_O) / sigma;
  const double noise = kPixelsPerLayer / std::max(1.0, static_cast<double>(points_O.size()));
  return 1 - MisfitShare(std::sqrt(std::max(0.0, misfit * misfit - noise)));
}

// Fills the empty label image: each pixel belongs to the object whose surface it fits best; what is
// seen inside an open cylinder belongs to it when nothing else explains it.
void Label(const std::vector<RayEvidence>& evidence, ObjectList* list) {
  std::vector<float> best(list->labels.size(), 0);
  for (size_t i = 0; i < evidence.size(); ++i) {
    for (const auto& pixel : evidence[i].explained) {
      const auto p = static_cast<size_t>(pixel.pixel);
      if (pixel.fit <= best[p]) continue;
      best[p] = pixel.fit;
      list->labels[p] = static_cast<uint8_t>(i + 1);
    }
  }
  for (size_t i = 0; i < evidence.size(); ++i) {
    for (int pixel : evidence[i].hollow) {
      uint8_t& label = list->labels[static_cast<size_t>(pixel)];
      if (label == 0) label = static_cast<uint8_t>(i + 1);
    }
  }
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
  const NormalLookup normals(frame.image);
  const Observation observation{frame.image, normals, support};
  const Observation coarse{frame.image, normals, support, kSelectionStep};
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
  for (size_t i = 0; i < list.objects.size(); ++i) {
    ObjectModel& object = list.objects[i];
    object.confidence = static_cast<float>(Confidence(
        object, evidence[i], NumUnexplained(object.solid, frame.image, support, list.labels)));
    if (object.solid.shape == Shape::kCylinder) {
      object.confidence *= static_cast<float>(ShareOfSide(object.solid, evidence[i], frame.image));
    }
    const SolidEnds ends = EndsOf(object.solid, object.evidence, evidence[i], coarse);
    object.evidence = ExtentEvidence(ends);
    object.covariance = CovarianceOf(object.solid, ends, evidence[i], observation);
  }
  DropUncertain(config_.min_confidence(), &list);
  return list;
}

}  // namespace declutter
