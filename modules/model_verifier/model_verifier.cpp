#include "modules/model_verifier/model_verifier.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "modules/geometry/sensor_noise.h"
#include "modules/model_verifier/column.h"
#include "modules/model_verifier/confidence.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/hidden_ends.h"
#include "modules/model_verifier/noise_level.h"
#include "modules/model_verifier/refinement.h"
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

// What is seen inside an open cylinder belongs to it when nothing else explains it.
void LabelHollow(const std::vector<RayEvidence>& evidence, ObjectList* list) {
  for (size_t i = 0; i < list->objects.size(); ++i) {
    for (int32_t pixel : evidence[i].hollow) {
      uint8_t& label = list->labels[static_cast<size_t>(pixel)];
      if (label == 0) label = static_cast<uint8_t>(i + 1);
    }
  }
}

// How many objects explain each pixel.
void CountExplaining(const std::vector<RayEvidence>& evidence, size_t num_objects,
                     size_t num_pixels, std::vector<uint8_t>* num) {
  num->assign(num_pixels, 0);
  for (size_t i = 0; i < num_objects; ++i) {
    for (const int32_t pixel : evidence[i].explained) ++(*num)[static_cast<size_t>(pixel)];
  }
}

// True when enough speaks for an object in its final place that speaks for no other, and it is not
// mostly others that the rest speaks for; of one of which no extent is seen, twice as much must be
// seen at all.
bool IsSupported(const ObjectModel& object, const RayEvidence& evidence,
                 const std::vector<uint8_t>& num_explaining, double min_px) {
  constexpr double kMinOwnShare = 0.4;  // of what speaks for it
  const double balance = FitAlone(evidence, num_explaining, 1) - evidence.num_violating -
                         evidence.num_contradicting - NumOverhangingAlone(evidence, num_explaining);
  const bool is_seen = std::any_of(object.evidence.begin(), object.evidence.end(),
                                   [](Evidence extent) { return extent != Evidence::kAssumed; });
  return balance >= std::max(min_px, kMinOwnShare * evidence.Fit()) &&
         (is_seen || evidence.num_explained() >= 2 * min_px);
}

// Takes the pixels of objects out of a grid of all pixels.
void RemoveLabelled(const std::vector<uint8_t>& labels, PixelGrid* grid) {
  for (int v = 0; v < grid->rows; ++v) {
    float* z = &grid->z[static_cast<size_t>(v) * grid->stride];
    const uint8_t* label = &labels[static_cast<size_t>(v) * static_cast<size_t>(grid->columns)];
    for (int u = 0; u < grid->columns; ++u) z[u] = label[u] == 0 ? z[u] : 0;
  }
}

// Renumbers what is left after objects below the least confidence are gone.
void DropUncertain(double min_confidence, ObjectList* list) {
  std::array<uint8_t, 256> new_id = {};
  size_t num_kept = 0;
  for (const ObjectModel& object : list->objects) {
    if (object.confidence < min_confidence) continue;
    new_id[static_cast<size_t>(object.id)] = static_cast<uint8_t>(num_kept + 1);
    list->objects[num_kept++] = object;
  }
  list->objects.resize(num_kept);
  for (ObjectModel& object : list->objects) {
    object.id = new_id[static_cast<size_t>(object.id)];
    object.supported_by = new_id[static_cast<size_t>(object.supported_by)];
  }
  for (uint8_t& label : list->labels) label = new_id[label];
}

}  // namespace

ModelVerifier::ModelVerifier(const ModelVerifierConfig& config)
    : config_(config), selection_(config) {}

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
  LabelPixels(&list);
  Measure(&list);
  CompleteBoxes(&list);
  DropUncertain(config_.min_confidence(), &list);
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

void ModelVerifier::LabelPixels(ObjectList* list) {
  const Observation observation = observed_.every_pixel();
  const size_t num = list->objects.size();
  if (evidence_.size() < num) evidence_.resize(num);
  for (size_t i = 0; i < num; ++i) {
    ObjectModel& object = list->objects[i];
    CastRays(object.solid, observation, &evidence_[i]);
    object.num_explained = evidence_[i].num_explained();
    object.num_occluded = evidence_[i].num_occluded;
    object.num_violating = evidence_[i].num_violating;
    object.id = static_cast<int32_t>(i + 1);
  }
  of_objects_.clear();
  for (size_t i = 0; i < num; ++i) of_objects_.push_back(&evidence_[i]);
  owners_.Assign(of_objects_, observation.grid.num_pixels());
  list->labels = owners_.owners();
  LabelHollow(evidence_, list);
}

void ModelVerifier::Measure(ObjectList* list) {
  const Observation observation = observed_.every_pixel();
  const size_t num = list->objects.size();
  CountExplaining(evidence_, num, list->labels.size(), &num_explaining_);
  unlabelled_ = observation.grid;
  RemoveLabelled(list->labels, &unlabelled_);
  const Observation unlabelled{observation.image, unlabelled_, observation.normals,
                               observation.support};
  noise_level_ = NoiseLevel(observation, &deviations_);
  ends_.resize(num);
  for (size_t i = 0; i < num; ++i) {
    ObjectModel& object = list->objects[i];
    std::vector<Eigen::Vector3d>& points_O = buffers_.explained_O;
    FindExplainedPoints(object.solid, evidence_[i], observation, &points_O);
    const bool is_top_seen = IsTopSeen(object.solid, points_O, evidence_[i].pixel_weight);
    object.confidence = static_cast<float>(
        Confidence(object, evidence_[i], NumUnexplained(object.solid, is_top_seen, unlabelled)));
    ends_[i] = EndsOf(object.solid, object.evidence, evidence_[i], points_O,
                      observed_.every_second_pixel(), &buffers_.evidence);
    object.evidence = ExtentEvidence(ends_[i]);
    if (object.solid.shape == Shape::kCylinder) {
      object.confidence *= static_cast<float>(ShareOfSide(object.solid, points_O));
      object.covariance = CovarianceOfCylinder(
          object.solid,
          VariancesOf(object.solid, ends_[i], object.num_explained, list->camera, noise_level_),
          points_O, evidence_[i].pixel_weight, noise_level_);
    }
    if (!IsSupported(object, evidence_[i], num_explaining_, config_.min_explained_px())) {
      object.confidence = 0;
    }
  }
}

void ModelVerifier::CompleteBoxes(ObjectList* list) {
  for (size_t i = 0; i < list->objects.size(); ++i) {
    ObjectModel& object = list->objects[i];
    if (object.solid.shape != Shape::kBox || object.confidence < config_.min_confidence()) continue;
    const Solid seen = object.solid;
    EndVariances variances =
        VariancesOf(seen, ends_[i], object.num_explained, list->camera, noise_level_);
    FindOthers(i, *list);
    CompleteHiddenEnds(ends_[i], others_, observed_.every_second_pixel(), &object.solid, &variances,
                       &buffers_.evidence);
    object.covariance = CovarianceOfBox(seen, ends_[i], variances, list->camera, noise_level_);
  }
}

// Makes others_ the solids of all objects that will be reported but one.
void ModelVerifier::FindOthers(size_t index, const ObjectList& list) {
  others_.clear();
  for (size_t i = 0; i < list.objects.size(); ++i) {
    if (i == index || list.objects[i].confidence < config_.min_confidence()) continue;
    others_.push_back(list.objects[i].solid);
  }
}

}  // namespace declutter
