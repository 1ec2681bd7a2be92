#include "modules/model_verifier/model_verifier.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/column.h"
#include "modules/model_verifier/confidence.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/hidden_ends.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/systematic_misfit.h"
#include "modules/model_verifier/uncertainty.h"

namespace declutter {
namespace {

// In [0, 1]: how much of the confidence in a cylinder the shape of its side leaves. None where the
// side is clearly tapered, as that of a bowl is; less where its radius changes with height by more
// than noise.
double ShareOfSide(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O) {
  // 6 degrees. The distortion of a sensor tilts 5 cm of a surface by 2.4 (rms).
  constexpr double kMaxTaper = 0.1;
  // Whose noise is that of one independent sample, in all six layers.
  constexpr double kPixelsPerLayer = 6 * 36;
  const double sigma = MeasurementSigma(cylinder.X_CO.translation().z());
  const Taper taper = TaperOf(cylinder, points_O, sigma);
  if (std::abs(taper.slope) - 2 * taper.sd > kMaxTaper) return 0;
  const double misfit = LayerMisfit(cylinder, points_O) / sigma;
  const double noise = kPixelsPerLayer / std::max(1.0, static_cast<double>(points_O.size()));
  return 1 - MisfitShare(std::sqrt(std::max(0.0, misfit * misfit - noise)));
}

// Takes the pixels of objects, and what is seen inside open cylinders, out of a grid of all pixels.
void RemoveExplained(const std::vector<RayEvidence>& evidence, size_t num_objects,
                     PixelGrid* grid) {
  for (size_t i = 0; i < num_objects; ++i) {
    for (const auto* pixels : {&evidence[i].explained, &evidence[i].hollow}) {
      for (const int32_t pixel : *pixels) grid->z[grid->Index(pixel)] = 0;
    }
  }
}

}  // namespace

ModelVerifier::ModelVerifier(const ModelVerifierConfig& config)
    : config_(config), selection_(config), supported_objects_(config) {}

ObjectList ModelVerifier::Verify(const DepthFrame& frame, const HypothesisList& hypotheses) {
  ObjectList list;
  list.header = frame.header;
  list.mode = hypotheses.mode;
  list.camera = frame.image.camera;
  list.X_WC = frame.X_WC;
  list.planes = hypotheses.planes;
  list.labels.assign(static_cast<size_t>(list.camera.num_pixels()), 0);
  if (list.planes.empty() || frame.image.empty() || hypotheses.hypotheses.empty()) return list;

  observed_.Set(frame.image, list.planes[0]);
  // Models are selected by every second pixel; what is selected is measured with all.
  Select(hypotheses.hypotheses, observed_.every_second_pixel(), &list.objects);
  settler_.Settle(observed_.every_second_pixel(), &list.objects);
  if (config_.refine()) RefineExtended(&list.objects);
  Measure(&list);
  DropDoubtful(&list.objects);
  LabelPixels(&list);
  CompleteBoxes(&list);
  return list;
}

void ModelVerifier::Select(const std::vector<Hypothesis>& hypotheses,
                           const Observation& observation, std::vector<ObjectModel>* objects) {
  selection_.Run(hypotheses, observation, &buffers_);
  selected_.clear();
  for (const size_t i : selection_.selected()) selected_.push_back(&selection_.candidate(i));
  if (config_.refine()) fits_.Run(observed_, selected_, &buffers_);
  objects->reserve(selected_.size());
  for (const Candidate* candidate : selected_) {
    ObjectModel& object = objects->emplace_back();
    object.solid = candidate->hypothesis.solid;
    object.evidence = candidate->hypothesis.evidence;
    object.num_votes = candidate->hypothesis.num_votes;
  }
}

void ModelVerifier::RefineExtended(std::vector<ObjectModel>* objects) {
  constexpr double kMinNewPart = 0.5;  // of its height
  const Observation observation = observed_.every_second_pixel();
  for (size_t i = 0; i < objects->size(); ++i) {
    Solid* const solid = &(*objects)[i].solid;
    if (settler_.growth()[i] < kMinNewPart * solid->height() ||
        !IsUpright(*solid, observation.support)) {
      continue;
    }
    CastRays(*solid, observation, &extended_);
    RefineIfNoWorse(observation, observation, solid, &extended_, &buffers_);
  }
}

void ModelVerifier::Measure(ObjectList* list) {
  const Observation observation = observed_.every_pixel();
  const size_t num = list->objects.size();
  if (evidence_.size() < num) evidence_.resize(num);
  for (size_t i = 0; i < num; ++i) {
    CastRays(list->objects[i].solid, observation, &evidence_[i]);
  }
  unexplained_ = observation.grid;
  RemoveExplained(evidence_, num, &unexplained_);
  const Observation unexplained = observation.At(unexplained_);
  const double noise_level = observation.noise.level;
  ends_.resize(num);
  for (size_t i = 0; i < num; ++i) {
    ObjectModel& object = list->objects[i];
    object.num_explained = evidence_[i].num_explained();
    object.num_occluded = evidence_[i].num_occluded;
    object.num_violating = evidence_[i].num_violating;
    std::vector<Eigen::Vector3d>& points_O = buffers_.explained_O;
    FindExplainedPoints(object.solid, evidence_[i], observation, &points_O);
    const bool is_top_seen = IsTopSeen(object.solid, points_O, evidence_[i].pixel_weight);
    object.confidence = static_cast<float>(
        Confidence(object, evidence_[i], NumUnexplained(object.solid, is_top_seen, unexplained),
                   observation.support));
    ends_[i] = EndsOf(object.solid, object.evidence, evidence_[i], points_O,
                      observed_.every_second_pixel(), &buffers_.evidence);
    object.evidence = ExtentEvidence(ends_[i]);
    if (object.solid.shape == Shape::kCylinder) {
      object.confidence *= static_cast<float>(ShareOfSide(object.solid, points_O));
      object.covariance = CovarianceOfCylinder(
          object.solid,
          VariancesOf(object.solid, ends_[i], object.num_explained, list->camera, noise_level),
          points_O, evidence_[i].pixel_weight, noise_level);
    }
  }
}

void ModelVerifier::DropDoubtful(std::vector<ObjectModel>* objects) {
  const std::vector<uint8_t>& is_kept =
      supported_objects_.Find(*objects, evidence_, observed_.every_pixel().grid.num_pixels());
  new_ids_.assign(objects->size() + 1, 0);
  size_t num_kept = 0;
  for (size_t i = 0; i < objects->size(); ++i) {
    if (!is_kept[i]) continue;
    (*objects)[num_kept] = (*objects)[i];
    ends_[num_kept] = ends_[i];
    if (num_kept != i) std::swap(evidence_[num_kept], evidence_[i]);
    new_ids_[i + 1] = static_cast<int32_t>(++num_kept);
  }
  objects->resize(num_kept);
  for (size_t i = 0; i < num_kept; ++i) {
    ObjectModel& object = (*objects)[i];
    object.id = static_cast<int32_t>(i + 1);
    object.supported_by = new_ids_[static_cast<size_t>(object.supported_by)];
  }
}

void ModelVerifier::LabelPixels(ObjectList* list) {
  of_objects_.clear();
  for (size_t i = 0; i < list->objects.size(); ++i) of_objects_.push_back(&evidence_[i]);
  owners_.Assign(of_objects_, observed_.every_pixel().grid.num_pixels());
  list->labels = owners_.owners();
  // What is seen inside an open cylinder belongs to it when nothing else explains it.
  for (size_t i = 0; i < list->objects.size(); ++i) {
    for (int32_t pixel : evidence_[i].hollow) {
      uint8_t& label = list->labels[static_cast<size_t>(pixel)];
      if (label == 0) label = static_cast<uint8_t>(i + 1);
    }
  }
}

void ModelVerifier::CompleteBoxes(ObjectList* list) {
  const Observation observation = observed_.every_second_pixel();
  for (size_t i = 0; i < list->objects.size(); ++i) {
    ObjectModel& object = list->objects[i];
    if (object.solid.shape != Shape::kBox) continue;
    const Solid seen = object.solid;
    EndVariances variances =
        VariancesOf(seen, ends_[i], object.num_explained, list->camera, observation.noise.level);
    FindOthers(i, *list);
    CompleteHiddenEnds(ends_[i], others_, observation, &object.solid, &variances,
                       &buffers_.evidence);
    object.covariance =
        CovarianceOfBox(seen, ends_[i], variances, list->camera, observation.noise.level);
  }
}

// Makes others_ the solids of all objects but one.
void ModelVerifier::FindOthers(size_t index, const ObjectList& list) {
  others_.clear();
  for (size_t i = 0; i < list.objects.size(); ++i) {
    if (i != index) others_.push_back(list.objects[i].solid);
  }
}

}  // namespace declutter
