#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/geometry/solid.h"
#include "tests/accuracy/scene_truth.h"

namespace declutter::accuracy {

// What a model counts as. Right: the match of a core object. Neutral: neither way.
enum class Verdict : int8_t { kRight, kNeutral, kFalse };

struct ModelScore {
  Verdict verdict = Verdict::kNeutral;
  std::optional<size_t> object;  // index of the true object it matches or mostly lies on
  bool matches = false;          // it is that object's one match
  double iou = 0;                // of its pixels and that object's; 0 without a label image
  std::string why;               // of a neutral or false one
};

struct ObjectScore {
  std::optional<size_t> model;  // index of its match
  double iou = 0;               // with its match, or the best with any model
  std::string why;              // it has no match
};

// One entry for each true object and for each model, in their order.
struct FrameScore {
  std::vector<ObjectScore> objects;
  std::vector<ModelScore> models;
};

// Matches models with true objects, one to one and best overlap first. A pair needs the right
// shape, upright where the object is, and, where the truth has a label image, an overlap
// (intersection over union) of pixels of at least 0.5; else the model's pixels must reach the
// object's seed, or within 3 px of it. A label image of another size than the models' is an
// std::runtime_error.
FrameScore MatchObjects(const SceneTruth& truth, const ObjectList& found);

}  // namespace declutter::accuracy
