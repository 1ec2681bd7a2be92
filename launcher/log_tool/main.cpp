#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "launcher/excerpt.h"
#include "launcher/log_tool/cut.h"
#include "launcher/log_tool/frame_export.h"
#include "launcher/log_tool/frame_summary.h"
#include "launcher/log_tool/log_scan.h"
#include "launcher/log_tool/player.h"
#include "launcher/log_tool/top.h"
#include "launcher/network.h"
#include "modules/runtime/config_error.h"
#include "modules/runtime/suggestion.h"

namespace declutter::log_tool {
namespace {

using launcher::ParseNumber;
using runtime::ConfigError;

constexpr int kFailure = 1;
constexpr int kBadCommand = 2;

constexpr const char* kHelp = R"(log_tool: looks into logs of LCM

  log_tool info LOG [--graph]
      Channels with their types, rates, sizes and gaps, what made the log, and what is damaged;
      or the graph, with all parameters, that it was recorded from.
  log_tool frames LOG
      Frames in, out and skipped of each module, whether all messages that they published are in the
      log, and how long after the depth of a frame its messages were recorded.
  log_tool cut LOG NEW_LOG [PART]
      Copies a part of a log, without what is damaged.
  log_tool play LOG [PART] [--speed X] [--loop] [--url URL]
      Publishes it as it was recorded. In a terminal the space bar stops it and lets it go on; n
      gives the next message while it is stopped.
  log_tool top [LOG [PART] [--speed X]] [--url URL] [--channel CHANNEL] [--seconds S]
      Channels with their rates, and what the latest message on one of them says: live, or of a log
      that is played. In a terminal j and k choose the channel and q ends it; else what there is
      after S seconds, or at the end of the log, is printed.
  log_tool to_pictures LOG FOLDER [PART]
      Of each frame the objects over the image, the table from above with the votes of hypotheses,
      and the features; of all frames contact sheets.
  log_tool to_pcd LOG FOLDER [PART]
      Of each frame the measured points with colour and label, and points of the models.

  PART:  --start S and --end S, in seconds from the beginning; --channels A,B

  Ends with 1 when a log is damaged or cannot be read or written, with 2 for a bad command line.
)";

struct CommandLine {
  std::vector<std::string> operands;  // the verb first
  launcher::Excerpt excerpt;
  double speed = 1.0;
  bool loops = false;
  bool shows_graph = false;
  std::string url;
  TopOptions top;
};

std::set<std::string> Split(const std::string& list) {
  std::istringstream words(list);
  std::set<std::string> split;
  for (std::string word; std::getline(words, word, ',');) split.insert(word);
  return split;
}

// Options without a value have none in `arguments`.
CommandLine Parse(const std::vector<std::string>& arguments) {
  CommandLine line;
  using Value = const std::string&;
  const std::map<std::string, std::function<void(Value)>> valued = {
      {"--start", [&](Value value) { line.excerpt.start_s = ParseNumber(value, 0.0); }},
      {"--end", [&](Value value) { line.excerpt.end_s = ParseNumber(value, 0.0); }},
      {"--channels", [&](Value value) { line.excerpt.channels = Split(value); }},
      {"--speed", [&](Value value) { line.speed = ParseNumber(value, launcher::kMinSpeed); }},
      {"--url", [&](Value value) { line.url = value; }},
      {"--channel", [&](Value value) { line.top.channel = value; }},
      {"--seconds", [&](Value value) { line.top.seconds = ParseNumber(value, 0.001); }}};
  const std::map<std::string, bool*> plain = {{"--loop", &line.loops},
                                              {"--graph", &line.shows_graph}};
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& word = arguments[i];
    if (word.rfind("--", 0) != 0) {
      line.operands.push_back(word);
    } else if (const auto flag = plain.find(word); flag != plain.end()) {
      *flag->second = true;
    } else if (const auto option = valued.find(word); option != valued.end()) {
      if (++i == arguments.size()) throw ConfigError(word + ": needs a value");
      option->second(arguments[i]);
    } else {
      throw ConfigError(
          word + ": unknown option" +
          runtime::Suggestion(word, {"--start", "--end", "--channels", "--speed", "--url", "--loop",
                                     "--graph", "--channel", "--seconds"}));
    }
  }
  return line;
}

