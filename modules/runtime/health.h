#pragma once

#include <cstdint>
#include <mutex>
#include <string>

#include "lcmtypes/channels.h"
#include "modules/runtime/frame_times.h"

namespace declutter::runtime {

// What a process counts for its status message. May be used from all threads.
class Health {
 public:
  // Times are of any clock that does not go back [ms].
  void Arrived(std::int64_t utime, double now_ms);
  void Took();
  void Handled(std::int64_t utime, double processing_ms);
  void Done();
  void Published(std::int64_t utime, double now_ms);
  void Ended(std::int64_t utime, double now_ms);  // nothing more will come of this frame
  void GaveOut(std::int64_t utime);               // in another way than by publishing it
  void Skipped(std::int64_t num_frames);
  void Rejected();
  void Complain(const std::string& text);    // shown in the next report
  void SetTrouble(const std::string& text);  // shown in every report without a complaint

  // Counts of the whole run, times and complaint since the last report. Who the process is, its
  // state and the time of the report are left to the caller.
  module_status_t Report();

  std::int64_t num_handled() const;
  std::int64_t num_rejected() const;

 private:
  void CountOut(std::int64_t utime);

  mutable std::mutex mutex_;
  std::int64_t num_in_ = 0;
  std::int64_t num_done_ = 0;
  std::int64_t num_out_ = 0;
  std::int64_t last_out_utime_ = 0;
  std::int64_t num_messages_ = 0;
  std::int64_t num_skipped_ = 0;
  std::int64_t num_rejected_ = 0;
  std::int64_t num_handled_ = 0;
  std::int64_t last_utime_ = 0;
  int num_timed_ = 0;
  double processing_ms_ = 0;
  double max_processing_ms_ = 0;
  FrameTimes frame_times_;
  std::string complaint_;
  std::string trouble_;
};

}  // namespace declutter::runtime
