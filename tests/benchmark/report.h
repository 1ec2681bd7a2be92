#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace declutter::benchmark {

struct Measured {
  double cpu_ms = 0;   // of the calling thread
  double wall_ms = 0;  // of all threads together
  double num_allocations = 0;
};

// A function to measure, once over each of its frames. Values are per frame.
struct Task {
  std::string name;  // unique
  size_t num_frames = 1;
  std::function<void(size_t frame)> run;
  bool is_slow = false;  // seconds a frame: measured once, without warming up
};

// Hands tasks to Google Benchmark and returns what it measured by their names.
std::map<std::string, Measured> MeasureAll(const std::vector<Task>& tasks);

}  // namespace declutter::benchmark
