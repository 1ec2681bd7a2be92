#include "modules/runtime/command_line.h"

#include <algorithm>
#include <cctype>
#include <functional>

#include "modules/runtime/config_error.h"
#include "modules/runtime/suggestion.h"

namespace declutter::runtime {
namespace {

struct Option {
  std::string flag;
  std::string argument;  // empty: takes none
  std::string help;
  std::function<void(const std::string& value, CommandLine*)> apply;
};

void SetOnce(const std::string& value, std::string* field) {
  if (!field->empty()) throw ConfigError("given twice");
  if (value.empty()) throw ConfigError("must not be empty");
  *field = value;
}

void SetAction(CommandLine::Action action, CommandLine* line) {
  if (line->action != CommandLine::Action::kRun) throw ConfigError("one action at a time");
  line->action = action;
}

// LCM takes channel names as patterns of at most 63 characters.
bool IsChannel(const std::string& name) {
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  return !name.empty() && name.size() <= 63 && std::all_of(name.begin(), name.end(), is_plain);
}

void AddRemap(const std::string& value, CommandLine* line) {
  const std::size_t equals = value.find('=');
  const std::string from = value.substr(0, equals);
  const std::string to = equals == std::string::npos ? "" : value.substr(equals + 1);
  if (!IsChannel(from) || !IsChannel(to)) {
    throw ConfigError("'" + value + "' is not of the form CHANNEL=CHANNEL");
  }
  if (!line->remap.emplace(from, to).second) throw ConfigError(from + " is remapped twice");
}

const std::vector<Option>& Options() {
  using Action = CommandLine::Action;
  using Value = const std::string&;
  static const std::vector<Option> options = {
      {"--config", "FILE", "parameters as protobuf text",
       [](Value value, CommandLine* line) { SetOnce(value, &line->config_file); }},
      {"--set", "FIELD=VALUE", "one parameter; a.b=VALUE for nested ones, repeated ones append",
       [](Value value, CommandLine* line) { line->assignments.push_back(value); }},
      {"--name", "NAME", "name in the graph; the program's unless given",
       [](Value value, CommandLine* line) { SetOnce(value, &line->name); }},
      {"--remap", "FROM=TO", "use channel TO where the module says FROM",
       [](Value value, CommandLine* line) { AddRemap(value, line); }},
      {"--lossless", "", "skip no frame, for recordings",
       [](Value, CommandLine* line) { line->lossless = true; }},
      {"--hold", "", "keep what arrives until a time [us] on stdin, and handle what is later",
       [](Value, CommandLine* line) { line->hold = true; }},
      {"--replay", "LOG", "read the inputs from a log, not from the network",
       [](Value value, CommandLine* line) { SetOnce(value, &line->replay); }},
      {"--record", "LOG", "write the results of --replay to a new log",
       [](Value value, CommandLine* line) { SetOnce(value, &line->record); }},
      {"--print_config", "", "print all parameters as they would be used",
       [](Value, CommandLine* line) { SetAction(Action::kPrintConfig, line); }},
      {"--describe", "", "print channels and parameters for programs",
       [](Value, CommandLine* line) { SetAction(Action::kDescribe, line); }},
      {"--help", "", "print this",
       [](Value, CommandLine* line) { SetAction(Action::kHelp, line); }},
  };
  return options;
}

const Option& FindOption(const std::string& flag) {
  std::vector<std::string> flags;
  for (const Option& option : Options()) {
    if (option.flag == flag) return option;
    flags.push_back(option.flag);
  }
  throw ConfigError("unknown option" + Suggestion(flag, flags));
}

// Applies the option at argv[i]; returns the index of the last argument that belongs to it.
int ApplyOption(int argc, const char* const* argv, int i, CommandLine* line) {
  const std::string argument = argv[i];
  const std::size_t equals = argument.find('=');
  const std::string flag = argument.substr(0, equals);
  try {
    const Option& option = FindOption(flag);
    const bool has_value = equals != std::string::npos;
    if (option.argument.empty() && has_value) throw ConfigError("takes no value");
    if (option.argument.empty() || has_value) {
      option.apply(has_value ? argument.substr(equals + 1) : "", line);
      return i;
    }
    if (i + 1 == argc) throw ConfigError("needs " + option.argument);
    option.apply(argv[i + 1], line);
    return i + 1;
  } catch (const ConfigError& error) {
    throw ConfigError(flag + ": " + error.what());
  }
}

}  // namespace

CommandLine ParseCommandLine(int argc, const char* const* argv) {
  CommandLine line;
  const std::string path = argc > 0 ? argv[0] : "";
  line.program = path.substr(path.find_last_of('/') + 1);
  for (int i = 1; i < argc; ++i) i = ApplyOption(argc, argv, i, &line);
  if (line.name.empty()) line.name = line.program;
  if (!line.record.empty() && line.replay.empty()) {
    throw ConfigError("--record: needs --replay; lcm-logger records the network");
  }
  return line;
}

std::string OptionsHelp() {
  constexpr std::size_t kColumn = 22;
  std::string text;
  for (const Option& option : Options()) {
    std::string head = "  " + option.flag + ' ' + option.argument;
    head.resize(std::max(kColumn, head.size() + 1), ' ');
    text += head + option.help + '\n';
  }
  return text;
}

}  // namespace declutter::runtime
