#include "launcher/command_line.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

using runtime::ConfigError;
using Verb = CommandLine::Verb;

constexpr const char* kHelp = R"(launcher: runs a graph of modules

  launcher check GRAPH [--set MODULE.FIELD=VALUE]... [--dot]
      Checks a graph with all its parameters and channels; prints it resolved, or for Graphviz.
  launcher run GRAPH [OPTION]...
      Runs it until its sources have ended or a signal comes (a second one kills).
      --set MODULE.FIELD=VALUE   one parameter; strings without quotes
      --only A,B                 these modules and groups; what they need comes from elsewhere
      --without A,B              all but these
      --record LOG               write all messages to a new LCM log
      --replay LOG               take the messages of the sources from a log, skipping no frame
      --from MODULE              with --replay: run only MODULE and what is downstream of it
      --speed X                  with --replay: X times as fast as it was recorded, skipping frames
                                 as with a sensor
      --start S, --end S         with --replay: a part of the log, in seconds from its beginning
      --loop                     with --replay: again and again
      --url URL                  LCM network (else LCM_DEFAULT_URL, else one of its own)
      --isolate                  in a network of its own, which nobody else can reach
      --log_dir DIR              where the folder of this run is made (else logs of the project)

  Of the graph that was started last, or of the one with the run folder --run DIR:

  launcher status [--watch]
      A line for each process: state, restarts, load, frames in, out and lost, frames per second,
      ms per frame, and latency: ms from the first message of a frame to its end, in this process.
  launcher start MODULE, launcher stop MODULE, launcher restart MODULE
      Returns when it runs or has ended; with 1 when it does not come up.
  launcher swap MODULE PROGRAM [--set MODULE.FIELD=VALUE]...
      Lets PROGRAM, or the same one with other parameters, take over from MODULE without losing a
      frame; MODULE goes on when PROGRAM does not get ready.
  launcher logs MODULE [--follow]
      What it has printed; of "launcher" what that has done.

  launcher doctor [--log_dir DIR]
      Looks at what a run needs from this machine, and tells what mends what is missing.

  In a terminal the space bar stops a replay and lets it go on; n gives the next frame while it is
  stopped.

  run ends with 0 when all went well, also when a signal ends a live graph; with 128 + the signal's
  number when it cuts a lossless graph short; else with the code of the first required module that
  failed (1: failure or crash, 2: bad configuration).
)";

struct VerbRule {
  std::string word;
  Verb verb;
  std::vector<std::pair<std::string, std::string CommandLine::*>> operands;
};

const std::vector<VerbRule>& VerbRules() {
  static const std::vector<VerbRule> rules = {
      {"check", Verb::kCheck, {{"a graph", &CommandLine::graph}}},
      {"run", Verb::kRun, {{"a graph", &CommandLine::graph}}},
      {"status", Verb::kStatus, {}},
      {"start", Verb::kStart, {{"a module", &CommandLine::module}}},
      {"stop", Verb::kStop, {{"a module", &CommandLine::module}}},
      {"restart", Verb::kRestart, {{"a module", &CommandLine::module}}},
      {"swap",
       Verb::kSwap,
       {{"a module", &CommandLine::module}, {"a program", &CommandLine::program}}},
      {"doctor", Verb::kDoctor, {}},
      {"logs", Verb::kLogs, {{"a module", &CommandLine::module}}},
  };
  return rules;
}

using VerbSet = std::vector<Verb>;

struct Option {
  std::string flag;
  VerbSet verbs;  // that know it
  std::function<void(const std::string& value, CommandLine*)> apply;
  bool has_value = true;
};

// Of a replay: a number from min, given to take.
Option Number(const std::string& flag, double min,
              const std::function<void(double number, CommandLine*)>& take) {
  return {flag, {Verb::kRun}, [min, take](const std::string& value, CommandLine* line) {
            take(ParseNumber(value, min), line);
          }};
}

Option Once(const std::string& flag, const VerbSet& verbs, std::string CommandLine::*field) {
  return {flag, verbs, [field](const std::string& value, CommandLine* line) {
            if (!(line->*field).empty()) throw ConfigError("given twice");
            if (value.empty()) throw ConfigError("must not be empty");
            line->*field = value;
          }};
}

