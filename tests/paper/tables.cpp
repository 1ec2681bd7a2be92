#include "tests/paper/tables.h"

#include <array>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/paper/repeatability.h"

namespace declutter::experiments {
namespace {

using Json = nlohmann::ordered_json;

// What a method finds in several frames.
struct Totals {
  std::array<int, 2> num_core{};   // by Shape
  std::array<int, 2> num_found{};  // by Shape
  int num_false = 0;
  double num_votes = 0;  // of right models
  double num_hypotheses = 0;
  double num_right_hypotheses = 0;

  void Add(const PreparedFrame& frame, const Result& result) {
    num_hypotheses += static_cast<double>(result.num_hypotheses);
    num_right_hypotheses += static_cast<double>(result.num_right_hypotheses);
    for (size_t i = 0; i < frame.truth.objects.size(); ++i) {
      const accuracy::TrueObject& object = frame.truth.objects[i];
      if (object.scope != accuracy::Scope::kCore) continue;
      const auto shape = static_cast<size_t>(*object.shape);
      const auto model = result.score.objects[i].model;
      ++num_core[shape];
      if (!model) continue;
      ++num_found[shape];
      num_votes += result.found.objects[*model].num_votes;
    }
    for (const accuracy::ModelScore& model : result.score.models) {
      num_false += model.verdict == accuracy::Verdict::kFalse;
    }
  }

  int num_all_found() const { return num_found[0] + num_found[1]; }
  double votes_per_model() const { return num_all_found() > 0 ? num_votes / num_all_found() : 0; }

  double right_share() const {
    return num_hypotheses > 0 ? num_right_hypotheses / num_hypotheses : 0;
  }

