#pragma once

#include <optional>
#include <set>
#include <string>

#include "launcher/logged_frames.h"
#include "launcher/process.h"

namespace declutter::launcher {

// What a replay takes from a log in place of modules that do not run.
struct ReplayPlan {
  std::string log;
  std::set<std::string> fed;      // channels published from the log
  std::set<std::string> awaited;  // results that tell that a frame is through
};

// Publishes a log without loss: the next frame when the results of the one before have come, a
// frame without results again. Ends with 0 at the end of the log, with 1 when a frame has had no
// result or the log is damaged.
class LogFeeder : public Process {
 public:
  // Throws as LoggedFrames does. wire is kept and must hear what is awaited.
  LogFeeder(const ReplayPlan& plan, Wire* wire);

  void Start() override { is_started_ = true; }
  void Terminate() override { is_ending_ = true; }
  void Kill() override { is_ending_ = true; }
  void OnMessage(const Message& message) override;
  void OnTurn(double now_s) override;
  bool is_ready() const override { return is_started_; }
  bool obeys_users() const override { return false; }
  std::optional<Ending> Reap() override;

 private:
  void Send(double now_s);
  bool IsThrough() const { return frame_ && missing_.empty(); }

  std::set<std::string> awaited_;
  LoggedFrames frames_;
  Wire* wire_;
  std::optional<LoggedFrame> frame_;  // on its way
  std::set<std::string> missing_;     // its results that have not come
  double sent_s_ = 0.0;
  int num_sent_ = 0;
  int code_ = 0;
  bool is_started_ = false;
  bool is_ending_ = false;
  bool is_reaped_ = false;
};

}  // namespace declutter::launcher