const std::vector<Option>& Options() {
  const VerbSet run = {Verb::kRun};
  const VerbSet asking = {Verb::kStatus,  Verb::kStart, Verb::kStop,
                          Verb::kRestart, Verb::kSwap,  Verb::kLogs};
  const auto follow = [](const std::string&, CommandLine* line) { line->follows = true; };
  static const std::vector<Option> options = {
      {"--set",
       {Verb::kCheck, Verb::kRun, Verb::kSwap},
       [](const std::string& value, CommandLine* line) { line->assignments.push_back(value); }},
      Once("--only", run, &CommandLine::only),
      Once("--without", run, &CommandLine::without),
      Once("--record", run, &CommandLine::record),
      Once("--replay", run, &CommandLine::replay),
      Once("--from", run, &CommandLine::from),
      Number("--speed", kMinSpeed, [](double x, CommandLine* line) { line->speed = x; }),
      Number("--start", 0.0, [](double x, CommandLine* line) { line->part.start_s = x; }),
      Number("--end", 0.0, [](double x, CommandLine* line) { line->part.end_s = x; }),
      {"--loop", run, [](const std::string&, CommandLine* line) { line->loops = true; }, false},
      Once("--url", run, &CommandLine::url),
      {"--isolate", run, [](const std::string&, CommandLine* line) { line->is_isolated = true; },
       false},
      Once("--log_dir", {Verb::kRun, Verb::kDoctor}, &CommandLine::logs),
      Once("--run", asking, &CommandLine::run_folder),
      {"--dot",
       {Verb::kCheck},
       [](const std::string&, CommandLine* line) { line->draws = true; },
       false},
      {"--watch", {Verb::kStatus}, follow, false},
      {"--follow", {Verb::kLogs}, follow, false},
      {"-f", {Verb::kLogs}, follow, false},
  };
  return options;
}

const VerbRule& FindVerb(const std::string& word) {
  std::vector<std::string> words;
  for (const VerbRule& rule : VerbRules()) {
    if (rule.word == word) return rule;
    words.push_back(rule.word);
  }
  throw ConfigError("unknown verb '" + word + "'" + runtime::Suggestion(word, words) +
                    "; --help tells more");
}

const Option& FindOption(const std::string& flag) {
  std::vector<std::string> flags;
  for (const Option& option : Options()) {
    if (option.flag == flag) return option;
    flags.push_back(option.flag);
  }
  throw ConfigError("unknown option" + runtime::Suggestion(flag, flags));
}

// Applies the option at arguments[i], `--flag value` or `--flag=value`; returns the index of the
// last argument that belongs to it.
size_t ApplyOption(const std::vector<std::string>& arguments, size_t i, CommandLine* line) {
  const size_t equals = arguments[i].find('=');
  const std::string flag = arguments[i].substr(0, equals);
  try {
    const Option& option = FindOption(flag);
    if (std::count(option.verbs.begin(), option.verbs.end(), line->verb) == 0) {
      throw ConfigError("is not for " + line->word);
    }
    if (!option.has_value) {
      if (equals != std::string::npos) throw ConfigError("takes no value");
      option.apply("", line);
      return i;
    }
    if (equals != std::string::npos) {
      option.apply(arguments[i].substr(equals + 1), line);
      return i;
    }
    if (i + 1 == arguments.size()) throw ConfigError("needs a value");
    option.apply(arguments[i + 1], line);
    return i + 1;
  } catch (const ConfigError& error) {
    throw ConfigError(flag + ": " + error.what());
  }
}

bool IsHelp(const std::string& word) { return word == "--help" || word == "-h"; }

}  // namespace

CommandLine ParseCommandLine(const std::vector<std::string>& arguments) {
  CommandLine line;
  if (std::any_of(arguments.begin(), arguments.end(), IsHelp)) return line;
  if (arguments.empty()) throw ConfigError("what is to be done? --help tells more");
  const VerbRule& rule = FindVerb(arguments[0]);
  line.verb = rule.verb;
  line.word = rule.word;
  auto operand = rule.operands.begin();
  for (size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i].rfind('-', 0) == 0) {
      i = ApplyOption(arguments, i, &line);
    } else if (operand != rule.operands.end()) {
      line.*(operand++)->second = arguments[i];
    } else {
      throw ConfigError(rule.word + ": what is " + arguments[i] + "?");
    }
  }
  const bool is_whole = line.part.start_s == 0.0 && std::isinf(line.part.end_s);
  const bool wants_replay = !line.from.empty() || line.speed || line.loops || !is_whole;
  if (wants_replay && line.replay.empty()) {
    throw ConfigError("--from, --speed, --start, --end and --loop need --replay");
  }
  if (operand != rule.operands.end()) throw ConfigError(rule.word + " needs " + operand->first);
  return line;
}

std::string HelpText() { return kHelp; }

}  // namespace declutter::launcher