int Info(const std::string& log, bool shows_graph) {
  const LogSummary summary = Summarise(log);
  if (shows_graph && summary.graph.empty()) {
    throw std::runtime_error(log + ": does not say what made it");
  }
  std::cout << (shows_graph ? summary.graph : Text(summary));
  return summary.damages.empty() ? 0 : kFailure;
}

int Frames(const std::string& log) {
  const FrameSummary summary = SummariseFrames(log);
  std::cout << Text(summary);
  return summary.damages.empty() ? 0 : kFailure;
}

std::string UrlOf(const CommandLine& line) {
  const char* environment_url = std::getenv("LCM_DEFAULT_URL");
  std::string url =
      environment_url != nullptr ? environment_url : "udpm://239.255.76.67:7667?ttl=0";
  if (!line.url.empty()) url = line.url;
  return launcher::WithReceiveBuffer(url);
}

int Top(const CommandLine& line) {
  TopOptions options = line.top;
  options.excerpt = line.excerpt;
  options.speed = line.speed;
  return line.operands.size() > 1 ? WatchLog(line.operands[1], options)
                                  : WatchNetwork(UrlOf(line), options);
}

struct VerbRule {
  size_t min_operands;  // the verb among them
  size_t max_operands;
  const char* needs;
  std::function<int(const CommandLine& line)> act;
};

const std::map<std::string, VerbRule>& VerbRules() {
  using Line = const CommandLine&;
  constexpr const char* kLog = "a log is needed";
  constexpr const char* kLogAndFolder = "a log and a folder are needed";
  static const std::map<std::string, VerbRule> rules = {
      {"info", {2, 2, kLog, [](Line line) { return Info(line.operands[1], line.shows_graph); }}},
      {"frames", {2, 2, kLog, [](Line line) { return Frames(line.operands[1]); }}},
      {"cut",
       {3, 3, "a log is needed, and the name of a new one",
        [](Line line) { return Cut(line.operands[1], line.operands[2], line.excerpt); }}},
      {"play",
       {2, 2, kLog,
        [](Line line) {
          return Play(line.operands[1], line.excerpt, line.speed, line.loops, UrlOf(line));
        }}},
      {"top", {1, 2, "one log, or none", Top}},
      {"to_pictures",
       {3, 3, kLogAndFolder,
        [](Line line) { return WritePictures(line.operands[1], line.operands[2], line.excerpt); }}},
      {"to_pcd", {3, 3, kLogAndFolder, [](Line line) {
                    return WriteClouds(line.operands[1], line.operands[2], line.excerpt);
                  }}}};
  return rules;
}

int Act(const std::vector<std::string>& arguments) {
  if (arguments.empty()) throw ConfigError("what is to be done? --help tells");
  for (const std::string& argument : arguments) {
    if (argument != "--help" && argument != "-h") continue;
    std::cout << kHelp;
    return 0;
  }
  const CommandLine line = Parse(arguments);
  const std::string verb = line.operands.empty() ? "" : line.operands[0];
  const auto rule = VerbRules().find(verb);
  if (rule == VerbRules().end()) {
    std::vector<std::string> verbs;
    for (const auto& [name, unused] : VerbRules()) verbs.push_back(name);
    throw ConfigError("unknown verb '" + verb + "'" + runtime::Suggestion(verb, verbs));
  }
  const auto& [min_operands, max_operands, needs, act] = rule->second;
  if (line.operands.size() < min_operands || line.operands.size() > max_operands) {
    throw ConfigError(verb + ": " + needs);
  }
  return act(line);
}

}  // namespace
}  // namespace declutter::log_tool

int main(int argc, char** argv) {
  using namespace declutter;
  try {
    const int code = log_tool::Act({argv + 1, argv + argc});
    if (std::cout.flush()) return code;
    throw std::runtime_error("stdout cannot be written");
  } catch (const runtime::ConfigError& error) {
    std::cerr << "log_tool: " << error.what() << "\n";
    return log_tool::kBadCommand;
  } catch (const std::exception& error) {
    std::cerr << "log_tool: " << error.what() << "\n";
    return log_tool::kFailure;
  }
}
