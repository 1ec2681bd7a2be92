#include <gmock/gmock.h>

#include "tests/process/fake_run.h"

namespace declutter {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

using RecordTest = FakeRun;

TEST_F(RecordTest, RecordsEveryMessage) {
  const std::string log = folder_.Path("run.lcm");
  const std::string graph = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  const Outcome outcome = RunLauncher({"run", graph, "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", log).size(), 50u);
  EXPECT_EQ(UtimesOf("OBJECTS", log).size(), 50u);
}

TEST_F(RecordTest, ReplaysALogWithoutItsSourceAndSkipsNoFrame) {
  const std::string log = folder_.Path("run.lcm");
  const std::string graph = FakeGraph(folder_, SourceConfig("num_frames: 50"), "");
  RunLauncher({"run", graph, "--record", log}, folder_);
  const std::string again = folder_.Path("again.lcm");
  const Outcome outcome = RunLauncher({"run", graph, "--replay", log, "--record", again}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(UtimesOf("DEPTH_FRAME", again).size(), 50u);
  EXPECT_EQ(UtimesOf("OBJECTS", again).size(), 50u);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/source.log")), IsEmpty());
}

TEST_F(RecordTest, RefusesToReplayFromAModuleThatTheGraphDoesNotHave) {
  const std::string graph = FakeGraph(folder_, "", "");
  const Outcome outcome =
      RunLauncher({"run", graph, "--replay", "log", "--from", "fliter"}, folder_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("no such module; did you mean 'filter'?"));
}

TEST_F(RecordTest, FailsWhenTheLogToReplayCannotBeRead) {
  const std::string graph = FakeGraph(folder_, "", "");
  const Outcome outcome = RunLauncher({"run", graph, "--replay", folder_.Path("none")}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr(folder_.Path("none")));
}

TEST_F(RecordTest, RefusesToRecordOverAFile) {
  const std::string log = folder_.Write("run.lcm", "precious");
  const Outcome outcome =
      RunLauncher({"run", FakeGraph(folder_, "", ""), "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("exists already"));
  EXPECT_EQ(ReadFile(log), "precious");
}

TEST_F(RecordTest, FailsWhenTheLogCannotBeWritten) {
  const std::string graph = FakeGraph(folder_, "", "");
  const std::string log = folder_.Write("no_folder", "") + "/run.lcm";
  const Outcome outcome = RunLauncher({"run", graph, "--record", log}, folder_);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("lcm-logger ended"));
}

}  // namespace
}  // namespace declutter
