#include "launcher/vitals.h"

#include <unistd.h>

#include <fstream>
#include <sstream>
#include <string>

namespace declutter::launcher {
namespace {

constexpr double kLookPeriod_s = 1.0;
constexpr double kMinRatePeriod_s = 0.5;

// Processor time used so far [s]; 0 where it cannot be read.
double CpuSeconds(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  std::getline(file, text);
  // The name, in brackets, may hold anything; utime and stime are the 12th and 13th word after it.
  std::istringstream words(text.substr(std::min(text.size(), text.rfind(')') + 1)));
  std::string skipped;
  for (int i = 0; i < 11; ++i) words >> skipped;
  double user = 0.0, system = 0.0;
  words >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double ResidentMegabytes(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/statm");
  double total = 0.0, resident = 0.0;
  file >> total >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / 1e6;
}

}  // namespace

void Vitals::Hear(const module_status_t& status) {
  const double passed_s = static_cast<double>(status.utime - status_.utime) * 1e-6;
  const bool is_same = status.pid == status_.pid;
  const auto num_new = static_cast<double>(status.num_out - status_.num_out);
  // The last status of a process comes at any time after the one before.
  if (passed_s >= kMinRatePeriod_s || !is_same) rate_hz_ = is_same ? num_new / passed_s : 0.0;
  const std::string message = is_same ? status_.message : "";
  status_ = status;
  if (status_.message.empty()) status_.message = message;  // the last one stays to be read
}

void Vitals::Look(pid_t pid, double now_s) {
  const bool is_same = pid == pid_;
  if (is_same && now_s - look_s_ < kLookPeriod_s) return;
  const double cpu_s = pid > 0 ? CpuSeconds(pid) : 0.0;
  load_ = is_same && pid > 0 ? (cpu_s - cpu_s_) / (now_s - look_s_) : 0.0;
  memory_mb_ = pid > 0 ? ResidentMegabytes(pid) : 0.0;
  pid_ = pid;
  cpu_s_ = cpu_s;
  look_s_ = now_s;
}

ProcessStatus Vitals::Report() const {
  ProcessStatus report;
  report.set_pid(pid_ > 0 ? pid_ : 0);
  report.set_load(load_);
  report.set_memory_mb(memory_mb_);
  if (status_.utime == 0) return report;  // it has not said anything yet, or never does
  report.set_num_in(status_.num_in);
  report.set_num_out(status_.num_out);
  report.set_num_skipped(status_.num_skipped);
  report.set_num_rejected(status_.num_rejected);
  report.set_rate_hz(rate_hz_);
  report.set_processing_ms(status_.processing_ms);
  report.set_max_processing_ms(status_.max_processing_ms);
  report.set_latency_ms(status_.latency_ms);
  report.set_max_latency_ms(status_.max_latency_ms);
  report.set_message(status_.message);
  return report;
}

}  // namespace declutter::launcher
