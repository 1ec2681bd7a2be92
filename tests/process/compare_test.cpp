#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/process/graph_run.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

// Two runs over the same input, side by side.
class CompareTest : public GraphRun {
 protected:
  Outcome Compare(const std::vector<std::string>& folders) {
    std::vector<std::string> command = {Program("compare_runs")};
    command.insert(command.end(), folders.begin(), folders.end());
    return Launched(command, folder_).Wait();
  }

  Outcome Script(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {std::string(CONFIG_FOLDER) + "/../tests/compare.sh"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return Launched(command, folder_).Wait();
  }

  std::string candidate_ = folder_.Path("candidate");
};

TEST_F(CompareTest, ScoresTwoRunsAndNamesTheFramesThatDiffer) {
  RenderScene("a");
  RenderScene("b");
  ASSERT_EQ(Run(scenes_, output_).code, 0);
  ASSERT_EQ(Run(scenes_, candidate_).code, 0);
  const Outcome same = Compare({output_, candidate_, scenes_});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out,
              AllOf(HasSubstr("2 frames, 2 with truth\n"), HasSubstr("Of fewer than 10 frames"),
                    HasSubstr("\n0 of 2 frames differ\n"),
                    ContainsRegex("box recall % +100.0 \\[34.2, 100.0\\] +100.0 \\[34.2, 100.0\\] "
                                  "+\\+0.0 \\[\\+0.0, \\+0.0\\]\n")));

  // The candidate finds nothing in the second scene.
  const std::string lines = ReadFile(candidate_ + "/objects.jsonl");
  folder_.Write("candidate/objects.jsonl", lines.substr(0, lines.find('\n') + 1) +
                                               R"({"frame": "b", "utime": 1, "objects": []})");
  const Outcome other = Compare({output_, candidate_, scenes_});
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.out,
              AllOf(HasSubstr("\n1 of 2 frames differ\nb: models 2 / 0, same in both 0, "
                              "found 2 / 0, false 0 / 0\n  " +
                              output_ + "/b.overlay.png\n  " + candidate_ + "/b.overlay.png\n"),
                    ContainsRegex("box recall % +100.0 [^\n]+ 50.0 [^\n]+ -50.0 ")));
}

TEST_F(CompareTest, ComparesRunsOverALogWithEachOther) {
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(RenderScene("a"), output_, {"--record", log}).code, 0);
  ASSERT_EQ(Run("", candidate_, {"--replay", log}).code, 0);
  const Outcome outcome = Compare({output_, candidate_});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("1 frames, 0 with truth\n"), Not(HasSubstr("recall")),
                    ContainsRegex("box also in other % +100.0 "), HasSubstr("\n0 of 1 frames")));
}

TEST_F(CompareTest, EndsWithOneOnRunsThatLackAFrame) {
  RenderScene("a");
  fs::create_directories(output_);
  folder_.Write("out/objects.jsonl", "");
  EXPECT_THAT(Compare({output_, output_}).err, HasSubstr("out: no frame\n"));
  folder_.Write("out/objects.jsonl", R"({"frame": "other", "utime": 1})");
  const Outcome outcome = Compare({output_, output_, scenes_});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("out: lacks frame a\n"));
  EXPECT_EQ(Compare({output_, folder_.Path("nowhere")}).code, 1);
  EXPECT_EQ(Compare({output_}).code, 2);
}

TEST_F(CompareTest, RefusesAWrongCommandLineBeforeItRunsAnything) {
  const auto expect = [this](const std::vector<std::string>& arguments, const std::string& error) {
    const Outcome outcome = Script(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "compare.sh: " + error + "\n");
  };
  const std::string input = folder_.Write("run.lcm", "");
  expect({}, "an input is needed: a folder of scenes or a log");
  expect({"nowhere", "--candidate", "x"}, "nowhere: no such file or folder");
  expect({input}, "nothing to compare: --candidate or --set-candidate is needed");
  expect({input, "--candidate", "x.textproto"}, "x.textproto: no such graph");
  expect({input, "--candidate"}, "--candidate needs a value");
  expect({input, "--colour"}, "unknown option --colour");
}

}  // namespace
}  // namespace declutter
