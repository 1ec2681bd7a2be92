#include "tests/accuracy/json_report.h"

#include <nlohmann/json.hpp>

namespace declutter::accuracy {
namespace {

using json = nlohmann::ordered_json;

json ShapeJson(const ShapeCount& count) {
  return {{"core", count.num_core},
          {"found", count.num_found},
          {"false", count.num_false},
          {"recall", count.Recall()},
          {"precision", count.Precision()},
          {"soft", count.num_soft},
          {"soft_found", count.num_soft_found}};
}

json GroupJson(const GroupCount& group) {
  return {{"frames", group.num_frames},
          {"neutral", group.num_neutral},
          {"box", ShapeJson(group.shapes[0])},
          {"cylinder", ShapeJson(group.shapes[1])}};
}

json BinsJson(const std::vector<RecallBin>& bins) {
  json list = json::array();
  for (const RecallBin& bin : bins) {
    list.push_back({{"bin", bin.name},
                    {"box", {{"core", bin.num_core[0]}, {"found", bin.num_found[0]}}},
                    {"cylinder", {{"core", bin.num_core[1]}, {"found", bin.num_found[1]}}}});
  }
  return list;
}

json SummaryJson(const Summary& summary) {
  json result{{"total", GroupJson(summary.total)}, {"groups", json::object()}};
  for (const auto& [name, group] : summary.groups) result["groups"][name] = GroupJson(group);
  result["without_result"] = summary.without_result;
  result["median_iou"] = summary.median_iou ? json(*summary.median_iou) : json();
  result["exact"] = summary.num_exact;
  result["within_20_mm"] = summary.num_within_20_mm;
  result["estimates"] = summary.num_estimates;
  result["in_95_percent_interval"] = summary.num_in_interval;
  result["by_distance"] = BinsJson(summary.by_distance);
  result["by_visible_fraction"] = BinsJson(summary.by_visible_fraction);
  for (const auto& [name, errors] : summary.errors) {
    const Spread spread = SpreadOf(errors);
    result["errors"][name] = {
        {"number", spread.num}, {"median", spread.median},         {"mean", spread.mean},
        {"sd", spread.sd},      {"median_abs", spread.median_abs}, {"p90_abs", spread.p90_abs}};
  }
  return result;
}

json FrameJson(const ScoredFrame& frame) {
  static const char* const kVerdicts[] = {"right", "neutral", "false"};
  json result{{"frame", frame.truth.frame}, {"error", frame.found.header.error}};
  result["objects"] = json::array();
  for (size_t t = 0; t < frame.truth.objects.size(); ++t) {
    const TrueObject& object = frame.truth.objects[t];
    const ObjectScore& score = frame.score.objects[t];
    json entry{{"id", object.id},
               {"name", object.name},
               {"shape", object.shape_name},
               {"scope", ScopeName(object.scope)},
               {"iou", score.iou},
               {"why", score.why}};
    if (score.model) entry["model"] = frame.found.objects[*score.model].id;
    result["objects"].push_back(entry);
  }
  result["models"] = json::array();
  for (size_t m = 0; m < frame.found.objects.size(); ++m) {
    const ModelScore& score = frame.score.models[m];
    result["models"].push_back({{"id", frame.found.objects[m].id},
                                {"shape", ShapeName(frame.found.objects[m].solid.shape)},
                                {"verdict", kVerdicts[static_cast<size_t>(score.verdict)]},
                                {"iou", score.iou},
                                {"why", score.why}});
  }
  return result;
}

}  // namespace

json JsonReport(const std::vector<ScoredFrame>& frames, const Summary& summary) {
  json report{{"summary", SummaryJson(summary)}, {"frames", json::array()}};
  for (const ScoredFrame& frame : frames) report["frames"].push_back(FrameJson(frame));
  return report;
}

}  // namespace declutter::accuracy
