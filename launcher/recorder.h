#pragma once

#include <string>
#include <vector>

#include "launcher/program.h"

namespace declutter::launcher {

// lcm-logger, recording every message of a run. It gives no sign of life or of loss (its queue
// holds 30 messages), and ends with 0 on a full disk. So a mark of ours must appear in the log
// before the run starts, another, sent after the last message of the run, must be its end, and
// between them there must be as many messages as we have heard.
class Recorder : public Program {
 public:
  // plan: of lcm-logger, writing log. wire is kept.
  Recorder(LaunchPlan plan, std::string log, Wire* wire);

  void Start() override;
  void Terminate() override;
  void OnMessage(const Message& message) override;
  void OnTurn(double now_s) override;

 protected:
  Ending Judge(const Ending& ending) const override;

 private:
  void SendMark(double now_s);

  std::string log_;
  Wire* wire_;
  Message mark_;
  double mark_s_ = 0.0;    // when it was sent last
  int64_t num_heard_ = 0;  // messages of modules, status left out
  bool is_complete_ = false;
};

}  // namespace declutter::launcher
