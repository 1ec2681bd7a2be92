#pragma once

#include <optional>

namespace declutter::launcher {

// When and how soon a process that has ended starts again.
struct RestartRule {
  enum class When { kNever, kOnFailure, kAlways };

  When when = When::kNever;
  double first_delay_s = 0.1;  // doubles with each further restart in a row
  double max_delay_s = 5.0;
  int max_in_a_row = 10;
};

// Counts the restarts of one process. A process that runs ten times as long as it was waited for
// is well again: the next restart is a first one.
class Backoff {
 public:
  explicit Backoff(const RestartRule& rule) : rule_(rule) {}

  // Seconds to wait after an end that came ran_s after the process was ready; nothing when it has
  // been restarted too often in a row.
  std::optional<double> Next(double ran_s);

  void Reset() { num_in_a_row_ = 0; }

 private:
  RestartRule rule_;
  int num_in_a_row_ = 0;
  double delay_s_ = 0.0;
};

}  // namespace declutter::launcher
