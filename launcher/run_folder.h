#pragma once

#include <string>

#include "launcher/resolved_graph.h"

namespace declutter::launcher {

// The folder of one run: the resolved graph, the versions of its programs, each module's resolved
// parameters and each process's log. `latest` beside it points to it.
class RunFolder {
 public:
  // Makes the folder in logs, named by date, time and process number, and writes the graph into it.
  // Throws std::runtime_error when it cannot be written.
  RunFolder(const std::string& logs, const ResolvedGraph& graph);

  const std::string& path() const { return path_; }

  // The graph as it has become.
  void WriteGraph(const std::string& text, const std::string& versions) const;

  // Returns the path of a file with the parameters of a process.
  std::string WriteConfig(const std::string& process, const std::string& text) const;

  std::string ConfigPath(const std::string& module) const;
  std::string LogPath(const std::string& process) const;

 private:
  std::string path_;
};

}  // namespace declutter::launcher
