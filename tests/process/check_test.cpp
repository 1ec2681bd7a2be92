#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class CheckTest : public testing::Test {
 protected:
  Outcome Check(const std::string& graph, const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"check", graph};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunLauncher(arguments, folder_);
  }

  TemporaryFolder folder_;
};

TEST_F(CheckTest, PrintsTheGraphWithAllItsLayersResolved) {
  folder_.Write("source.textproto", "num_frames: 7 fails: true");
  const std::string graph =
      FakeGraph(folder_, "config_file: \"source.textproto\"\n" + SourceConfig("num_frames: 8"), "");
  const Outcome outcome = Check(graph, {"--set", "filter.mishap=crashes"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("num_frames: 8"), HasSubstr("fails: true"),
                                 HasSubstr("mishap: \"crashes\"")));
  const Outcome again = Check(folder_.Write("resolved.textproto", outcome.out));
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, outcome.out);
}

TEST_F(CheckTest, DrawsTheGraph) {
  EXPECT_EQ(Check(FakeGraph(folder_, "", ""), {"--dot"}).out, R"(digraph graph_of_modules {
  node [shape=box]
  source
  filter
  filter -> source [label="OBJECTS" style=dashed]
  source -> filter [label="DEPTH_FRAME"]
}
)");
}

TEST_F(CheckTest, NamesThePlaceOfAFileThatCannotBeRead) {
  const Outcome outcome = Check(folder_.Path("missing"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, folder_.Path("missing") + ":1:1: cannot be read\n");
  const Outcome folder = Check(folder_.Path("."));
  EXPECT_EQ(folder.code, 2);
  EXPECT_EQ(folder.err, folder_.Path(".") + ":1:1: cannot be read\n");
}

TEST_F(CheckTest, NamesThePlaceOfASyntaxError) {
  const Outcome outcome = Check(folder_.Write("g", "lossless: true\nmodule { name 5 }\n"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, StartsWith(folder_.Path("g") + ":2:15: "));
}

TEST_F(CheckTest, NamesThePlaceOfAnUnknownParameterAndTheOneMeant) {
  const std::string graph = FakeGraph(folder_, SourceConfig("\n  num_frame: 4"), "");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, graph + ":4:3: no field named 'num_frame' in declutter.FakeSourceConfig" +
                             "; did you mean 'num_frames'?\n");
}

TEST_F(CheckTest, NamesThePlacesOfAllValuesOutOfTheirRange) {
  const std::string graph =
      FakeGraph(folder_, SourceConfig("\n num_frames: -4"), FilterConfig("\n mishap: \"rain\""));
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, AllOf(HasSubstr(graph + ":4:2: num_frames = -4 outside [0, 100000]"),
                                 HasSubstr(graph + ":8:2: mishap = \"rain\" is not one of")));
}

TEST_F(CheckTest, NamesThePlaceInAParameterFile) {
  folder_.Write("source.textproto", "\nnum_frames: x");
  const Outcome outcome = Check(FakeGraph(folder_, "config_file: \"source.textproto\"", ""));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, StartsWith(folder_.Path("source.textproto") + ":2:13: "));
  const std::string graph = FakeGraph(folder_, "config_file: \".\"", "");
  const Outcome folder = Check(graph);
  EXPECT_EQ(folder.code, 2);
  EXPECT_THAT(folder.err, StartsWith(graph + ":3:1: "));
  EXPECT_THAT(folder.err, HasSubstr("cannot be read"));
}

TEST_F(CheckTest, RefusesParametersOfAnotherProgram) {
  const std::string graph = FakeGraph(folder_, FilterConfig(""), "");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, StartsWith(graph + ":3:1: parameters of source are of type "
                                              "declutter.FakeSourceConfig, not "));
}

TEST_F(CheckTest, NamesTheModuleThatHasNoProgram) {
  const std::string graph = folder_.Write("g", "module { name: \"no_such_program\" }");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err,
            graph + ":1:10: no program 'no_such_program' beside the launcher or in PATH\n");
}

TEST_F(CheckTest, RefusesAProgramThatIsNoModule) {
  const std::string graph = folder_.Write("g", "module { name: \"t\" program: \"/bin/true\" }");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err,
              AllOf(StartsWith(graph + ":1:20: "), HasSubstr("does not describe a module")));
}

