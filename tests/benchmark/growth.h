#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/benchmark/bench_frame.h"
#include "tests/benchmark/report.h"

namespace declutter::benchmark {

// How the time of our stages grows with one thing.
struct GrowthRow {
  std::string value;
  int num_object_points = 0;
  std::string plane, features, segment, verify;  // names of tasks; empty: not measured
};
struct Growth {
  std::string with;  // number of objects, image size, iterations
  std::vector<GrowthRow> rows;
  std::vector<Task> tasks;
  std::shared_ptr<const std::vector<BenchFrame>> frames;
};

Growth GrowthWithObjects();
Growth GrowthWithImageSize();
Growth GrowthWithIterations();

}  // namespace declutter::benchmark
