#include "modules/model_verifier/model_verifier.h"

#include <algorithm>
#include <limits>

#include "modules/model_verifier/model_selection.h"

namespace declutter {
namespace {

constexpr double kUnexplainedReach = 0.020;  // [m] from a solid to points that it should explain
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

// Points above the support within reach of a solid that no object explains: where there are many,
// something else stands there than a box or an upright cylinder.
int NumUnexplained(const Solid& solid, const DepthImage& image, const Plane& support,
                   const std::vector<uint8_t>& labels) {
  const PixelWindow window = ProjectionWindow(solid, kUnexplainedReach, image.camera);
  const SolidCaster caster(solid);
  int num = 0;
  for (int v = window.v_begin; v < window.v_end; ++v) {
    for (int u = window.u_begin; u < window.u_end; ++u) {
      const double z = image.DepthAt(u, v);
      if (z <= 0 || labels[static_cast<size_t>(v * image.camera.width + u)] != 0) continue;
      const Eigen::Vector3d p_C = image.camera.Ray(u, v) * z;
      num += caster.SignedDistance(p_C) < kUnexplainedReach &&
             support.Height(p_C) > 1.5 * SurfaceTolerance(z);
    }
  }
  return num;
}

// Mean fit of the explained pixels, times their share of all pixels that speak for or against the
// solid.
double Confidence(const RayEvidence& evidence, int num_unexplained) {
  double fit = 0;
  for (const auto& pixel : evidence.explained) fit += pixel.fit;
  const auto num_explained = static_cast<double>(evidence.explained.size());
  return fit / std::max(1.0, num_explained + evidence.num_violating + evidence.num_contradicting +
                                 num_unexplained);
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
    object.id = static_cast<int32_t>(evidence.size());
  }
  Label(evidence, &list);
  for (size_t i = 0; i < list.objects.size(); ++i) {
    ObjectModel& object = list.objects[i];
    object.confidence = static_cast<float>(
        Confidence(evidence[i], NumUnexplained(object.solid, frame.image, support, list.labels)));
  }
  DropUncertain(config_.min_confidence(), &list);
  return list;
}

}  // namespace declutter
