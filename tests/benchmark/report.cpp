#include "tests/benchmark/report.h"

#include <cstdio>

#include "tests/benchmark/allocations.h"

namespace declutter::benchmark {
namespace {

constexpr double kMinTime_s = 0.5;
constexpr char kAllocations[] = "allocations";

void RunTask(const Task& task, ::benchmark::State& state) {
  const auto run_all = [&task] {
    for (size_t frame = 0; frame < task.num_frames; ++frame) task.run(frame);
  };
  // The first frames fill buffers that later ones use again.
  if (!task.is_slow) run_all();
  const int64_t num_before = NumAllocations();
  for (auto _ : state) run_all();
  const auto num_made = static_cast<double>(NumAllocations() - num_before);
  state.counters[kAllocations] =
      num_made / static_cast<double>(state.iterations()) / static_cast<double>(task.num_frames);
}

class Collector : public ::benchmark::BenchmarkReporter {
 public:
  explicit Collector(const std::vector<Task>& tasks) {
    for (const Task& task : tasks) num_frames_[task.name] = static_cast<double>(task.num_frames);
  }

  bool ReportContext(const Context&) override { return true; }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      const std::string& name = run.run_name.function_name;
      const double num_frames = num_frames_.at(name);
      Measured& measured = measured_[name];
      measured.cpu_ms = run.GetAdjustedCPUTime() / num_frames;
      measured.wall_ms = run.GetAdjustedRealTime() / num_frames;
      measured.num_allocations = run.counters.at(kAllocations);
      std::fprintf(stderr, "%-44s %10.3f ms\n", name.c_str(), measured.cpu_ms);
    }
  }

  const std::map<std::string, Measured>& measured() const { return measured_; }

 private:
  std::map<std::string, double> num_frames_;
  std::map<std::string, Measured> measured_;
};

}  // namespace

std::map<std::string, Measured> MeasureAll(const std::vector<Task>& tasks) {
  for (const Task& task : tasks) {
    auto* registered = ::benchmark::RegisterBenchmark(
        task.name.c_str(), [&task](::benchmark::State& state) { RunTask(task, state); });
    registered->Unit(::benchmark::kMillisecond);
    if (task.is_slow) {
      registered->Iterations(1);
    } else {
      registered->MinTime(kMinTime_s);
    }
  }
  Collector collector(tasks);
  ::benchmark::RunSpecifiedBenchmarks(&collector);
  return collector.measured();
}

}  // namespace declutter::benchmark
