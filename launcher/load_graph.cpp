#include "launcher/load_graph.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>
#include <utility>

#include "launcher/find_program.h"
#include "launcher/graph_text.h"
#include "launcher/program_catalog.h"
#include "modules/runtime/config.h"
#include "modules/runtime/parameter_check.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

namespace fs = std::filesystem;
using google::protobuf::TextFormat;
using Config = std::unique_ptr<google::protobuf::Message>;

// Nothing when path cannot be read; a folder opens, but cannot.
std::optional<std::string> ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code ignored;
  if (!file || fs::is_directory(path, ignored)) return std::nullopt;
  return std::string{std::istreambuf_iterator<char>(file), {}};
}

// Loads one graph, step by step; each step needs those before it to be without fault.
class GraphLoader {
 public:
  GraphLoader(const std::string& path, const std::map<std::string, std::string>& swapped,
              std::vector<Fault>* faults)
      : folder_(fs::absolute(path).parent_path()),
        path_(path),
        swapped_(swapped),
        faults_(faults) {}

  bool ReadFile();
  bool FindPrograms();
  bool ReadConfigs();
  bool Assign(const std::vector<std::string>& assignments);
  bool CheckChannels();
  ResolvedGraph Resolve() const;

 private:
  bool CheckName(int module);
  void FindProgram(int module);
  Config ReadConfig(int module);
  void MergeConfigFile(int module, google::protobuf::Message* config);
  std::vector<Fault> FindMissing(int module) const;
  void AssignOne(const std::string& assignment);
  WiredModule Wire(int module);
  std::string PathFromGraph(const std::string& path) const { return folder_ / path; }
  const Module& module(int i) const { return text_->graph().module(i); }
  int num_modules() const { return text_->graph().module_size(); }
  void Add(std::string where, std::string what) {
    faults_->push_back({std::move(where), std::move(what)});
  }
  const ModuleDescription& description(int i) {
    return catalog_.Describe(programs_[static_cast<size_t>(i)]);
  }

  fs::path folder_;
  std::string path_;
  std::map<std::string, std::string> swapped_;  // module -> program
  std::vector<Fault>* faults_;
  std::unique_ptr<GraphText> text_;
  ProgramCatalog catalog_;
  std::vector<std::string> programs_;  // absolute paths
  std::vector<Config> configs_;        // of the catalog's types
  std::vector<WiredModule> wiring_;
};

bool GraphLoader::ReadFile() {
  const std::optional<std::string> text = ReadText(path_);
  if (!text) {
    Add(path_ + ":1:1", "cannot be read");
    return false;
  }
  text_ = std::make_unique<GraphText>(*text, path_);
  if (!text_->ReadModules(faults_)) return false;
  if (num_modules() == 0) Add(path_ + ":1:1", "no module");
  return faults_->empty();
}

bool GraphLoader::CheckName(int i) {
  const std::string& name = module(i).name();
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain)) {
    Add(text_->Where(i, "name"), "name of a module must be letters, digits and _");
    return false;
  }
  // Files of these names lie beside the modules' own.
  if (name == "graph" || name == "launcher") {
    Add(text_->Where(i, "name"), "no module may be named '" + name + "'");
    return false;
  }
  return true;
}

void GraphLoader::FindProgram(int i) {
  const auto swapped = swapped_.find(module(i).name());
  const std::string name = swapped != swapped_.end() ? swapped->second
                           : module(i).has_program() ? module(i).program()
                                                     : module(i).name();
  const std::string where = text_->Where(i, module(i).has_program() ? "program" : "name");
  const bool is_path = name.find('/') != std::string::npos;
  const std::string path = is_path ? PathFromGraph(name) : launcher::FindProgram(name).value_or("");
  programs_.push_back(path);
  if (!IsExecutable(path)) {
    Add(where, "no program '" + name + "' " +
                   (is_path ? "that can be executed" : "beside the launcher or in PATH"));
    return;
  }
  try {
    catalog_.Describe(path);
  } catch (const std::runtime_error& error) {
    Add(where, error.what());
  }
}

bool GraphLoader::FindPrograms() {
  std::set<std::string> names;
  for (int i = 0; i < num_modules(); ++i) {
    if (!CheckName(i)) continue;
    if (!names.insert(module(i).name()).second) {
      Add(text_->Where(i, "name"), "a second module named " + module(i).name());
    }
    FindProgram(i);
  }
  return faults_->empty();
}

void GraphLoader::MergeConfigFile(int i, google::protobuf::Message* config) {
  if (!module(i).has_config_file()) return;
  const std::string path = PathFromGraph(module(i).config_file());
  const std::optional<std::string> text = ReadText(path);
  if (!text) {
    Add(text_->Where(i, "config_file"), path + ": cannot be read");
    return;
  }
  try {
    runtime::ParseConfig(*text, path, config);
  } catch (const runtime::ConfigFileError& error) {
    Add("", error.what());  // names its place itself
  }
}

