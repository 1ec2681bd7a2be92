// benchmark: time of every stage and of a whole frame beside the same work done with PCL, and how
// it grows.
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/benchmark/growth.h"
#include "tests/benchmark/stages.h"

namespace {

using namespace declutter::benchmark;  // NOLINT: a program of its own
using Json = nlohmann::ordered_json;
using Measures = std::map<std::string, Measured>;

constexpr char kUsage[] =
    "benchmark [--json FILE]\n"
    "Measures our stages and the same work done with PCL on rendered scenes of 17 objects, and on\n"
    "recordings when DECLUTTER_DATA names a folder of them. --json FILE writes the table too.\n";
constexpr int kNumFrames = 2;  // of each kind

double TimeOf(const Measures& measures, const std::string& task) {
  return task.empty() ? 0 : measures.at(task).cpu_ms;
}

// Sum over the stages; a stage without that competitor counts with PCL on one thread.
double PclSum(const std::vector<Stage>& stages, const Measures& measures,
              std::string Stage::*competitor) {
  double sum = 0;
  for (const Stage& stage : stages) {
    if (stage.mode != "default" || stage.pcl.empty()) continue;
    const std::string& task = (stage.*competitor).empty() ? stage.pcl : stage.*competitor;
    sum += competitor == &Stage::pcl_openmp ? measures.at(task).wall_ms : TimeOf(measures, task);
  }
  return sum;
}

struct PclTimes {
  double one_thread_ms = 0, openmp_ms = 0, voxels_ms = 0;  // 0: no competitor
};

PclTimes PclTimesOf(const Stage& stage, const std::vector<Stage>& stages,
                    const Measures& measures) {
  if (stage.name == kWholeFrame) {
    return {PclSum(stages, measures, &Stage::pcl), PclSum(stages, measures, &Stage::pcl_openmp),
            PclSum(stages, measures, &Stage::pcl_voxels)};
  }
  return {TimeOf(measures, stage.pcl),
          stage.pcl_openmp.empty() ? 0 : measures.at(stage.pcl_openmp).wall_ms,
          TimeOf(measures, stage.pcl_voxels)};
}

void PrintNumber(double value) {
  if (value > 0) {
    std::printf(" %10.1f", value);
  } else {
    std::printf(" %10s", "-");
  }
}

// Prints the table of one kind of frames. Returns the rows of stages with a competitor.
Json PrintStages(const std::string& kind, const std::vector<BenchFrame>& frames,
                 const std::vector<Stage>& stages, const Measures& measures) {
  double num_points = 0;
  for (const BenchFrame& frame : frames) num_points += frame.tabletop.num_object_points;
  num_points /= static_cast<double>(frames.size());
  std::printf(
      "\n%s: %zu frames, %.0f object points each; per frame, one thread\n"
      "%-18s %-8s %10s %10s %10s %10s %10s %12s %12s\n",
      kind.c_str(), frames.size(), num_points, "stage", "mode", "ours ms", "PCL ms", "ratio",
      "2 cores", "voxels", "points/s", "allocations");
  Json rows = Json::array();
  for (const Stage& stage : stages) {
    const Measured& ours = measures.at(stage.ours);
    const PclTimes pcl = PclTimesOf(stage, stages, measures);
    const double ratio = pcl.one_thread_ms / ours.cpu_ms;
    std::printf("%-18s %-8s %10.2f", stage.name.c_str(), stage.mode.c_str(), ours.cpu_ms);
    PrintNumber(pcl.one_thread_ms);
    PrintNumber(ratio);
    PrintNumber(pcl.openmp_ms);
    PrintNumber(pcl.voxels_ms);
    std::printf(" %10.2f M %12.0f\n", num_points / ours.cpu_ms / 1000, ours.num_allocations);
    if (pcl.one_thread_ms <= 0) continue;
    rows.push_back({{"name", stage.name},
                    {"mode", stage.mode},
                    {"ours_ms", ours.cpu_ms},
                    {"pcl_ms", pcl.one_thread_ms},
                    {"ratio", ratio}});
  }
  return rows;
}

void PrintGrowth(const Growth& growth, const Measures& measures) {
  std::printf("\ngrowth, ms\n%-10s %10s %12s %12s %12s %12s\n", growth.with.c_str(), "points",
              "plane", "features", "segment", "verify");
  for (const GrowthRow& row : growth.rows) {
    std::printf("%-10s %10d", row.value.c_str(), row.num_object_points);
    for (const std::string& task : {row.plane, row.features, row.segment, row.verify}) {
      if (task.empty()) {
        std::printf(" %12s", "-");
      } else {
        std::printf(" %12.2f", TimeOf(measures, task));
      }
    }
    std::printf("\n");
  }
}

void WriteJson(const std::string& path, const Json& report) {
  std::ofstream file(path);
  file << report.dump(1) << "\n";
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

void Run(const std::string& json_path) {
  const std::vector<std::pair<std::string, std::vector<BenchFrame>>> kinds = {
      {"rendered", RenderedFrames(kNumFrames)}, {"recorded", RecordedFrames(kNumFrames)}};
  const std::vector<Growth> growths = {GrowthWithObjects(), GrowthWithImageSize(),
                                       GrowthWithIterations()};
  std::vector<Task> tasks;
  std::vector<std::vector<Stage>> stages;
  const auto add = [&tasks](const std::vector<Task>& more) {
    tasks.insert(tasks.end(), more.begin(), more.end());
  };
  for (const auto& [kind, frames] : kinds) {
    StageTasks made = MakeStageTasks(kind, frames);
    stages.push_back(made.stages);
    if (!frames.empty()) add(made.tasks);
  }
  for (const Growth& growth : growths) add(growth.tasks);
  const Measures measures = MeasureAll(tasks);

  Json report;
  for (size_t k = 0; k < kinds.size(); ++k) {
    const auto& [kind, frames] = kinds[k];
    if (frames.empty()) continue;
    report[k == 0 ? "stages" : kind] = PrintStages(kind, frames, stages[k], measures);
  }
  for (const Growth& growth : growths) PrintGrowth(growth, measures);
  if (!json_path.empty()) WriteJson(json_path, report);
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  const bool has_json = arguments.size() == 2 && arguments[0] == "--json";
  if (!arguments.empty() && !has_json) {
    const bool asks = arguments[0] == "--help";
    std::fputs(kUsage, asks ? stdout : stderr);
    return asks ? 0 : 2;
  }
  try {
    ::benchmark::Initialize(&argc, argv);
    Run(has_json ? arguments[1] : "");
    return 0;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "benchmark: %s\n", fault.what());
    return 1;
  }
}
