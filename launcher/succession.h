#pragma once

namespace declutter::launcher {

// The way of a new process into the place of a running one: it starts without handling anything,
// keeps what arrives until it has a whole frame, takes over when the old one has ended, and is on
// trial until its first frame is finished. Times are of any clock that does not go back.
class Succession {
 public:
  enum class Step { kNone, kStarting, kListening, kTakingOver, kOnTrial };

  Step step() const { return step_; }
  bool is_under_way() const { return step_ != Step::kNone; }

  void Begin(double now_s) { Enter(Step::kStarting, now_s); }
  void Cancel() { step_ = Step::kNone; }

  // A sign of life of the new process. has_input: a whole frame waits in it.
  void Beat(bool has_input, double now_s);

  // The new one has not given a sign of life in time.
  bool is_late(double limit_s, double now_s) const;

  // The old one may end: from its last frame on the new one has all. Where nothing arrives there
  // is nothing to wait for.
  bool is_due(double now_s) const;

  void TakeOver(double now_s) { Enter(Step::kTakingOver, now_s); }

  void Try(double now_s) { Enter(Step::kOnTrial, now_s); }
  bool is_on_trial() const { return step_ == Step::kOnTrial; }

  // It has been on trial for so long without a frame that none seems to come.
  bool has_passed(double now_s) const;

 private:
  void Enter(Step step, double now_s);

  Step step_ = Step::kNone;
  double since_s_ = 0.0;
  bool has_input_ = false;
};

}  // namespace declutter::launcher