Config GraphLoader::ReadConfig(int i) {
  const auto* type = catalog_.FindType(description(i).config_type());
  Config config = catalog_.NewMessage(type);
  MergeConfigFile(i, config.get());
  if (!module(i).has_config()) return config;
  const Config layer = catalog_.NewMessage(type);
  if (!module(i).config().UnpackTo(layer.get())) {
    if (swapped_.count(module(i).name()) != 0) return config;
    Add(text_->Where(i, "config"), "parameters of " + module(i).name() + " are of type " +
                                       type->full_name() + ", not " +
                                       module(i).config().type_url());
    return config;
  }
  text_->CheckConfig(i, *layer, faults_);
  config->MergeFrom(*layer);
  return config;
}

bool GraphLoader::ReadConfigs() {
  if (!text_->ReadAll(catalog_, faults_)) return false;
  for (int i = 0; i < num_modules(); ++i) configs_.push_back(ReadConfig(i));
  return faults_->empty();
}

void GraphLoader::AssignOne(const std::string& assignment) {
  const std::string where = "--set " + assignment;
  const size_t dot = assignment.find('.');
  if (dot == std::string::npos || dot > assignment.find('=')) {
    return Add(where, "not of the form module.field=value");
  }
  const std::string name = assignment.substr(0, dot);
  const std::string field = assignment.substr(dot + 1);
  std::vector<std::string> names;
  for (int i = 0; i < num_modules(); ++i) {
    names.push_back(module(i).name());
    if (name != names.back()) continue;
    try {
      return runtime::SetField(field, configs_[static_cast<size_t>(i)].get());
    } catch (const runtime::ConfigError& error) {
      const std::string prefix = "--set " + field + ": ";
      const std::string what = error.what();
      return Add(where,
                 what.compare(0, prefix.size(), prefix) == 0 ? what.substr(prefix.size()) : what);
    }
  }
  Add(where, "no module named '" + name + "'" + runtime::Suggestion(name, names));
}

bool GraphLoader::Assign(const std::vector<std::string>& assignments) {
  for (const std::string& assignment : assignments) AssignOne(assignment);
  return faults_->empty();
}

std::vector<Fault> GraphLoader::FindMissing(int i) const {
  try {
    runtime::CheckComplete(*configs_[static_cast<size_t>(i)]);
    return {};
  } catch (const runtime::ConfigError& error) {
    return {{text_->Where(i, "config"), module(i).name() + "." + error.what()}};
  }
}

WiredModule GraphLoader::Wire(int i) {
  std::map<std::string, std::string> names;
  std::set<std::string> unused;
  for (const Remap& remap : module(i).remap()) {
    names[remap.from()] = remap.to();
    unused.insert(remap.from());
  }
  const auto renamed = [&](const ModuleDescription::Port& port) {
    unused.erase(port.channel());
    const auto found = names.find(port.channel());
    return Port{found == names.end() ? port.channel() : found->second, port.type()};
  };
  WiredModule wired{module(i).name(), text_->Where(i, ""), {}, {}};
  for (const auto& port : description(i).input()) wired.inputs.push_back(renamed(port));
  for (const auto& port : description(i).output()) wired.outputs.push_back(renamed(port));
  for (const std::string& channel : unused) {
    Add(wired.where, module(i).name() + " has no channel " + channel + " to remap");
  }
  return wired;
}

bool GraphLoader::CheckChannels() {
  for (int i = 0; i < num_modules(); ++i) wiring_.push_back(Wire(i));
  for (Fault& fault : CheckWiring(wiring_)) faults_->push_back(std::move(fault));
  return faults_->empty();
}

ResolvedGraph GraphLoader::Resolve() const {
  Graph graph = text_->graph();
  ResolvedGraph resolved;
  resolved.lossless = graph.lossless();
  TextFormat::Printer printer;
  printer.SetExpandAny(true);
  printer.SetFinder(&catalog_);
  for (int i = 0; i < graph.module_size(); ++i) {
    const auto index = static_cast<size_t>(i);
    Module* module = graph.mutable_module(i);
    module->set_program(programs_[index]);
    module->clear_config_file();
    module->mutable_config()->PackFrom(*configs_[index]);
    std::string config_text;
    printer.PrintToString(*configs_[index], &config_text);
    resolved.modules.push_back({*module, config_text, wiring_[index], FindMissing(i)});
  }
  printer.PrintToString(graph, &resolved.text);
  return resolved;
}

}  // namespace

std::optional<ResolvedGraph> LoadGraph(const std::string& path,
                                       const std::vector<std::string>& assignments,
                                       const std::map<std::string, std::string>& swapped,
                                       std::vector<Fault>* faults) {
  GraphLoader loader(path, swapped, faults);
  const bool is_good = loader.ReadFile() && loader.FindPrograms() && loader.ReadConfigs() &&
                       loader.Assign(assignments) && loader.CheckChannels();
  if (!is_good) return std::nullopt;
  return loader.Resolve();
}

}  // namespace declutter::launcher
