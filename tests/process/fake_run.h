#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {

inline constexpr const char* kEndless = "num_frames: 100000";

// Runs of fake modules that leave nothing behind.
class FakeRun : public testing::Test {
 protected:
  // Each of our processes has the folder's path on its command line: the launcher, the guard that
  // outlives it for a moment, and two modules.
  static constexpr size_t kNumProcesses = 4;
  std::vector<pid_t> Processes() const { return ProcessesWith(folder_.Path("")); }

  std::vector<std::string> Command(const std::string& graph) const {
    return {LAUNCHER, "run", graph, "--log_dir", folder_.Path("logs")};
  }

  void TearDown() override {
    EXPECT_TRUE(Eventually([this] { return Processes().empty(); })) << "left behind";
  }

  TemporaryFolder folder_;
};

}  // namespace declutter
