#include "launcher/succession.h"

namespace declutter::launcher {
namespace {

constexpr double kListenLimit_s = 3.0;  // status comes once a second
constexpr double kTrial_s = 3.0;

}  // namespace

void Succession::Enter(Step step, double now_s) {
  step_ = step;
  since_s_ = now_s;
  if (step == Step::kStarting) has_input_ = false;
}

void Succession::Beat(bool has_input, double now_s) {
  has_input_ = has_input_ || has_input;
  if (step_ == Step::kStarting) Enter(Step::kListening, now_s);
}

bool Succession::is_late(double limit_s, double now_s) const {
  return step_ == Step::kStarting && now_s - since_s_ > limit_s;
}

bool Succession::is_due(double now_s) const {
  return step_ == Step::kListening && (has_input_ || now_s - since_s_ > kListenLimit_s);
}

bool Succession::has_passed(double now_s) const {
  return step_ == Step::kOnTrial && now_s - since_s_ > kTrial_s;
}

}  // namespace declutter::launcher
