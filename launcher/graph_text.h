#pragma once

#include <google/protobuf/text_format.h>

#include <string>
#include <vector>

#include "launcher/graph.pb.h"
#include "launcher/program_catalog.h"
#include "launcher/wiring.h"

namespace declutter::launcher {

// A graph as it is written in a file.
class GraphText {
 public:
  // file is the name for people; paths in it begin in its folder.
  GraphText(std::string text, std::string file);

  std::string PathFromHere(const std::string& path) const;

  // Reads the graph without the modules' parameters, whose types are not known yet. Faults of the
  // syntax are added to faults; false when there are any.
  bool ReadModules(std::vector<Fault>* faults);

  // Reads all of it, parameters by the types in the catalog, and checks all ranges but those of the
  // parameters. Faults as above.
  bool ReadAll(const ProgramCatalog& catalog, std::vector<Fault>* faults);

  const Graph& graph() const { return graph_; }

  // "file:line:column" of a module's field, or of the module where it has no such field. After
  // ReadAll or ReadModules.
  std::string Where(int module, const std::string& field) const;

  std::string WhereInclude(int index) const;

  // Checks a module's parameters, unpacked, against their options.
  void CheckConfig(int module, const google::protobuf::Message& config,
                   std::vector<Fault>* faults) const;

 private:
  bool Read(const google::protobuf::TextFormat::Finder& finder, bool skips_unknown,
            const ProgramCatalog* catalog, std::vector<Fault>* faults);
  std::string Where(int line, int column) const;
  const google::protobuf::TextFormat::ParseInfoTree* Locations(int module) const;

  std::string text_;
  std::string file_;
  Graph graph_;
  std::unique_ptr<google::protobuf::TextFormat::ParseInfoTree> locations_;
};

}  // namespace declutter::launcher
