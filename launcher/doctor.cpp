#include "launcher/doctor.h"

#include <sys/timex.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "launcher/find_program.h"
#include "launcher/network.h"
#include "launcher/program_output.h"

namespace declutter::launcher {
namespace {

// Better: a run works without, but not as well. Must: no run works.
enum class Verdict { kGood, kBetter, kMust };

struct Finding {
  Verdict verdict;
  std::string text;
  std::string mend = {};
};

Finding ExamineMulticast() {
  const std::string url = ChooseUrl();
  if (CarriesMessages(url)) {
    return {Verdict::kGood, "multicast: messages of 150 KB arrive over " + url};
  }
  const std::string route = "sudo ip link set lo up; sudo ip route add 239.0.0.0/8 dev lo";
  if (CanIsolate()) {
    return {Verdict::kBetter,
            "multicast: none here; every run makes a network of its own, which no other program "
            "can join",
            route};
  }
  return {Verdict::kMust, "multicast: none here, and no network of its own can be made", route};
}

Finding ExamineReceiveBuffer() {
  constexpr int kWanted = 4 << 20;  // what a run asks for [byte]
  int size = 0;
  std::ifstream("/proc/sys/net/core/rmem_max") >> size;
  const std::string text = "receive buffer: " + std::to_string(size) + " byte";
  if (size >= kWanted) return {Verdict::kGood, text};
  return {Verdict::kBetter, text + ": bursts of messages may be lost",
          "sudo sysctl -w net.core.rmem_max=" + std::to_string(kWanted)};
}

Finding ExamineDisk(const std::string& logs) {
  constexpr double kWanted_mb = 1024;  // what a logger keeps free
  std::filesystem::path folder = std::filesystem::absolute(logs).lexically_normal();
  while (!std::filesystem::exists(folder)) folder = folder.parent_path();
  const auto free_mb = static_cast<double>(std::filesystem::space(folder).available) / 1e6;
  const std::string text =
      "disk: " + std::to_string(static_cast<int64_t>(free_mb)) + " MB free in " + folder.string();
  if (free_mb >= kWanted_mb) return {Verdict::kGood, text};
  return {Verdict::kBetter, text + ": a graph with a logger does not record",
          "remove old folders of runs, or --log_dir on another disk"};
}

Finding ExamineClock() {
  timex state = {};
  if (adjtimex(&state) != TIME_ERROR && (state.status & STA_UNSYNC) == 0) {
    return {Verdict::kGood, "clock: synchronised"};
  }
  return {Verdict::kBetter, "clock: not synchronised: times in logs differ between machines",
          "sudo timedatectl set-ntp true"};
}

Finding ExamineLogger() {
  const auto logger = FindProgram("lcm-logger");
  if (logger) return {Verdict::kGood, "lcm-logger: " + *logger};
  return {Verdict::kBetter, "lcm-logger: not installed: nothing can be recorded",
          "sudo apt-get install liblcm-bin"};
}

Finding ExamineSensors() {
  const auto program = FindProgram("list_sensors");
  if (!program) {
    return {Verdict::kBetter, "sensors: list_sensors is not built: no OpenNI2",
            "./launcher/setup.sh"};
  }
  const ProgramOutput output = RunProgram({*program}, 20.0);
  std::string text = "sensors:";
  std::istringstream lines(output.out);
  for (std::string line; std::getline(lines, line);) text += "\n    " + line;
  if (output.code == 0) return {Verdict::kGood, text};
  return {Verdict::kBetter, text + (output.err.empty() ? "" : "\n    " + output.err),
          "plug one in; README, Live sensors, tells what each needs"};
}

Finding ExaminePackages() {
  const auto query = FindProgram("dpkg-query");
  if (!query) return {Verdict::kGood, "packages: no dpkg here"};
  const ProgramOutput output = RunProgram(
      {*query, "--show", "--showformat=${Package} ${Version}\\n", "liblcm-dev", "libprotobuf-dev",
       "libpcl-dev", "libeigen3-dev", "libopenni2-dev", "libzstd-dev"},
      20.0);
  std::string text = "packages:";
  std::istringstream lines(output.out);
  for (std::string line; std::getline(lines, line);) text += "\n    " + line;
  if (output.code == 0) return {Verdict::kGood, text};
  return {Verdict::kBetter, text + "\n    " + output.err, "./launcher/setup.sh"};
}

}  // namespace

int Examine(const std::string& logs) {
  const std::vector<std::function<Finding()>> examinations = {
      ExamineMulticast, ExamineReceiveBuffer, [&] { return ExamineDisk(logs); },
      ExamineClock,     ExamineLogger,        ExamineSensors,
      ExaminePackages};
  int code = 0;
  for (const auto& examine : examinations) {
    const Finding finding = examine();
    std::cout << (finding.verdict == Verdict::kGood     ? "ok  "
                  : finding.verdict == Verdict::kBetter ? "-   "
                                                        : "BAD ")
              << finding.text << "\n";
    if (!finding.mend.empty()) std::cout << "    mend: " << finding.mend << "\n";
    if (finding.verdict == Verdict::kMust) code = 1;
    std::cout.flush();
  }
  return code;
}

}  // namespace declutter::launcher
