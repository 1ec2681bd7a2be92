#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/benchmark/bench_frame.h"
#include "tests/benchmark/report.h"

namespace declutter::benchmark {

// A stage of the chain with the names of its tasks; a name is empty where there is no such task.
struct Stage {
  std::string name;
  std::string mode;        // of the features
  std::string ours;        // one thread
  std::string pcl;         // one thread, the same points
  std::string pcl_openmp;  // all cores
  std::string pcl_voxels;  // on a voxel grid of 4 mm
};

// All stages of the chain over frames of one kind. Tasks refer to `frames`, which must outlive
// them.
struct StageTasks {
  std::vector<Stage> stages;
  std::vector<Task> tasks;
};
StageTasks MakeStageTasks(const std::string& kind, const std::vector<BenchFrame>& frames);

// Time of the competitor's whole frame, the sum of its stages.
inline constexpr char kWholeFrame[] = "whole_frame";

}  // namespace declutter::benchmark
