#include "launcher/load_graph.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "launcher/find_program.h"
#include "launcher/module_configs.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

using google::protobuf::TextFormat;

// Loads one graph, step by step; each step needs those before it to be without fault.
class GraphLoader {
 public:
  GraphLoader(const std::string& path, const std::map<std::string, std::string>& swapped,
              ProgramCatalog* catalog, std::vector<Fault>* faults)
      : files_(path), swapped_(swapped), faults_(faults), catalog_(*catalog) {}

  bool ReadFiles() { return files_.ReadModules(faults_); }
  bool CheckModules();
  bool ReadConfigs(const std::vector<std::string>& assignments);
  bool CheckChannels();
  ResolvedGraph Resolve();

 private:
  bool CheckName(const MergedModule& module);
  void CheckSettings(const MergedModule& module);
  void FindProgram(const MergedModule& module);
  std::vector<std::string> ModulesBefore(const MergedModule& module);
  WiredModule Wire(size_t index);
  const std::vector<MergedModule>& modules() const { return files_.modules(); }
  const ModuleDescription& description(size_t i) { return catalog_.Describe(programs_[i]); }
  void Add(std::string where, std::string what) {
    faults_->push_back({std::move(where), std::move(what)});
  }

  GraphFiles files_;
  std::map<std::string, std::string> swapped_;  // module -> program
  std::vector<Fault>* faults_;
  ProgramCatalog& catalog_;
  std::vector<std::string> programs_;  // absolute paths
  std::vector<Config> configs_;        // of the catalog's types
  std::vector<WiredModule> wiring_;
};

bool GraphLoader::CheckName(const MergedModule& module) {
  const std::string& name = module.name();
  const auto is_plain = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain)) {
    Add(module.Where("name"), "name of a module must be letters, digits and _");
    return false;
  }
  // Files of these names lie beside the modules' own.
  if (name == "graph" || name == "launcher") {
    Add(module.Where("name"), "no module may be named '" + name + "'");
    return false;
  }
  return true;
}

void GraphLoader::CheckSettings(const MergedModule& module) {
  for (const std::string& variable : module.module.env()) {
    if (variable.find('=') != std::string::npos && variable[0] != '=') continue;
    Add(module.Where("env"), "env '" + variable + "' is not of the form NAME=VALUE");
  }
  const auto num_cpus = static_cast<int>(sysconf(_SC_NPROCESSORS_CONF));
  for (const int cpu : module.module.cpu()) {
    if (cpu >= 0 && cpu < num_cpus) continue;
    Add(module.Where("cpu"),
        "cpu " + std::to_string(cpu) + ": this machine has 0 to " + std::to_string(num_cpus - 1));
  }
}

void GraphLoader::FindProgram(const MergedModule& module) {
  const bool is_given = module.module.has_program();
  const auto swapped = swapped_.find(module.name());
  const std::string name = swapped != swapped_.end() ? swapped->second
                           : is_given                ? module.module.program()
                                                     : module.name();
  const std::string where = module.Where(is_given ? "program" : "name");
  const bool is_path = name.find('/') != std::string::npos;
  const std::string path = is_path ? name : launcher::FindProgram(name).value_or("");
  programs_.push_back(path);
  if (!IsExecutable(path)) {
    Add(where, "no program '" + name + "' " +
                   (is_path ? "that can be executed" : "beside the launcher or in PATH"));
    return;
  }
  try {
    // Parameters in the graph are of the program that is replaced.
    if (swapped != swapped_.end() && IsExecutable(module.module.program())) {
      catalog_.Describe(module.module.program());
    }
    catalog_.Describe(path);
  } catch (const std::runtime_error& error) {
    Add(where, error.what());
  }
}

bool GraphLoader::CheckModules() {
  for (const MergedModule& module : modules()) {
    if (!CheckName(module)) continue;
    CheckSettings(module);
    FindProgram(module);
  }
  return faults_->empty();
}

