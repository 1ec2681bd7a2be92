// paper_tables: the experiments of section 6 of the paper on rendered scenes.
#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "modules/scene_renderer/scene_text.h"
#include "tests/paper/tables.h"

namespace {

using namespace declutter;  // NOLINT: a program of its own

constexpr char kUsage[] =
    "paper_tables SCENE CLUTTER REPORT [NUMBER]\n"
    "Prints Table 2 of the paper on the scene text SCENE, Figure 4 (as a table) and Table 3 on\n"
    "NUMBER scenes (20) of the scene text CLUTTER, and writes all of it to REPORT as JSON.\n";
constexpr int kNumRuns = 10;

int ToNumber(const std::string& text) {
  if (text.empty() || text.size() > 4 ||
      text.find_first_not_of("0123456789") != std::string::npos) {
    throw std::invalid_argument("number of scenes " + text + " is not in [0, 9999]");
  }
  return std::stoi(text);
}

void WriteTables(const std::vector<std::string>& arguments) {
  const Scene scene = ReadScene(arguments[0]);
  const Scene clutter = ReadScene(arguments[1]);
  const int num_scenes = arguments.size() > 3 ? ToNumber(arguments[3]) : 20;
  std::vector<RenderedScene> scenes;
  for (int i = 1; i <= num_scenes; ++i) scenes.push_back(Render(clutter, static_cast<uint64_t>(i)));
  nlohmann::ordered_json report;
  report["table_2"] = experiments::PrintTable2(scene, kNumRuns);
  report["figure_4"] = experiments::PrintFigure4(scenes);
  report["table_3"] = experiments::PrintTable3(scenes);
  std::ofstream file(arguments[2]);
  file << report.dump(1) << "\n";
  file.close();
  if (!file) throw std::runtime_error(arguments[2] + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 3 || arguments.size() > 4) {
    std::fputs(kUsage, stderr);
    return 2;
  }
  try {
    WriteTables(arguments);
    return 0;
  } catch (const std::invalid_argument& fault) {
    std::fprintf(stderr, "paper_tables: %s\n", fault.what());
    return 2;
  } catch (const std::exception& fault) {
    std::fprintf(stderr, "paper_tables: %s\n", fault.what());
    return 1;
  }
}
