#pragma once

#include <cstdint>
#include <deque>

namespace declutter::runtime {

// How long frames take until a process is through with them: from the first it has to do with a
// frame, a message of it that arrives or is published, to its end. So a module that hears the
// sensor and the result of the graph, or publishes the one and hears the other, knows how long the
// whole graph takes. Times are of any clock that does not go back [ms].
class FrameTimes {
 public:
  // Of one frame, named by its utime, only the first call counts until its end.
  void Begin(std::int64_t utime, double now_ms);

  // What was not begun does not count.
  void End(std::int64_t utime, double now_ms);

  // Of the frames ended since the last call; 0 when none was.
  struct Latency {
    double median_ms = 0;
    double max_ms = 0;
  };
  Latency Take();

 private:
  struct Begun {
    std::int64_t utime;
    double at_ms;
  };

  std::deque<Begun> begun_;
  std::deque<double> latencies_ms_;
};

}  // namespace declutter::runtime
