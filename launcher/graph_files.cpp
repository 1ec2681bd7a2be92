#include "launcher/graph_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

namespace declutter::launcher {
namespace {

namespace fs = std::filesystem;

// Puts the fields that are set in layer on top of module; a list takes the place of a list.
void PutOnTop(const Module& layer, Module* module) {
  std::vector<const google::protobuf::FieldDescriptor*> fields;
  layer.GetReflection()->ListFields(layer, &fields);
  for (const auto* field : fields) {
    if (field->is_repeated()) module->GetReflection()->ClearField(module, field);
  }
  module->MergeFrom(layer);
  module->clear_config();
  module->clear_config_file();
}

}  // namespace

std::optional<std::string> ReadText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::error_code ignored;
  if (!file || fs::is_directory(path, ignored)) return std::nullopt;  // a folder opens
  return std::string{std::istreambuf_iterator<char>(file), {}};
}

std::string MergedModule::Where(const std::string& field) const {
  const auto* descriptor = Module::descriptor()->FindFieldByName(field);
  for (auto layer = layers.rbegin(); descriptor != nullptr && layer != layers.rend(); ++layer) {
    const auto* reflection = layer->module().GetReflection();
    const bool is_set = descriptor->is_repeated()
                            ? reflection->FieldSize(layer->module(), descriptor) > 0
                            : reflection->HasField(layer->module(), descriptor);
    if (is_set) return layer->text->Where(layer->index, field);
  }
  return layers.back().text->Where(layers.back().index, field);
}

bool GraphFiles::ReadModules(std::vector<Fault>* faults) {
  ReadFile(path_, path_ + ":1:1", {}, faults);
  if (!faults->empty()) return false;
  for (const auto& file : files_) Merge(*file, faults);
  if (modules_.empty()) faults->push_back({path_ + ":1:1", "no module"});
  modules_.erase(std::remove_if(modules_.begin(), modules_.end(),
                                [](const MergedModule& m) { return m.module.disabled(); }),
                 modules_.end());
  return faults->empty();
}

bool GraphFiles::ReadAll(const ProgramCatalog& catalog, std::vector<Fault>* faults) {
  for (const auto& file : files_) file->ReadAll(catalog, faults);
  return faults->empty();
}

void GraphFiles::ReadFile(const std::string& path, const std::string& where,
                          const std::vector<std::string>& includers, std::vector<Fault>* faults) {
  const std::optional<std::string> text = ReadText(path);
  if (!text) {
    faults->push_back({where, (includers.empty() ? "" : path + ": ") + "cannot be read"});
    return;
  }
  const std::string full_path = fs::canonical(path);
  if (std::count(includers.begin(), includers.end(), full_path) != 0) {
    faults->push_back({where, path + " includes itself"});
    return;
  }
  std::vector<std::string> stack = includers;
  stack.push_back(full_path);
  auto file = std::make_unique<GraphText>(*text, path);
  if (!file->ReadModules(faults)) return;
  for (int i = 0; i < file->graph().include_size(); ++i) {
    ReadFile(file->PathFromHere(file->graph().include(i)), file->WhereInclude(i), stack, faults);
  }
  files_.push_back(std::move(file));
}

void GraphFiles::Merge(const GraphText& text, std::vector<Fault>* faults) {
  if (text.graph().has_lossless()) lossless_ = text.graph().lossless();
  if (text.graph().has_logger()) logger_ = text.graph().logger();
  const auto& external = text.graph().external();
  if (!external.empty()) external_ = {external.begin(), external.end()};
  for (int i = 0; i < text.graph().module_size(); ++i) MergeModule(text, i, faults);
}

void GraphFiles::MergeModule(const GraphText& text, int index, std::vector<Fault>* faults) {
  Module layer = text.graph().module(index);
  if (layer.program().find('/') != std::string::npos) {
    layer.set_program(text.PathFromHere(layer.program()));
  }
  auto module = std::find_if(modules_.begin(), modules_.end(),
                             [&](const MergedModule& m) { return m.name() == layer.name(); });
  if (module == modules_.end()) module = modules_.insert(module, MergedModule{});
  for (const MergedModule::Layer& other : module->layers) {
    if (other.text != &text) continue;
    faults->push_back({text.Where(index, "name"), "a second module named " + layer.name()});
  }
  PutOnTop(layer, &module->module);
  module->layers.push_back({&text, index});
}

}  // namespace declutter::launcher
