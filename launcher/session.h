#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "launcher/control_socket.h"
#include "launcher/launcher_log.h"
#include "launcher/module_process.h"
#include "launcher/orders.h"
#include "launcher/supervisor.h"
#include "launcher/vitals.h"
#include "launcher/wire.h"

namespace declutter::launcher {

// Keeps the signals that end a run until a Session reads them. Call before any thread is started.
void HoldSignals();

using ProcessMap = std::map<std::string, std::unique_ptr<Process>>;

// Makes what users swap in.
class SuccessorMaker {
 public:
  virtual ~SuccessorMaker() = default;

  // For a request to swap; null when there is no such module. Throws std::runtime_error.
  virtual std::unique_ptr<ModuleProcess> Make(const ControlRequest& request) = 0;

  // The successor made last has taken over.
  virtual void Adopt(const std::string& module) = 0;
};

// Carries out what a Supervisor decides: the loop that hears signals, messages, users, endings and
// what processes print. One at a time in a program, as signals come once.
class Session {
 public:
  // What it is linked to; all is kept.
  struct Links {
    Wire* wire;
    ControlSocket* control;
    SuccessorMaker* maker;
    LauncherLog* log;
    std::string place;  // where the run can be found, for people
  };

  Session(Links links, Supervisor supervisor, ProcessMap processes);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Returns the run's exit code once every process has ended.
  int Run();

 private:
  void Wait();
  void ReadSignals();
  void ListenToProcesses(const std::vector<Message>& messages);
  void ListenToSuccessors(const std::vector<Message>& messages);
  void ListenToUsers();
  void Take(ControlSocket::Id id, const ControlRequest& request);
  ControlReply Report() const;
  void Decide(const Event& event);
  void Do(const Start& action);
  void Do(const Terminate& action) { processes_.at(action.name)->Terminate(); }
  void Do(const Kill& action) { processes_.at(action.name)->Kill(); }
  void Do(const Say& action) { links_.log->Say(action.text); }
  void Do(const StartSuccessor& action);
  void Do(const EndSuccessor& action) { successors_.erase(action.name); }
  void Do(const Promote& action);
  void Do(const Adopt& action);
  void Do(const Revert& action);

  const Links links_;
  Supervisor supervisor_;
  ProcessMap processes_;
  std::map<std::string, std::unique_ptr<ModuleProcess>> successors_;
  ProcessMap predecessors_;  // of those on trial
  std::map<std::string, Vitals> vitals_;
  Orders orders_;
  int signal_fd_;
};

}  // namespace declutter::launcher
