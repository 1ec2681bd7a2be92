#pragma once

#include <string>

#include "launcher/program.h"

namespace declutter::launcher {

// Where and how much a Recorder writes.
struct Recording {
  std::string path;  // of the log; with is_split its files are called PATH.00, PATH.01, ...
  bool is_split = false;
  double min_free_mb = 64;  // on the disk
};

// lcm-logger, recording every message of a run. It gives no sign of life or of loss (its queue
// holds 30 messages), and ends with 0 on a full disk. So a message of ours, which tells what made
// the log, must appear in it before the run starts; another, sent after the last message of the
// run, must be its end; between them there must be as many messages as we have heard (counted in a
// log of one file); and it is ended, with 2, while the disk still has room.
class Recorder : public Program {
 public:
  // plan: of lcm-logger. info is written to the beginning of each file. wire is kept.
  Recorder(LaunchPlan plan, Recording recording, const run_info_t& info, Wire* wire);

  // What makes the log from now on.
  void Tell(const run_info_t& info);

  void Start() override;
  void Terminate() override;
  void OnMessage(const Message& message) override;
  void OnTurn(double now_s) override;

 protected:
  Ending Judge(const Ending& ending) const override;

 private:
  std::string CurrentFile() const;
  void Await(const Message& mark, double now_s);
  void LookAround(double now_s);

  Recording recording_;
  Message info_;
  Wire* wire_;
  Message end_mark_;
  std::string file_;       // that holds the info
  std::string old_file_;   // of the process before
  double mark_s_ = 0.0;    // when a mark was sent last
  double look_s_ = 0.0;    // when the disk was looked at last
  int64_t num_heard_ = 0;  // messages of modules, status left out
  bool is_complete_ = false;
  bool is_disk_full_ = false;
};

// Throws std::runtime_error when the disk that path will be on has not min_free_mb.
void CheckFreeSpace(const Recording& recording);

}  // namespace declutter::launcher
