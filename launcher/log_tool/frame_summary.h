#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"

namespace declutter::log_tool {

// What became of the frames of a log.
struct FrameSummary {
  int64_t num_frames = 0;  // depth frames; one sent again counts once
  double span_s = 0.0;     // from the first to the last of them
  // Of each channel further down, ascending: from the record of a frame's depth to that of its
  // first message there [ms]. A frame without one is left out.
  std::map<std::string, std::vector<double>> delays_ms;
  // The last status of each module; one that was started again begins again.
  std::map<std::string, module_status_t> modules;
  // Messages, status and what tells of the run left out: those that modules say they have
  // published, of all their processes, and those in the log.
  int64_t num_published = 0;
  int64_t num_logged = 0;
  std::vector<std::string> damages;  // of the log, and where
};

// Throws std::runtime_error when the log cannot be read.
FrameSummary SummariseFrames(const std::string& log);

// The smallest of the ascending values, which are not empty, that a share p in (0, 1] of them does
// not exceed.
double Percentile(const std::vector<double>& ascending, double p);

// For people.
std::string Text(const FrameSummary& summary);

}  // namespace declutter::log_tool