  Json Row(const std::string& name) const {
    return {{"name", name},
            {"boxes", num_core[0]},
            {"boxes_found", num_found[0]},
            {"cylinders", num_core[1]},
            {"cylinders_found", num_found[1]},
            {"false_models", num_false},
            {"votes_per_right_model", votes_per_model()},
            {"hypotheses", num_hypotheses},
            {"right_hypotheses", num_right_hypotheses}};
  }
};

Totals RunAll(const Method& method, const std::vector<PreparedFrame>& frames) {
  Totals totals;
  for (const PreparedFrame& frame : frames) totals.Add(frame, RunMethod(method, frame));
  return totals;
}

std::vector<PreparedFrame> PrepareAll(const std::vector<RenderedScene>& scenes, FeatureMode mode) {
  std::vector<PreparedFrame> frames;
  for (const RenderedScene& scene : scenes) frames.push_back(Prepare(scene, mode));
  return frames;
}

Json PrintRow(const std::string& name, const Repeatability& measured) {
  const std::array<std::pair<const char*, ErrorAndSpread>, 4> columns = {
      std::pair("box_width_mm", measured.BoxWidth()),
      std::pair("box_depth_mm", measured.BoxDepth()),
      std::pair("cylinder_radius_mm", measured.CylinderRadius()),
      std::pair("cylinder_centre_mm", measured.CylinderCentre())};
  Json row = {{"name", name}};
  std::printf("%-32s", name.c_str());
  for (const auto& [column, value] : columns) {
    std::printf("  %5.2f %6.3f", value.mean_mm, value.sd_mm);
    row[column] = {{"mean", value.mean_mm}, {"sd", value.sd_mm}};
  }
  std::printf("  %4d of %3d  %5d\n", measured.num_right, measured.num_wanted, measured.num_false);
  std::fflush(stdout);
  row["found"] = measured.num_right;
  row["objects"] = measured.num_wanted;
  row["false_models"] = measured.num_false;
  return row;
}

using Change = std::function<void(HoughSegmenterConfig*)>;

const std::vector<std::pair<std::string, Change>>& FilterChanges() {
  static const std::vector<std::pair<std::string, Change>> kChanges = {
      {"all filters", [](auto*) {}},
      {"lines of several runs", [](auto* config) { config->set_filter_runs(false); }},
      {"circles of many arcs", [](auto* config) { config->set_filter_arcs(false); }},
      {"circles of several heights", [](auto* config) { config->set_filter_heights(false); }},
      {"any normals", [](auto* config) { config->set_filter_normals(false); }},
      {"any curvature", [](auto* config) { config->set_filter_curvature(false); }},
      {"any radius", [](auto* config) { config->set_filter_radius(false); }},
      {"N = 10 points", [](auto* config) { config->set_min_inliers(10); }},
  };
  return kChanges;
}

}  // namespace

Json PrintTable2(const Scene& scene, int num_runs) {
  std::printf(
      "\nTable 2: error and spread over %d runs, of objects at least half visible, mm\n"
      "%-32s     box width      box depth  cyl. radius    cyl. centre\n"
      "%-32s   mean     sd   mean     sd   mean     sd   mean     sd   found        false\n"
      "%-32s  %5.2f %6.2f  %5.2f %6.2f  %5.2f %6.2f      - %6.2f\n"
      "%-32s  %5.2f %6.2f  %5.2f %6.2f  %5.2f %6.2f      - %6.2f\n",
      num_runs, "", "", "paper: original", 1.75, 2.26, 8.92, 0.62, 3.80, 3.04, 4.56, "paper: votes",
      0.35, 0.16, 8.48, 0.01, 2.52, 0.88, 1.38);
  const PreparedFrame first = Prepare(Render(scene, 1), FeatureMode::kDefault);
  std::vector<PreparedFrame> noisy;
  for (int run = 1; run <= num_runs; ++run) {
    noisy.push_back(Prepare(Render(scene, static_cast<uint64_t>(run)), FeatureMode::kDefault));
  }
  Json rows = Json::array();
  for (Method method : {SingleShot(), VotingAlone(), Voting()}) {
    Repeatability over_seeds;
    for (int run = 1; run <= num_runs; ++run) {
      method.segmenter.set_seed(static_cast<uint64_t>(run));
      over_seeds.Add(first, RunMethod(method, first));
    }
    rows.push_back(PrintRow(method.name + ", seeds", over_seeds));
    method.segmenter.clear_seed();
    Repeatability over_noise;
    for (const PreparedFrame& frame : noisy) over_noise.Add(frame, RunMethod(method, frame));
    rows.push_back(PrintRow(method.name + ", noise", over_noise));
  }
  return rows;
}

Json PrintFigure4(const std::vector<RenderedScene>& scenes) {
  Json report;
  for (const FeatureMode mode : {FeatureMode::kDefault, FeatureMode::kPaper}) {
    const char* mode_name = mode == FeatureMode::kPaper ? "paper" : "default";
    std::printf(
        "\nFigure 4: what is found in %zu scenes when a filter lets pass, features of mode %s\n"
        "%-28s hypotheses  right   boxes        cylinders    false\n",
        scenes.size(), mode_name, "");
    const std::vector<PreparedFrame> frames = PrepareAll(scenes, mode);
    for (const auto& [name, change] : FilterChanges()) {
      Method method = Voting();
      change(&method.segmenter);
      const Totals totals = RunAll(method, frames);
      std::printf("%-28s %10.0f  %4.1f %%  %4d of %3d  %4d of %3d  %5d\n", name.c_str(),
                  totals.num_hypotheses, 100 * totals.right_share(), totals.num_found[0],
                  totals.num_core[0], totals.num_found[1], totals.num_core[1], totals.num_false);
      std::fflush(stdout);
      report[mode_name].push_back(totals.Row(name));
    }
  }
  return report;
}

Json PrintTable3(const std::vector<RenderedScene>& scenes) {
  // Of the 11 boxes and 6 cylinders in the paper's scene.
  struct PaperRow {
    int num_iterations, num_boxes, num_cylinders;
  };
  constexpr PaperRow kPaper[] = {{5, 9, 4},   {15, 10, 5},  {25, 11, 6},  {50, 10, 6},
                                 {75, 11, 5}, {100, 11, 6}, {125, 11, 6}, {150, 11, 6}};
  std::printf(
      "\nTable 3: what is found in %zu scenes with I iterations; paper: of 11 boxes, 6 cylinders\n"
      "%5s  paper     boxes        cylinders    found    false  votes per right model\n",
      scenes.size(), "I");
  const std::vector<PreparedFrame> frames = PrepareAll(scenes, FeatureMode::kDefault);
  Json rows = Json::array();
  for (const PaperRow& paper : kPaper) {
    Method method = Voting();
    method.segmenter.set_num_iterations(paper.num_iterations);
    const Totals totals = RunAll(method, frames);
    std::printf("%5d  %2d and %d  %4d of %3d  %4d of %3d  %5.1f %%  %5d  %6.1f\n",
                paper.num_iterations, paper.num_boxes, paper.num_cylinders, totals.num_found[0],
                totals.num_core[0], totals.num_found[1], totals.num_core[1],
                100.0 * totals.num_all_found() / (totals.num_core[0] + totals.num_core[1]),
                totals.num_false, totals.votes_per_model());
    std::fflush(stdout);
    rows.push_back(totals.Row("I = " + std::to_string(paper.num_iterations)));
  }
  return rows;
}

}  // namespace declutter::experiments
