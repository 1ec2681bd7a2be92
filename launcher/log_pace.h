#pragma once

namespace declutter::launcher {

// The time in which a log is played: it runs at another speed, and stands still when somebody wants
// it to. Times now_s are monotonic and do not decrease.
class LogPace {
 public:
  // The log's beginning is due at now_s.
  LogPace(double speed, double now_s) : speed_(speed), start_s_(now_s) {}

  // [s] until what lies at_s after the log's beginning is due, 0 when it is; infinite while the
  // time stands still before it.
  double Wait(double at_s, double now_s) const;

  void Toggle(double now_s);

  // While it stands still: what lies at at_s is due, and the time will go on from there.
  void StepTo(double at_s);

  bool stands_still() const { return stands_still_; }

 private:
  double speed_;
  double start_s_;
  double position_s_ = 0.0;  // in the log, where it stands still
  bool stands_still_ = false;
};

}  // namespace declutter::launcher
