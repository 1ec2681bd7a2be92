#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <signal.h>
#include <sys/resource.h>

#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

// Graphs made of other graphs, parts of graphs, and what a module's block says of its process.
class LayersTest : public testing::Test {
 protected:
  Outcome Check(const std::string& graph) { return RunLauncher({"check", graph}, folder_); }

  // A graph that includes the one of two fake modules.
  std::string Including(const std::string& text) {
    FakeGraph(folder_, SourceConfig("num_frames: 2"), "grace_period_s: 2 env: \"A=1\"");
    return folder_.Write("top.textproto", "include: \"graph.textproto\"\n" + text);
  }

  TemporaryFolder folder_;
};

TEST_F(LayersTest, PutsItsOwnFieldsOnTopOfThoseOfAnIncludedGraph) {
  const Outcome outcome =
      Check(Including("module { name: \"filter\" grace_period_s: 3 " + FilterConfig("at_frame: 5") +
                      " }\nmodule { name: " + "\"source\" " + SourceConfig("fails: true") + " }"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("grace_period_s: 3"), HasSubstr("at_frame: 5"),
                    HasSubstr("env: \"A=1\""), HasSubstr("num_frames: 2"), HasSubstr("fails: true"),
                    HasSubstr("lossless: true"), Not(HasSubstr("include"))));
}

TEST_F(LayersTest, ReplacesAListByAList) {
  const Outcome outcome = Check(Including("module { name: \"filter\" env: \"B=2\" }"));
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("env: \"B=2\""), Not(HasSubstr("A=1"))));
}

TEST_F(LayersTest, LeavesOutWhatIsDisabled) {
  const Outcome outcome =
      Check(Including("module { name: \"filter\" disabled: true }\nmodule { name: \"other\" "
                      "program: \"" +
                      Fake("fake_filter") + "\" }"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("name: \"other\""), Not(HasSubstr("name: \"filter\""))));
}

TEST_F(LayersTest, NamesThePlaceOfAFaultInEachFile) {
  const std::string own = Including("module { name: \"filter\" restart: \"sometimes\" }");
  EXPECT_THAT(Check(own).err,
              StartsWith(own + ":2:25: module.restart = \"sometimes\" is not one of"));
  folder_.Write("graph.textproto", "\nmodle {}");
  EXPECT_THAT(Check(own).err, AllOf(StartsWith(folder_.Path("graph.textproto") + ":2:1: "),
                                    HasSubstr("did you mean 'module'?")));
}

TEST_F(LayersTest, NamesTheIncludeThatCannotBeRead) {
  const std::string graph = folder_.Write("top.textproto", "\ninclude: \"none.textproto\"");
  EXPECT_EQ(Check(graph).err,
            graph + ":2:1: " + folder_.Path("none.textproto") + ": cannot be read\n");
}

TEST_F(LayersTest, RefusesAGraphThatIncludesItself) {
  folder_.Write("a.textproto", "include: \"b.textproto\"");
  folder_.Write("b.textproto", "include: \"a.textproto\"");
  const Outcome outcome = Check(folder_.Path("a.textproto"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("a.textproto includes itself"));
}

TEST_F(LayersTest, RefusesProcessSettingsThatCannotBe) {
  const auto error = [this](const std::string& fields) {
    const Outcome outcome = Check(FakeGraph(folder_, fields, ""));
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };
  EXPECT_THAT(error("env: \"PATH\""), HasSubstr(":3:1: env 'PATH' is not of the form NAME=VALUE"));
  EXPECT_THAT(error("cpu: 1000"), HasSubstr(":3:1: cpu 1000: this machine has 0 to "));
  EXPECT_THAT(error("nice: 20"), HasSubstr("nice = 20 outside [-20, 19]"));
  EXPECT_THAT(error("stop_signal: \"SIGKILL\""), HasSubstr("is not one of"));
}

TEST_F(LayersTest, StartsAProcessAsItsBlockSays) {
  cpu_set_t before;
  sched_getaffinity(0, sizeof(before), &before);
  int cpu = 0;
  while (!CPU_ISSET(cpu, &before)) ++cpu;
  const std::string graph =
      LiveGraph(folder_, "",
                "env: \"COLOUR=blue\" nice: 5 memory_limit_mb: 700 stop_signal: \"SIGINT\" cpu: " +
                    std::to_string(cpu));
  Launched launcher({LAUNCHER, "run", graph, "--log_dir", folder_.Path("logs")}, folder_);
  ASSERT_TRUE(Eventually([] { return !ModulesOf("fake_filter").empty(); }));
  const auto found = ModulesOf("fake_filter");
  ASSERT_EQ(found.size(), 1u);
  const std::string proc = "/proc/" + std::to_string(found[0]);
  EXPECT_THAT(ReadFile(proc + "/environ"), HasSubstr(std::string("COLOUR=blue\0", 12)));
  EXPECT_THAT(ReadFile(proc + "/status"),
              HasSubstr("Cpus_allowed_list:\t" + std::to_string(cpu) + "\n"));
  EXPECT_THAT(ReadFile(proc + "/limits"), ContainsRegex("Max address space +734003200"));
  EXPECT_EQ(getpriority(PRIO_PROCESS, static_cast<id_t>(found[0])), 5);
  launcher.Signal(SIGTERM);
  EXPECT_EQ(launcher.Wait().code, 0);
}

TEST_F(LayersTest, RunsOnlyTheModulesAndGroupsAskedFor) {
  const std::string graph = FakeGraph(folder_, "group: \"eyes\"", "group: \"brain\"");
  const auto run = [&](const std::string& flag, const std::string& names) {
    return RunLauncher({"run", graph, flag, names, "--set", "source.num_frames=0"}, folder_);
  };
  EXPECT_EQ(run("--only", "eyes").code, 0);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), Not(HasSubstr("filter")));
  EXPECT_EQ(run("--without", "filter").code, 0);
  EXPECT_THAT(ReadFile(folder_.Path("logs/latest/graph.textproto")), Not(HasSubstr("filter")));
  const Outcome unknown = run("--only", "source,brian");
  EXPECT_EQ(unknown.code, 2);
  EXPECT_THAT(unknown.err, HasSubstr("no module or group named 'brian'; did you mean 'brain'?"));
  EXPECT_EQ(run("--without", "eyes,brain").code, 2);
}

}  // namespace
}  // namespace declutter
