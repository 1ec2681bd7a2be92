// score_objects: compares an exported folder with the truth of its scenes.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/accuracy/html_report.h"
#include "tests/accuracy/json_report.h"
#include "tests/accuracy/scored_frame.h"
#include "tests/accuracy/summary.h"
#include "tests/accuracy/text_report.h"

namespace {

namespace fs = std::filesystem;
using namespace declutter::accuracy;  // NOLINT: a program of its own

constexpr char kUsage[] =
    "score_objects DIR OUTDIR [--table] [--json REPORT] [--html PAGE] [--min_found N]\n"
    "DIR: the folder of scenes that the graph was given. OUTDIR: what it exported.\n"
    "  --table        print each true object beside the one found\n"
    "  --json REPORT  write every number to a file\n"
    "  --html PAGE    write a page with a picture of every frame with a miss or a false model\n"
    "  --min_found N  end with 1 unless N core objects are found\n"
    "Ends with 0 whatever the score, 1 on input that is broken or lacks a frame, 2 on wrong use.\n";

struct Options {
  fs::path scene_dir;
  fs::path output_dir;
  bool table = false;
  fs::path json;
  fs::path html;
  int min_found = 0;
};

Options ParseOptions(const std::vector<std::string>& arguments) {
  Options options;
  std::vector<fs::path> folders;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw std::invalid_argument(name + " needs a value");
      return arguments[++i];
    };
    if (name == "--table") {
      options.table = true;
    } else if (name == "--json") {
      options.json = value();
    } else if (name == "--html") {
      options.html = value();
    } else if (name == "--min_found") {
      options.min_found = std::stoi(value());
    } else if (name.rfind("--", 0) == 0) {
      throw std::invalid_argument("unknown option " + name);
    } else {
      folders.emplace_back(name);
    }
  }
  if (folders.size() != 2) throw std::invalid_argument("two folders are needed");
  options.scene_dir = folders[0];
  options.output_dir = folders[1];
  return options;
}

void WriteFile(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

int Score(const Options& options) {
  const std::vector<ScoredFrame> frames = ScoreFolder(options.scene_dir, options.output_dir);
  if (frames.empty())
    throw std::runtime_error(options.scene_dir.string() + ": no scene with truth");
  const Summary summary = Summarize(frames);
  if (options.table) WriteComparison(frames, std::cout);
  WriteRemarks(frames, std::cout);
  WriteTotals(summary, std::cout);
  if (!options.json.empty()) WriteFile(options.json, JsonReport(frames, summary).dump(1) + "\n");
  if (!options.html.empty()) {
    const fs::path page_folder = fs::absolute(options.html).parent_path();
    const fs::path overlays = fs::relative(options.output_dir, page_folder);
    WriteFile(options.html, HtmlReport(frames, summary, overlays.generic_string()));
  }
  if (!summary.without_result.empty()) {
    throw std::runtime_error(options.output_dir.string() + ": lacks frame " +
                             summary.without_result.front());
  }
  const int num_found = summary.total.shapes[0].num_found + summary.total.shapes[1].num_found;
  if (num_found >= options.min_found) return 0;
  std::cerr << "score_objects: found " << num_found << " core objects, less than "
            << options.min_found << '\n';
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    options = ParseOptions({argv + 1, argv + argc});
  } catch (const std::logic_error& e) {
    std::cerr << "score_objects: " << e.what() << '\n' << kUsage;
    return 2;
  }
  try {
    return Score(options);
  } catch (const std::exception& e) {
    std::cerr << "score_objects: " << e.what() << '\n';
    return 1;
  }
}
