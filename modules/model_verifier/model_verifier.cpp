#include "modules/model_verifier/model_verifier.h"

#include <algorithm>
#include <limits>

#include "modules/model_verifier/model_selection.h"

namespace declutter {
namespace {

constexpr double kSupportTolerance = 0.012;  // [m] between a bottom and the top it stands on

// Heights of the ends of a solid above the support plane [m].
double Bottom(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) - 0.5 * solid.height();
}
double Top(const Solid& solid, const Plane& support) {
  return support.Height(solid.X_CO.translation()) + 0.5 * solid.height();
}

// True when the middle part of the upper solid's footprint lies over the lower solid.
bool IsOver(const Solid& upper, const Solid& lower) {
  const SolidCaster caster(lower);
  int num_over = 0;
  for (int i = -1; i <= 1; ++i) {
    for (int j = -1; j <= 1; ++j) {
      const Eigen::Vector3d p_O(0.3 * i * upper.size.x(), 0.3 * j * upper.size.y(), 0);
      const Eigen::Vector3d axis_C = upper.X_CO.linear().col(2);
      const Eigen::Vector3d p_C = upper.X_CO * p_O;
      const Eigen::Vector3d in_lower = p_C - axis_C * axis_C.dot(p_C - lower.X_CO.translation());
      num_over += caster.SignedDistance(in_lower) < 0;
    }
  }
  return num_over >= 3;
}

// Extends solids whose lower end nobody saw down to what they stand on, and notes what each stands
// on. Objects are in the order of their bottoms.
void SettleOnSupports(const Plane& support, std::vector<ObjectModel>* objects) {
  std::stable_sort(objects->begin(), objects->end(),
                   [&](const ObjectModel& a, const ObjectModel& b) {
                     return Top(a.solid, support) < Top(b.solid, support);
                   });
  for (size_t i = 0; i < objects->size(); ++i) {
    ObjectModel& upper = (*objects)[i];
    const double bottom = Bottom(upper.solid, support);
    double floor = 0;
    for (size_t j = 0; j < i; ++j) {
      const ObjectModel& lower = (*objects)[j];
      const double top = Top(lower.solid, support);
      if (top > floor && top < bottom + kSupportTolerance && IsOver(upper.solid, lower.solid)) {
        floor = top;
        upper.supported_by = static_cast<int32_t>(j + 1);
      }
    }
    if (upper.evidence[2] != Evidence::kAssumed) continue;
    const double change = bottom - floor;
    upper.solid.size.z() += change;
    upper.solid.X_CO.translation() -= 0.5 * change * upper.solid.X_CO.linear().col(2);
  }
}

// The label image: each pixel belongs to the object whose surface it fits best; what is seen inside
// an open cylinder belongs to it when nothing else explains it.
void Label(const std::vector<RayEvidence>& evidence, ObjectList* list) {
  list->labels.assign(static_cast<size_t>(list->camera.num_pixels()), 0);
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

double Confidence(const RayEvidence& evidence) {
  const auto explained = static_cast<double>(evidence.explained.size());
  return explained /
         (explained + 2.0 * (evidence.num_violating + evidence.num_contradicting) + 50.0);
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
  const NormalImage normals(frame.image);
  for (const Candidate& candidate :
       SelectModels(config_, hypotheses.hypotheses, frame.image, normals, support)) {
    ObjectModel object;
    object.solid = candidate.hypothesis.solid;
    object.evidence = candidate.hypothesis.evidence;
    object.num_votes = candidate.hypothesis.num_votes;
    list.objects.push_back(object);
  }
  SettleOnSupports(support, &list.objects);
  std::vector<RayEvidence> evidence;
  for (ObjectModel& object : list.objects) {
    evidence.push_back(CastRays(object.solid, frame.image, normals, support));
    object.num_explained = static_cast<int32_t>(evidence.back().explained.size());
    object.num_occluded = evidence.back().num_occluded;
    object.num_violating = evidence.back().num_violating;
    object.confidence = static_cast<float>(Confidence(evidence.back()));
    object.id = static_cast<int32_t>(evidence.size());
  }
  Label(evidence, &list);
  return list;
}

}  // namespace declutter
