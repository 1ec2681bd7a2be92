#include "launcher/command_line.h"

#include <functional>

#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

using runtime::ConfigError;
using Verb = CommandLine::Verb;

constexpr const char* kHelp = R"(launcher: runs a graph of modules

  launcher check GRAPH [--set MODULE.FIELD=VALUE]...
      Checks a graph with all its parameters and channels; prints it resolved.
  launcher run GRAPH [OPTION]...
      Runs it until its sources have ended or a signal comes (a second one kills).
      --set MODULE.FIELD=VALUE   one parameter; strings without quotes
      --record LOG               write all messages to a new LCM log
      --replay LOG               take the messages of the sources from a log, skipping no frame
      --from MODULE              with --replay: run only MODULE and what is downstream of it
      --url URL                  LCM network (else LCM_DEFAULT_URL, else one of its own)
      --log_dir DIR              where the folder of this run is made (else logs of the project)

  Ends with 0 when all went well, also when a signal ends a live graph; with 128 + the signal's
  number when it cuts a lossless graph short; else with the code of the first module that failed
  (1: failure or crash, 2: bad configuration).
)";

struct Option {
  std::string flag;
  bool is_run_only;
  std::function<void(const std::string& value, CommandLine*)> apply;
};

void SetOnce(const std::string& value, std::string* field) {
  if (!field->empty()) throw ConfigError("given twice");
  if (value.empty()) throw ConfigError("must not be empty");
  *field = value;
}

const std::vector<Option>& Options() {
  using Value = const std::string&;
  static const std::vector<Option> options = {
      {"--set", false, [](Value value, CommandLine* l) { l->assignments.push_back(value); }},
      {"--record", true, [](Value value, CommandLine* l) { SetOnce(value, &l->record); }},
      {"--replay", true, [](Value value, CommandLine* l) { SetOnce(value, &l->replay); }},
      {"--from", true, [](Value value, CommandLine* l) { SetOnce(value, &l->from); }},
      {"--url", true, [](Value value, CommandLine* l) { SetOnce(value, &l->url); }},
      {"--log_dir", true, [](Value value, CommandLine* l) { SetOnce(value, &l->logs); }},
  };
  return options;
}

Verb ParseVerb(const std::string& word) {
  if (word == "check") return Verb::kCheck;
  if (word == "run") return Verb::kRun;
  throw ConfigError("unknown verb '" + word + "'" + runtime::Suggestion(word, {"check", "run"}) +
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
    if (option.is_run_only && line->verb != Verb::kRun) throw ConfigError("is for run only");
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
  for (const std::string& argument : arguments) {
    if (IsHelp(argument)) return line;
  }
  if (arguments.empty()) throw ConfigError("check or run what? --help tells more");
  line.verb = ParseVerb(arguments[0]);
  for (size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i].rfind("--", 0) == 0) {
      i = ApplyOption(arguments, i, &line);
    } else if (line.graph.empty()) {
      line.graph = arguments[i];
    } else {
      throw ConfigError("one graph at a time, not also " + arguments[i]);
    }
  }
  if (!line.from.empty() && line.replay.empty()) throw ConfigError("--from: needs --replay");
  if (line.graph.empty()) throw ConfigError(arguments[0] + " needs a graph");
  return line;
}

std::string HelpText() { return kHelp; }

}  // namespace declutter::launcher
