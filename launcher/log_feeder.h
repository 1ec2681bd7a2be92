#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "launcher/excerpt.h"
#include "launcher/keyboard.h"
#include "launcher/log_pace.h"
#include "launcher/logged_frames.h"
#include "launcher/process.h"

namespace declutter::launcher {

// What a replay takes from a log in place of modules that do not run.
struct ReplayPlan {
  std::string log;
  std::map<std::string, std::string> fed;  // channels published from the log, and their types
  std::set<std::string> needed;            // of these: without them a frame has no result
  std::set<std::string> awaited;           // results that tell that a frame is through
  Excerpt part;
  std::optional<double> speed;  // nothing: without loss, the next frame after the one before
  bool loops = false;
};

// Publishes a log, frame by frame. Without loss: the next frame when the results of the one before
// have come, a frame without results again; where results are seen in the status of a module alone,
// which comes once a second, some frames at once. At a speed: in the log's time, whatever the
// modules miss. In a terminal the space bar stops it and lets it go on, and n gives the next frame
// while it is stopped. Ends with 0 at the end of the log, with 1 when a frame that must not be lost
// has had no result or the log is damaged.
class LogFeeder : public Process {
 public:
  // Throws as LoggedFrames does. wire is kept and must hear what is awaited.
  LogFeeder(const ReplayPlan& plan, Wire* wire);
  ~LogFeeder() override;

  void Start() override { is_started_ = true; }
  void Terminate() override { is_ending_ = true; }
  void Kill() override { is_ending_ = true; }
  void OnMessage(const Message& message) override;
  void OnTurn(double now_s) override;
  bool is_ready() const override { return is_started_; }
  bool obeys_users() const override { return false; }
  std::optional<Ending> Reap() override;
  int fd() const override { return timer_fd_; }

 private:
  void ReadKeys(double now_s);
  void Begin(double now_s);
  bool IsSettled(double now_s);
  double DueIn(double now_s) const;
  void EndPass(double now_s);
  void Send(double now_s);
  void WakeIn(double wait_s) const;

  ReplayPlan plan_;
  LoggedFrames frames_;
  Wire* wire_;
  int timer_fd_;
  Keyboard keyboard_;
  std::optional<LogPace> pace_;       // from the first turn
  std::optional<LoggedFrame> next_;   // not sent yet
  std::optional<LoggedFrame> frame_;  // on its way
  std::set<std::string> missing_;     // its results that have not come
  double sent_s_ = 0.0;
  int num_sent_ = 0;  // how often it was sent
  int num_frames_ = 0;
  int code_ = 0;
  bool steps_ = false;  // once, while it stands still
  bool is_started_ = false;
  bool is_ending_ = false;
  bool is_reaped_ = false;
};

}  // namespace declutter::launcher
