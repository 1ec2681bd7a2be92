#include "launcher/module_configs.h"

#include "modules/runtime/config.h"
#include "modules/runtime/parameter_check.h"
#include "modules/runtime/suggestion.h"

namespace declutter::launcher {
namespace {

void MergeFile(const MergedModule::Layer& layer, google::protobuf::Message* config,
               std::vector<Fault>* faults) {
  const std::string path = layer.text->PathFromHere(layer.module().config_file());
  const std::optional<std::string> text = ReadText(path);
  if (!text) {
    faults->push_back({layer.text->Where(layer.index, "config_file"), path + ": cannot be read"});
    return;
  }
  try {
    runtime::ParseConfig(*text, path, config);
  } catch (const runtime::ConfigFileError& error) {
    faults->push_back({"", error.what()});  // names its place itself
  }
}

}  // namespace

Config ReadConfig(const MergedModule& module, const google::protobuf::Descriptor* type,
                  bool skips_other_types, ProgramCatalog* catalog, std::vector<Fault>* faults) {
  Config config = catalog->NewMessage(type);
  for (const MergedModule::Layer& layer : module.layers) {
    if (layer.module().has_config_file()) MergeFile(layer, config.get(), faults);
    if (!layer.module().has_config()) continue;
    const Config own = catalog->NewMessage(type);
    if (layer.module().config().UnpackTo(own.get())) {
      layer.text->CheckConfig(layer.index, *own, faults);
      config->MergeFrom(*own);
    } else if (!skips_other_types) {
      faults->push_back({layer.text->Where(layer.index, "config"),
                         "parameters of " + module.name() + " are of type " + type->full_name() +
                             ", not " + layer.module().config().type_url()});
    }
  }
  return config;
}

void Assign(const std::string& assignment, const std::vector<MergedModule>& modules,
            std::vector<Config>* configs, std::vector<Fault>* faults) {
  const std::string where = "--set " + assignment;
  const size_t dot = assignment.find('.');
  if (dot == std::string::npos || dot > assignment.find('=')) {
    faults->push_back({where, "not of the form module.field=value"});
    return;
  }
  const std::string name = assignment.substr(0, dot);
  const std::string field = assignment.substr(dot + 1);
  std::vector<std::string> names;
  for (size_t i = 0; i < modules.size(); ++i) {
    names.push_back(modules[i].name());
    if (name != names.back()) continue;
    try {
      return runtime::SetField(field, (*configs)[i].get());
    } catch (const runtime::ConfigError& error) {
      const std::string prefix = "--set " + field + ": ";
      const std::string what = error.what();
      const bool is_prefixed = what.compare(0, prefix.size(), prefix) == 0;
      faults->push_back({where, is_prefixed ? what.substr(prefix.size()) : what});
      return;
    }
  }
  faults->push_back({where, "no module named '" + name + "'" + runtime::Suggestion(name, names)});
}

std::vector<Fault> FindMissing(const MergedModule& module,
                               const google::protobuf::Message& config) {
  try {
    runtime::CheckComplete(config);
    return {};
  } catch (const runtime::ConfigError& error) {
    return {{module.Where("config"), module.name() + "." + error.what()}};
  }
}

}  // namespace declutter::launcher
