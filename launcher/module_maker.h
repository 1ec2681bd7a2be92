#pragma once

#include <map>
#include <memory>
#include <string>

#include "launcher/orphan_guard.h"
#include "launcher/recorder.h"
#include "launcher/resolved_graph.h"
#include "launcher/run_folder.h"
#include "launcher/session.h"

namespace declutter::launcher {

// Makes the processes of a graph's modules, at its start and when users swap them, and keeps the
// record of what the graph is.
class ModuleMaker : public SuccessorMaker {
 public:
  // All are kept.
  ModuleMaker(const ResolvedGraph& graph, const RunFolder& folder, const OrphanGuard& guard)
      : graph_(graph), folder_(folder), guard_(guard) {}

  // recorder will be told what the graph has become; it is kept.
  void SetRecorder(Recorder* recorder) { recorder_ = recorder; }

  std::unique_ptr<ModuleProcess> Make(const Module& module) const;
  std::unique_ptr<ModuleProcess> Make(const ControlRequest& request) override;
  void Adopt(const std::string& module) override;

 private:
  std::unique_ptr<ModuleProcess> Make(const Module& module, const std::string& config_path) const;

  const ResolvedGraph& graph_;
  const RunFolder& folder_;
  const OrphanGuard& guard_;
  Recorder* recorder_ = nullptr;
  std::map<std::string, ControlRequest> requests_;  // the last of each module
  int num_made_ = 0;                                // for users
};

// What the log of a run is told of it. versions and graph as in run_info_t.
run_info_t InfoOf(const std::string& versions, const std::string& graph);

}  // namespace declutter::launcher
