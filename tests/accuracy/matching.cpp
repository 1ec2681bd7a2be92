#include "tests/accuracy/matching.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/accuracy/pixel_overlap.h"
#include "tests/accuracy/solid_comparison.h"

namespace declutter::accuracy {
namespace {

constexpr double kDegree = M_PI / 180;
constexpr double kMinIou = 0.5;
constexpr int kSeedReachPx = 3;
constexpr double kMaxUprightTilt = 20 * kDegree;
constexpr double kMinLyingTilt = 60 * kDegree;
// Models of standing boxes follow the support normal closely; only a fit to a leaning box departs.
constexpr double kMinLeaningTilt = 5 * kDegree;
constexpr double kMaxStrayShare = 0.5;
// A model that has this share of its volume inside another one is of the same object.
constexpr double kMinDoubleShare = 0.5;

std::string Percent(double share) {
  char text[16];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

std::string Fixed2(double value) {
  char text[16];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

std::string Label(const TrueObject& object) {
  const std::string label = object.shape_name + " " + std::to_string(object.id);
  return object.name.empty() ? label : label + " " + object.name;
}

std::string Label(const ObjectModel& model) {
  return "model " + std::to_string(model.id) + " " + ShapeName(model.solid.shape);
}

class FrameMatcher {
 public:
  FrameMatcher(const SceneTruth& truth, const ObjectList& found)
      : truth_(truth), found_(found), overlap_(MeasureOverlap(truth, found)) {
    score_.objects.resize(truth.objects.size());
    score_.models.resize(found.objects.size());
    for (const TrueObject& object : truth.objects) {
      at_seed_.push_back(ModelAt(found, object.seed_px, kSeedReachPx));
    }
  }

  FrameScore Match() {
    PairBestFirst();
    for (size_t m = 0; m < score_.models.size(); ++m) {
      if (!score_.models[m].matches) JudgeUnmatched(m);
    }
    for (size_t t = 0; t < score_.objects.size(); ++t) {
      if (!score_.objects[t].model) ExplainMiss(t);
    }
    return score_;
  }

 private:
  struct Pair {
    double quality;
    size_t model;
    size_t object;
  };

  bool IsLabelled(size_t t) const {
    return overlap_.has_labels && !truth_.objects[t].labels.empty();
  }

  // Right shape, in a stance the object may have.
  bool IsSameKind(size_t m, size_t t) const {
    const TrueObject& object = truth_.objects[t];
    const Solid& solid = found_.objects[m].solid;
    if (!object.shape || *object.shape != solid.shape) return false;
    const double tilt = TiltOf(solid, truth_.up_C);
    switch (object.stance) {
      case Stance::kStanding:
        return tilt <= kMaxUprightTilt;
      case Stance::kLying:
        return solid.shape == Shape::kCylinder ? tilt >= kMinLyingTilt : true;
      case Stance::kLeaning:
        return tilt >= kMinLeaningTilt;
      case Stance::kUnknown:
        return object.scope != Scope::kOut;
    }
    return false;
  }

  void PairBestFirst() {
    std::vector<Pair> pairs;
    for (size_t t = 0; t < score_.objects.size(); ++t) {
      if (truth_.objects[t].scope == Scope::kUnscored) continue;
      for (size_t m = 0; m < score_.models.size(); ++m) {
        const double quality = IsLabelled(t) ? overlap_.Iou(m, t) : (at_seed_[t] == m ? 1.0 : 0.0);
        if (quality >= kMinIou && IsSameKind(m, t)) pairs.push_back({quality, m, t});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Pair& a, const Pair& b) { return a.quality > b.quality; });
    for (const Pair& pair : pairs) {
      ModelScore& model = score_.models[pair.model];
      ObjectScore& object = score_.objects[pair.object];
      if (model.matches || object.model) continue;
      object.model = pair.model;
      object.iou = IsLabelled(pair.object) ? pair.quality : 0.0;
      model = {VerdictOn(pair.object), pair.object, true, object.iou, WhyNeutral(pair.object)};
    }
  }

  Verdict VerdictOn(size_t t) const {
    return truth_.objects[t].scope == Scope::kCore ? Verdict::kRight : Verdict::kNeutral;
  }

  std::string WhyNeutral(size_t t) const {
    const TrueObject& object = truth_.objects[t];
    return object.scope == Scope::kCore ? ""
                                        : "is " + ScopeName(object.scope) + " " + Label(object);
  }

  void Set(size_t m, Verdict verdict, std::optional<size_t> object, const std::string& why) {
    const double iou = object && IsLabelled(*object) ? overlap_.Iou(m, *object) : 0.0;
    score_.models[m] = {verdict, object, false, iou, why};
  }

  void JudgeUnmatched(size_t m) {
    if (overlap_.has_labels) {
      const double stray = overlap_.model_px[m] == 0
                               ? 1.0
                               : static_cast<double>(overlap_.NumStray(m)) / overlap_.model_px[m];
      const std::optional<size_t> object = overlap_.MainObject(m);
      if (object && stray <= kMaxStrayShare) return JudgeOn(m, *object);
      return Set(m, Verdict::kFalse, object, Percent(stray) + " of its pixels on no object");
    }
    for (size_t t = 0; t < at_seed_.size(); ++t) {
      if (at_seed_[t] == m) return JudgeOn(m, t);
    }
    const std::optional<size_t> doubled = ObjectModelledAlready(m);
    if (doubled) {
      const ObjectModel& first = found_.objects[*score_.objects[*doubled].model];
      return Set(m, Verdict::kFalse, doubled, "double of " + Label(first));
    }
    Set(m, Verdict::kNeutral, std::nullopt, "on no seed");
  }

  // Without labels: the core object whose match encloses much of this model.
  std::optional<size_t> ObjectModelledAlready(size_t m) const {
    const Solid& solid = found_.objects[m].solid;
    for (size_t t = 0; t < score_.objects.size(); ++t) {
      if (!score_.objects[t].model || truth_.objects[t].scope != Scope::kCore) continue;
      const Solid& match = found_.objects[*score_.objects[t].model].solid;
      if (std::max(ShareInside(solid, match), ShareInside(match, solid)) >= kMinDoubleShare) {
        return t;
      }
    }
    return std::nullopt;
  }

  // A model that lies on true object t without matching it.
  void JudgeOn(size_t m, size_t t) {
    const TrueObject& object = truth_.objects[t];
    const std::string on = " on " + Label(object);
    if (object.scope == Scope::kUnscored || object.scope == Scope::kSoft) {
      return Set(m, Verdict::kNeutral, t, "on " + ScopeName(object.scope) + " " + Label(object));
    }
    if (score_.objects[t].model) {
      const ObjectModel& first = found_.objects[*score_.objects[t].model];
      return Set(m, Verdict::kFalse, t, "double of " + Label(first) + on);
    }
    if (object.scope == Scope::kOut) return JudgeOnOut(m, t);
    if (object.shape != found_.objects[m].solid.shape) {
      return Set(m, Verdict::kFalse, t, "wrong shape" + on);
    }
    if (!IsSameKind(m, t)) return Set(m, Verdict::kFalse, t, "wrong stance" + on);
    Set(m, Verdict::kFalse, t, "IoU " + Fixed2(overlap_.Iou(m, t)) + on);
  }

  // Neither box nor upright cylinder may be there, but a lying cylinder says nothing wrong of a
  // round thing that lies.
  void JudgeOnOut(size_t m, size_t t) {
    const TrueObject& object = truth_.objects[t];
    const Solid& solid = found_.objects[m].solid;
    const bool lying_cylinder =
        solid.shape == Shape::kCylinder && TiltOf(solid, truth_.up_C) >= kMinLyingTilt;
    if (IsSameKind(m, t) || (lying_cylinder && !object.shape)) {
      return Set(m, Verdict::kNeutral, t, "is " + ScopeName(object.scope) + " " + Label(object));
    }
    Set(m, Verdict::kFalse, t, "on out object " + Label(object));
  }

  void ExplainMiss(size_t t) {
    ObjectScore& score = score_.objects[t];
    if (!IsLabelled(t)) {
      score.why = at_seed_[t] ? Label(found_.objects[*at_seed_[t]]) + " at its seed"
                              : "no model at its seed";
      return;
    }
    std::optional<size_t> best;
    for (size_t m = 0; m < score_.models.size(); ++m) {
      const double iou = overlap_.Iou(m, t);
      if (iou <= score.iou) continue;
      score.iou = iou;
      best = m;
    }
    score.why = best ? "best IoU " + Fixed2(score.iou) + " with " + Label(found_.objects[*best])
                     : "no model on it";
  }

  const SceneTruth& truth_;
  const ObjectList& found_;
  PixelOverlap overlap_;
  std::vector<std::optional<size_t>> at_seed_;  // of each true object: the model found there
  FrameScore score_;
};

}  // namespace

FrameScore MatchObjects(const SceneTruth& truth, const ObjectList& found) {
  return FrameMatcher(truth, found).Match();
}

}  // namespace declutter::accuracy