bool GraphLoader::ReadConfigs(const std::vector<std::string>& assignments) {
  if (!files_.ReadAll(catalog_, faults_)) return false;
  for (size_t i = 0; i < modules().size(); ++i) {
    const MergedModule& module = modules()[i];
    const auto* type = catalog_.FindType(description(i).config_type());
    configs_.push_back(
        ReadConfig(module, type, swapped_.count(module.name()) != 0, &catalog_, faults_));
  }
  if (!faults_->empty()) return false;
  for (const std::string& assignment : assignments) {
    Assign(assignment, modules(), &configs_, faults_);
  }
  return faults_->empty();
}

std::vector<std::string> GraphLoader::ModulesBefore(const MergedModule& module) {
  std::vector<std::string> before;
  for (const std::string& name : module.module.after()) {
    bool is_known = false;
    std::vector<std::string> known;
    for (const MergedModule& other : modules()) {
      const auto& groups = other.module.group();
      known.push_back(other.name());
      known.insert(known.end(), groups.begin(), groups.end());
      const bool is_in = std::count(groups.begin(), groups.end(), name) != 0;
      is_known = is_known || is_in || other.name() == name;
      // A member of a group may be after the rest of it.
      if (other.name() == name || (is_in && &other != &module)) before.push_back(other.name());
    }
    if (is_known) continue;
    Add(module.Where("after"),
        "after: no module or group named '" + name + "'" + runtime::Suggestion(name, known));
  }
  return before;
}

WiredModule GraphLoader::Wire(size_t i) {
  const MergedModule& module = modules()[i];
  std::map<std::string, std::string> names;
  std::set<std::string> unused;
  for (const Remap& remap : module.module.remap()) {
    names[remap.from()] = remap.to();
    unused.insert(remap.from());
  }
  const auto renamed = [&](const ModuleDescription::Port& port) {
    unused.erase(port.channel());
    const auto found = names.find(port.channel());
    return Port{found == names.end() ? port.channel() : found->second, port.type()};
  };
  WiredModule wired{module.name(), module.Where(""), {}, {}, ModulesBefore(module)};
  for (const auto& port : description(i).input()) wired.inputs.push_back(renamed(port));
  for (const auto& port : description(i).output()) wired.outputs.push_back(renamed(port));
  for (const std::string& channel : unused) {
    Add(wired.where, module.name() + " has no channel " + channel + " to remap");
  }
  return wired;
}

bool GraphLoader::CheckChannels() {
  for (size_t i = 0; i < modules().size(); ++i) wiring_.push_back(Wire(i));
  for (Fault& fault : CheckWiring(wiring_, files_.external())) faults_->push_back(std::move(fault));
  return faults_->empty();
}

ResolvedGraph GraphLoader::Resolve() {
  ResolvedGraph resolved;
  resolved.lossless = files_.lossless();
  resolved.logger = files_.logger();
  resolved.external = files_.external();
  for (size_t i = 0; i < modules().size(); ++i) {
    Module module = modules()[i].module;
    module.set_program(programs_[i]);
    module.mutable_config()->PackFrom(*configs_[i]);
    std::string config_text;
    TextFormat::PrintToString(*configs_[i], &config_text);
    resolved.modules.push_back({module, description(i).version(), config_text, wiring_[i],
                                FindMissing(modules()[i], *configs_[i])});
  }
  return resolved;
}

}  // namespace

std::optional<ResolvedGraph> LoadGraph(const std::string& path,
                                       const std::vector<std::string>& assignments,
                                       const std::map<std::string, std::string>& swapped,
                                       ProgramCatalog* catalog, std::vector<Fault>* faults) {
  GraphLoader loader(path, swapped, catalog, faults);
  const bool is_good = loader.ReadFiles() && loader.CheckModules() &&
                       loader.ReadConfigs(assignments) && loader.CheckChannels();
  if (!is_good) return std::nullopt;
  return loader.Resolve();
}

}  // namespace declutter::launcher