TEST_F(CheckTest, RefusesASecondPublisherOfAChannel) {
  const std::string graph =
      FakeGraph(folder_, "", "} module { name: \"more\" program: \"" + Fake("fake_filter") + "\"");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, graph + ":6:3: more publishes OBJECTS, as filter does\n");
}

TEST_F(CheckTest, RefusesASecondModuleOfTheSameName) {
  const std::string filter = "\" program: \"" + Fake("fake_filter") + "\"";
  const std::string graph = FakeGraph(folder_, "", "} module { name: \"source" + filter);
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, graph + ":6:12: a second module named source\n");
}

TEST_F(CheckTest, RefusesAChannelThatARemapLeavesWithoutPublisher) {
  const std::string graph =
      FakeGraph(folder_, "remap { from: \"DEPTH_FRAME\" to: \"DEPTH_LEFT\" }", "");
  const Outcome outcome = Check(graph);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, StartsWith(graph + ":5:1: filter consumes DEPTH_FRAME, which nothing "
                                              "publishes"));
}

TEST_F(CheckTest, RefusesToStartAModuleAfterOneThatIsNotThereOrThatWaitsForIt) {
  const std::string unknown = FakeGraph(folder_, "after: \"fliter\"", "");
  EXPECT_EQ(Check(unknown).err, unknown +
                                    ":3:1: after: no module or group named 'fliter'; did "
                                    "you mean 'filter'?\n");
  const std::string cycle = FakeGraph(folder_, "", "after: \"source\"");
  EXPECT_EQ(Check(cycle).err, cycle + ":2:1: a cycle: source -> filter -> source\n");
  const std::string in_order = FakeGraph(folder_, "after: \"filter\"", "");
  EXPECT_EQ(Check(in_order).code, 0);
}

TEST_F(CheckTest, NamesTheAssignmentThatIsWrong) {
  const std::string graph = FakeGraph(folder_, "", "");
  const auto error = [&](const std::string& assignment) {
    const Outcome outcome = Check(graph, {"--set", assignment});
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_EQ(error("sorce.fails=true"),
            "--set sorce.fails=true: no module named 'sorce'; did you mean 'source'?\n");
  EXPECT_THAT(error("source.failss=true"),
              AllOf(StartsWith("--set source.failss=true: no field named 'failss'"),
                    HasSubstr("did you mean 'fails'?")));
  EXPECT_EQ(error("source.num_frames=-1"),
            "--set source.num_frames=-1: num_frames = -1 outside [0, 100000]\n");
  EXPECT_THAT(error("source.num_frames=many"), StartsWith("--set source.num_frames=many: "));
  EXPECT_EQ(error("source"), "--set source: not of the form module.field=value\n");
}

TEST_F(CheckTest, ExaminesTheMachine) {
  const Outcome outcome = RunLauncher({"doctor", "--log_dir", folder_.Path("logs")}, folder_);
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  for (const char* subject : {"multicast: ", "receive buffer: ", "disk: ", "clock: ",
                              "lcm-logger: ", "sensors:", "packages:"}) {
    EXPECT_THAT(outcome.out, HasSubstr(subject));
  }
}

TEST_F(CheckTest, NamesTheMendWhereThereIsNoMulticast) {
  const auto leave_network = [] {
    if (unshare(CLONE_NEWNET) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) _exit(99);
  };
  const Outcome outcome = Launched({LAUNCHER, "doctor"}, folder_, leave_network).Wait();
  if (outcome.code == 99) GTEST_SKIP() << "no network namespaces here";
  EXPECT_THAT(outcome.out, HasSubstr("mend: sudo ip link set lo up; sudo ip route add"));
}

TEST_F(CheckTest, RefusesUnknownVerbsAndOptions) {
  EXPECT_EQ(RunLauncher({"chek", "g"}, folder_).code, 2);
  EXPECT_EQ(RunLauncher({"check", "g", "--sett", "a.b=c"}, folder_).code, 2);
  EXPECT_EQ(RunLauncher({"check"}, folder_).code, 2);
  EXPECT_EQ(RunLauncher({}, folder_).code, 2);
  const Outcome help = RunLauncher({"--help"}, folder_);
  EXPECT_EQ(help.code, 0);
  EXPECT_THAT(help.out, HasSubstr("launcher run GRAPH"));
}

}  // namespace
}  // namespace declutter
