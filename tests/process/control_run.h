#pragma once

#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {

// A camera of 50 Hz and a filter, and what a user asks of them while they run.
class ControlRun : public testing::Test {
 protected:
  void Run(const std::string& source_fields, const std::string& filter_fields) {
    launcher_.emplace(
        std::vector<std::string>{LAUNCHER, "run", LiveGraph(folder_, source_fields, filter_fields),
                                 "--log_dir", folder_.Path("logs"), "--record", log_},
        folder_);
    ASSERT_TRUE(Eventually([this] { return Row("source").find(" running ") != std::string::npos; }))
        << ReadFile(folder_.Path("stderr"));
  }

  Outcome Ask(std::vector<std::string> words) const {
    words.insert(words.begin(), LAUNCHER);
    words.insert(words.end(), {"--run", folder_.Path("logs/latest")});
    return Launched(words, asking_).Wait();
  }

  std::string Row(const std::string& process) const {
    const std::string table = Ask({"status"}).out;
    const size_t begin = table.find("\n" + process + " ");
    return begin == std::string::npos ? ""
                                      : table.substr(begin, table.find('\n', begin + 1) - begin);
  }

  // A number from the table; 0 where there is none yet.
  double Column(const std::string& process, const std::string& name) const {
    const std::string table = Ask({"status"}).out;
    std::istringstream lines(table);
    std::vector<std::string> head;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      const std::vector<std::string> row{std::istream_iterator<std::string>(words), {}};
      if (head.empty()) head = row;
      if (row.empty() || row[0] != process) continue;
      const auto column = std::find(head.begin(), head.end(), name) - head.begin();
      return std::atof(row.at(static_cast<size_t>(column)).c_str());
    }
    return 0;
  }

  Outcome End() {
    launcher_->Signal(SIGTERM);
    const Outcome outcome = launcher_->Wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(Eventually([this] { return ProcessesWith(folder_.Path("")).empty(); }));
    return outcome;
  }

  bool HasObjects(size_t num) const {
    return Eventually([&] { return UtimesOf("OBJECTS", log_).size() >= num; });
  }

  // Of the frames of the camera from the first answered to the last, those not answered once. On a
  // busy machine a filter skips frames, and says so: these are not counted.
  int NumLostOrDoubled() const {
    const auto objects = UtimesOf("OBJECTS", log_);
    const std::multiset<int64_t> answered(objects.begin(), objects.end());
    int num = -NumSkipped();
    for (const int64_t utime : UtimesOf("DEPTH_FRAME", log_)) {
      const bool is_between = utime >= *answered.begin() && utime <= *answered.rbegin();
      if (is_between && answered.count(utime) != 1) ++num;
    }
    return num;
  }

  // By all filters that there were.
  int NumSkipped() const {
    std::map<int, int64_t> skipped;  // by process number
    for (const std::string& message : MessagesOf("MODULE_STATUS", log_)) {
      module_status_t status;
      const auto size = static_cast<int>(message.size());
      if (status.decode(message.data(), 0, size) != size || status.module != "filter") continue;
      skipped[status.pid] = status.num_skipped;
    }
    int num = 0;
    for (const auto& [pid, num_skipped] : skipped) num += static_cast<int>(num_skipped);
    return num;
  }

  TemporaryFolder folder_;
  TemporaryFolder asking_;
  std::string log_ = folder_.Path("run.lcm");
  std::optional<Launched> launcher_;
};

}  // namespace declutter
