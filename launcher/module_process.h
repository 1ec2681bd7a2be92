#pragma once

#include <string>
#include <vector>

#include "launcher/program.h"

namespace declutter::launcher {

// A module's program. It is ready when it says so in its status, and has ended when its last status
// has been heard, or a moment later.
class ModuleProcess : public Program {
 public:
  // name: as in the graph; stop_signal: the request to end.
  ModuleProcess(std::string name, LaunchPlan plan, int stop_signal);

  // Starts it to keep what arrives and to handle nothing until Release.
  void StartHeld();

  // Lets it handle what is later than the last frame [us] of its predecessor, which has ended.
  // Where that is not known nothing is handled that has come until now.
  void Release(std::optional<int64_t> last_utime);

  void Start() override;
  void Terminate() override;
  void OnTurn(double now_s) override;
  void OnMessage(const Message& message) override;
  std::optional<module_status_t> TakeStatus() override;
  std::optional<int64_t> last_utime() const override { return last_utime_; }
  std::optional<Ending> Reap() override;

 protected:
  Ending Judge(const Ending& ending) const override;

 private:
  std::string name_;
  int stop_signal_;
  void Forget();

  std::optional<module_status_t> status_;  // not taken yet
  pid_t started_pid_ = -1;                 // remains when the process is gone
  std::optional<int64_t> last_utime_;      // of the frame that its last status tells of
  std::optional<Ending> ending_;           // not told yet
  double now_s_ = 0.0;
  double ended_s_ = 0.0;
};

}  // namespace declutter::launcher
