#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/geometry/solid.h"
#include "tests/accuracy/matching.h"
#include "tests/accuracy/scene_truth.h"

namespace declutter::accuracy {

// A scene, what was found in it, and how the two compare. Label images are dropped once compared.
struct ScoredFrame {
  SceneTruth truth;
  ObjectList found;
  bool has_result = false;  // the exported folder has a line for the scene
  FrameScore score;
};

// Every scene below scene_dir that has a truth (a list of objects in its scene.json), or scene_dir
// itself, in path order, beside what output_dir/objects.jsonl and its label images say. Throws
// std::runtime_error, naming the file, on input that cannot be read.
std::vector<ScoredFrame> ScoreFolder(const std::filesystem::path& scene_dir,
                                     const std::filesystem::path& output_dir);

}  // namespace declutter::accuracy
