#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "launcher/graph_text.h"

namespace declutter::launcher {

// Nothing when path cannot be read as a file.
std::optional<std::string> ReadText(const std::string& path);

// A module of a graph, from all files that speak of it.
struct MergedModule {
  // Where a file speaks of it.
  struct Layer {
    const GraphText* text;
    int index;  // of the module in that file

    const Module& module() const { return text->graph().module(index); }
  };

  Module module;              // fields merged; paths absolute, parameters left out
  std::vector<Layer> layers;  // each on top of the one before

  const std::string& name() const { return module.name(); }

  // "file:line:column" of a field, or of the module where no file has that field.
  std::string Where(const std::string& field) const;
};

// A graph file with all that it includes, directly or not.
class GraphFiles {
 public:
  explicit GraphFiles(std::string path) : path_(std::move(path)) {}

  // Reads the files without the modules' parameters, whose types are not known yet. What is wrong
  // is added to faults; false when anything is.
  bool ReadModules(std::vector<Fault>* faults);

  // Reads them again, parameters by the types in the catalog, and checks all ranges but those of
  // the parameters. As above.
  bool ReadAll(const ProgramCatalog& catalog, std::vector<Fault>* faults);

  // Without the modules that are disabled.
  const std::vector<MergedModule>& modules() const { return modules_; }

  bool lossless() const { return lossless_; }
  const std::optional<Logger>& logger() const { return logger_; }
  const std::set<std::string>& external() const { return external_; }

 private:
  void ReadFile(const std::string& path, const std::string& where,
                const std::vector<std::string>& includers, std::vector<Fault>* faults);
  void Merge(const GraphText& text, std::vector<Fault>* faults);
  void MergeModule(const GraphText& text, int index, std::vector<Fault>* faults);

  std::string path_;
  std::vector<std::unique_ptr<GraphText>> files_;  // included before including
  std::vector<MergedModule> modules_;
  bool lossless_ = false;
  std::optional<Logger> logger_;
  std::set<std::string> external_;
};

}  // namespace declutter::launcher
