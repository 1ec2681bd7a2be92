#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "launcher/process.h"
#include "launcher/supervisor.h"
#include "launcher/wire.h"

namespace declutter::launcher {

// Keeps the signals that end a run until a Session reads them. Call before any thread is started.
void HoldSignals();

// Carries out what a Supervisor decides: the loop that hears signals, messages, endings and what
// processes print. One at a time in a program, as signals come once.
class Session {
 public:
  // wire is kept.
  Session(Supervisor supervisor, std::map<std::string, std::unique_ptr<Process>> processes,
          Wire* wire);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Returns the run's exit code once every process has ended.
  int Run();

 private:
  void Wait();
  void ReadSignals();
  void Decide(const Event& event);
  void Do(const Start& action);
  void Do(const Terminate& action) { processes_.at(action.name)->Terminate(); }
  void Do(const Kill& action) { processes_.at(action.name)->Kill(); }
  void Do(const Say& action);

  Supervisor supervisor_;
  std::map<std::string, std::unique_ptr<Process>> processes_;
  Wire* wire_;
  int signal_fd_;
};

}  // namespace declutter::launcher
