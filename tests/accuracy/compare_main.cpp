// compare_runs: two exported folders of the same input side by side.
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>

#include "tests/accuracy/exported_objects.h"
#include "tests/accuracy/run_comparison.h"
#include "tests/accuracy/summary.h"

namespace {

namespace fs = std::filesystem;
using namespace declutter::accuracy;  // NOLINT: a program of its own

constexpr char kUsage[] =
    "compare_runs BASELINE CANDIDATE [DIR]\n"
    "BASELINE, CANDIDATE: what two graphs exported from the same input. DIR: the folder of scenes\n"
    "that they were given, for its truth.\n"
    "Ends with 0 whatever they differ in, 1 on input that is broken or lacks a frame, 2 on wrong\n"
    "use.\n";

std::string Text(const std::optional<Estimate>& estimate, QuantityKind kind, bool is_difference) {
  if (!estimate) return "-";
  const double scale = kind == QuantityKind::kShare ? 100 : 1;
  const int digits = kind == QuantityKind::kCount ? 0 : 1;
  char text[100];
  std::snprintf(text, sizeof text, is_difference ? "%+.*f [%+.*f, %+.*f]" : "%.*f [%.*f, %.*f]",
                digits, scale * estimate->value, digits, scale * estimate->low, digits,
                scale * estimate->high);
  return text;
}

void PrintTable(const std::vector<ComparedQuantity>& table) {
  std::printf("%-26s %-22s %-22s %s\n", "", "baseline", "candidate", "difference");
  for (const ComparedQuantity& line : table) {
    std::printf("%-26s %-22s %-22s %s\n", line.name.c_str(),
                Text(line.estimates.baseline, line.kind, false).c_str(),
                Text(line.estimates.candidate, line.kind, false).c_str(),
                Text(line.estimates.difference, line.kind, true).c_str());
  }
}

std::string ModelsText(bool has_result, const std::array<int, 2>& counts) {
  return has_result ? std::to_string(counts[0] + counts[1]) : "no result";
}

void PrintOverlay(const fs::path& output_dir, const std::string& frame) {
  const fs::path overlay = output_dir / (frame + ".overlay.png");
  if (fs::exists(overlay)) std::printf("  %s\n", overlay.c_str());
}

// What each run made of the true objects, by frame.
std::map<std::string, std::string> ScoreTexts(const std::vector<ScoredFrame>& baseline,
                                              const std::vector<ScoredFrame>& candidate) {
  std::map<std::string, std::string> texts;
  for (size_t i = 0; i < baseline.size(); ++i) {
    std::string found, wrong;
    for (const ScoredFrame* frame : {&baseline[i], &candidate[i]}) {
      const ShapeCounts counts = Summarize({*frame}).total.shapes;
      const std::string separator = found.empty() ? "" : " / ";
      found += separator + std::to_string(counts[0].num_found + counts[1].num_found);
      wrong += separator + std::to_string(counts[0].num_false + counts[1].num_false);
    }
    texts[baseline[i].truth.frame] = ", found " + found + ", false " + wrong;
  }
  return texts;
}

void PrintDifferences(const std::vector<FrameAgreement>& frames, const fs::path& baseline,
                      const fs::path& candidate, const std::map<std::string, std::string>& scores) {
  size_t num_different = 0;
  for (const FrameAgreement& frame : frames) num_different += frame.IsSame() ? 0 : 1;
  std::printf("%zu of %zu frames differ\n", num_different, frames.size());
  for (const FrameAgreement& frame : frames) {
    if (frame.IsSame()) continue;
    const auto score = scores.find(frame.frame);
    std::printf("%s: models %s / %s, same in both %d%s\n", frame.frame.c_str(),
                ModelsText(frame.has_baseline, frame.num_baseline).c_str(),
                ModelsText(frame.has_candidate, frame.num_candidate).c_str(),
                frame.num_same[0] + frame.num_same[1],
                score == scores.end() ? "" : score->second.c_str());
    PrintOverlay(baseline, frame.frame);
    PrintOverlay(candidate, frame.frame);
  }
}

void RequireResults(const std::vector<ScoredFrame>& frames, const fs::path& output_dir) {
  for (const ScoredFrame& frame : frames) {
    if (frame.has_result) continue;
    throw std::runtime_error(output_dir.string() + ": lacks frame " + frame.truth.frame);
  }
}

void Compare(const fs::path& baseline, const fs::path& candidate, const fs::path& scene_dir) {
  const std::vector<FrameAgreement> frames =
      CompareRuns(ReadExportedObjects(baseline), ReadExportedObjects(candidate));
  if (frames.empty()) throw std::runtime_error(baseline.string() + ": no frame");
  std::vector<ScoredFrame> one, other;
  if (!scene_dir.empty()) {
    one = ScoreFolder(scene_dir, baseline);
    other = ScoreFolder(scene_dir, candidate);
    RequireResults(one, baseline);
    RequireResults(other, candidate);
  }
  std::vector<ComparedQuantity> table;
  if (!one.empty()) table = CompareWithTruth(one, other);
  for (ComparedQuantity& line : CompareWithEachOther(frames)) table.push_back(std::move(line));
  std::printf("%zu frames, %zu with truth\n", frames.size(), one.size());
  PrintTable(table);
  std::printf(
      "Errors are medians of absolute values. [95 %% intervals]: Wilson's for the shares of each\n"
      "run; for all else and for differences a bootstrap over frames, the same frames of both.\n"
      "Same in both: of one shape, centre and extents within 20 mm.\n");
  constexpr size_t kMinFrames = 10;
  if (frames.size() < kMinFrames || (!one.empty() && one.size() < kMinFrames)) {
    std::printf("Of fewer than %zu frames a bootstrap's intervals are too narrow.\n", kMinFrames);
  }
  PrintDifferences(frames, baseline, candidate, ScoreTexts(one, other));
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_used_well = (argc == 3 || argc == 4) && argv[1][0] != '-';
  if (!is_used_well) {
    std::cerr << "compare_runs: two or three folders are needed\n" << kUsage;
    return 2;
  }
  try {
    Compare(argv[1], argv[2], argc == 4 ? argv[3] : "");
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "compare_runs: " << e.what() << '\n';
    return 1;
  }
}
