#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "modules/imaging/png_file.h"
#include "tests/process/graph_run.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;

using GraphTest = GraphRun;

double Distance_m(const json& position, const json& other) {
  return std::hypot(position.at(0).get<double>() - other.at(0).get<double>(),
                    position.at(1).get<double>() - other.at(1).get<double>(),
                    position.at(2).get<double>() - other.at(2).get<double>());
}

// The only object of that shape in a list; null for none or several.
json TheOnly(const std::string& shape, const json& objects) {
  json found;
  for (const json& object : objects) {
    if (object.at("shape") != shape) continue;
    if (!found.is_null()) return {};
    found = object;
  }
  return found;
}

// A box's extents, whichever of its horizontal axes is called x.
std::vector<double> Extents_m(const json& object) {
  auto size = object.at("size").get<std::vector<double>>();
  std::sort(size.begin(), size.begin() + 2);
  return size;
}

TEST_F(GraphTest, WritesALineAndPicturesForEachSceneInPathOrder) {
  RenderScene("b");
  RenderScene("a/second");
  RenderScene("a/first");
  const Outcome outcome = Run(scenes_, output_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Frames(output_), ElementsAre("a_first", "a_second", "b"));
  for (const std::string frame : {"a_first", "a_second", "b"}) {
    EXPECT_TRUE(fs::exists(output_ + "/" + frame + ".labels.png"));
    EXPECT_TRUE(fs::exists(output_ + "/" + frame + ".overlay.png"));
  }
}

TEST_F(GraphTest, FindsTheBoxAndTheCylinderOfARenderedScene) {
  const std::string scene = RenderScene("one");
  ASSERT_EQ(Run(scene, output_).code, 0);
  const json truth = json::parse(ReadFile(scene + "/scene.json")).at("objects");
  const std::vector<json> lines = Lines(output_);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].at("frame"), "one");
  const json objects = lines[0].at("objects");
  ASSERT_EQ(objects.size(), 2u);

  const json box = TheOnly("box", objects), true_box = TheOnly("box", truth).at("truth");
  ASSERT_FALSE(box.is_null());
  EXPECT_LT(Distance_m(box.at("position"), true_box.at("position")), 0.005);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(Extents_m(box)[i], Extents_m(true_box)[i], 0.005);
  }
  const json can = TheOnly("cylinder", objects), true_can = TheOnly("cylinder", truth).at("truth");
  ASSERT_FALSE(can.is_null());
  EXPECT_LT(Distance_m(can.at("position"), true_can.at("position")), 0.005);
  EXPECT_NEAR(can.at("radius"), true_can.at("radius"), 0.003);
  EXPECT_NEAR(can.at("height"), true_can.at("height"), 0.005);
}

TEST_F(GraphTest, FindsObjectsInAnImageThatDoesNotFitIntoAMessage) {
  const std::string text = folder_.Write("large.textproto", R"(
camera { width: 1280 height: 720 fx: 1050 fy: 1050 cx: 639.5 cy: 359.5 depth_scale_m: 0.0001 }
object { box { size_x_m: 0.16 size_y_m: 0.08 size_z_m: 0.2 } x_m: -0.12 y_m: 0.65 yaw_rad: 0.5 }
object { cylinder { radius_m: 0.045 height_m: 0.15 } x_m: 0.12 y_m: 0.6 }
)");
  const std::string scene = folder_.Path("scenes/large");
  ASSERT_EQ(Launched({Program("scene_renderer"), text, scene}, folder_).Wait().code, 0);
  const Outcome outcome = Run(scene, output_);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr("kinect_source: depth image 1280x720 does not fit "
                                              "into a message: every 2nd row and column is sent"));
  EXPECT_EQ(Lines(output_).at(0).at("objects").size(), 2u);
  for (const std::string picture : {"labels", "overlay"}) {
    const ColorImage image = imaging::ReadRgbPng(output_ + "/large." + picture + ".png");
    EXPECT_EQ(image.width, 1280);
    EXPECT_EQ(image.height, 720);
  }
  // Labels and truth overlap.
  const Outcome score =
      Launched({Program("score_objects"), scene, output_, "--min_found", "2"}, folder_).Wait();
  EXPECT_EQ(score.code, 0) << score.out << score.err;
}

TEST_F(GraphTest, FindsThePlaneUnderTheObjects) {
  const std::string scene = RenderScene("one");
  ASSERT_EQ(Run(scene, output_).code, 0);
  const json truth = json::parse(ReadFile(scene + "/scene.json")).at("table_plane");
  const json plane = Lines(output_).at(0).at("planes").at(0);
  EXPECT_LT(Distance_m(plane.at("normal"), truth.at("normal_cam")), 0.01);
  EXPECT_NEAR(plane.at("d"), truth.at("d"), 0.003);
}

TEST_F(GraphTest, WritesTheSameLinesForTheSameScenesAndForTheirLog) {
  RenderScene("a");
  RenderScene("b");
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(scenes_, output_, {"--record", log}).code, 0);
  const std::string lines = ReadFile(output_ + "/objects.jsonl");
  ASSERT_THAT(Frames(output_), ElementsAre("a", "b"));
  ASSERT_EQ(Run(scenes_, folder_.Path("again")).code, 0);
  EXPECT_EQ(ReadFile(folder_.Path("again/objects.jsonl")), lines);
  ASSERT_EQ(Run("", folder_.Path("replayed"), {"--replay", log}).code, 0);
  EXPECT_EQ(ReadFile(folder_.Path("replayed/objects.jsonl")), lines);
  const Outcome late = Run("", folder_.Path("late"), {"--replay", log, "--from", "model_verifier"});
  ASSERT_EQ(late.code, 0) << late.err;
  EXPECT_EQ(ReadFile(folder_.Path("late/objects.jsonl")), lines);
}

TEST_F(GraphTest, ReplaysALogWithTheParametersOfTheRobot) {
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(RenderScene("a"), output_, {"--record", log}).code, 0);
  graph_ = "replay.textproto";
  const Outcome outcome = Run("", folder_.Path("replayed"), {"--replay", log});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(ReadFile(folder_.Path("replayed/objects.jsonl")), ReadFile(output_ + "/objects.jsonl"));
  const Outcome without_log = Run("", output_);
  EXPECT_EQ(without_log.code, 2);
  EXPECT_THAT(without_log.err, testing::HasSubstr("kinect_source.input must be set"));
}

TEST_F(GraphTest, RunsWithTheFeaturesOfThePaper) {
  graph_ = "paper_mode.textproto";
  const Outcome outcome = Run(RenderScene("one"), output_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Frames(output_), ElementsAre("one"));
}

TEST_F(GraphTest, RunsWithASegmenterThatDoesNotVote) {
  graph_ = "single_shot.textproto";
  ASSERT_EQ(Run(RenderScene("one"), output_).code, 0);
  const json objects = Lines(output_).at(0).at("objects");
  ASSERT_EQ(objects.size(), 2u);
  // A side has the one vote of its fit; what is proposed by its top alone has none.
  EXPECT_EQ(TheOnly("box", objects).at("votes"), 1);
  EXPECT_LE(TheOnly("cylinder", objects).at("votes"), 1);
}

TEST_F(GraphTest, DrawsTheFeaturesWhenAsked) {
  const Outcome outcome =
      Run(RenderScene("one"), output_, {"--set", "object_exporter.feature_pictures=true"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string picture : {"curvature", "r_min"}) {
    const ColorImage image = imaging::ReadRgbPng(output_ + "/one." + picture + ".png");
    EXPECT_TRUE(std::any_of(image.rgb.begin(), image.rgb.end(), [](int c) { return c > 0; }));
  }
}

TEST_F(GraphTest, RunsTwoSegmentersSideBySide) {
  graph_ = "side_by_side.textproto";
  const std::string second = folder_.Path("second");
  const Outcome outcome =
      Run(RenderScene("one"), output_, {"--set", "second_exporter.output=" + second});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Frames(output_), ElementsAre("one"));
  EXPECT_THAT(Frames(second), ElementsAre("one"));
}

TEST_F(GraphTest, GivesTheBytesOfTheRunWhenAModuleIsReplayedAlone) {
  RenderScene("a");
  RenderScene("b");
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(scenes_, output_, {"--record", log}).code, 0);
  const std::map<std::string, std::string> channels = {{"plane_filter", "TABLETOP"},
                                                       {"feature_estimator", "FEATURES"},
                                                       {"hough_segmenter", "HYPOTHESES"},
                                                       {"model_verifier", "OBJECTS"}};
  for (const auto& [module, channel] : channels) {
    const std::string replayed = folder_.Path(module + ".lcm");
    const Outcome outcome =
        Launched({Program(module), "--replay", log, "--record", replayed}, folder_).Wait();
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(MessagesOf(channel, replayed).size(), 2u) << module;
    EXPECT_EQ(MessagesOf(channel, replayed), MessagesOf(channel, log)) << module;
  }
}

TEST_F(GraphTest, GivesObjectsToPythonWithoutAnyPackage) {
  if (!fs::exists("/usr/bin/python3")) GTEST_SKIP() << "no python3";
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(RenderScene("one"), output_, {"--record", log}).code, 0);
  std::vector<std::string> generate = {"/usr/bin/lcm-gen", "-p", "--ppath", folder_.Path("python")};
  const std::string types = std::string(CONFIG_FOLDER) + "/../lcmtypes";
  for (const auto& entry : fs::directory_iterator(types)) {
    if (entry.path().extension() == ".lcm") generate.push_back(entry.path());
  }
  ASSERT_EQ(Launched(generate, folder_).Wait().code, 0);
  const auto set_path = [&] { setenv("PYTHONPATH", folder_.Path("python").c_str(), 1); };
  const Outcome outcome =
      Launched({"/usr/bin/python3", types + "/read_objects.py", log}, folder_, set_path).Wait();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::EndsWith(" 2 objects\n"));
}

TEST_F(GraphTest, ChecksEveryGraphThatIsShipped) {
  for (const auto& entry : fs::directory_iterator(CONFIG_FOLDER)) {
    const std::string path = entry.path();
    const bool is_graph = entry.path().extension() == ".textproto" &&
                          ReadFile(path).find("module {") != std::string::npos;
    if (!is_graph) continue;
    const Outcome outcome = RunLauncher({"check", path}, folder_);
    EXPECT_EQ(outcome.code, 0) << path << outcome.err;
  }
}

TEST_F(GraphTest, GivesTheSameObjectsWhenReplayedFromAnyModule) {
  RenderScene("a");
  RenderScene("b");
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(scenes_, output_, {"--record", log}).code, 0);
  const std::string lines = ReadFile(output_ + "/objects.jsonl");
  for (const std::string module : {"plane_filter", "feature_estimator", "hough_segmenter",
                                   "model_verifier", "object_exporter"}) {
    const std::string output = folder_.Path("from_" + module), again = output + ".lcm";
    const Outcome outcome = Run("", output, {"--replay", log, "--from", module, "--record", again});
    EXPECT_EQ(outcome.code, 0) << module << outcome.err;
    EXPECT_EQ(ReadFile(output + "/objects.jsonl"), lines) << module;
    EXPECT_EQ(MessagesOf("OBJECTS", again), MessagesOf("OBJECTS", log)) << module;
  }
}

TEST_F(GraphTest, GivesTheObjectsOfALiveRunWhichSkippedFramesWhenReplayed) {
  RenderScene("a");
  const std::string log = folder_.Path("live.lcm");
  graph_ = "live.textproto";
  const Outcome live = Run(scenes_, output_,
                           {"--record", log, "--set", "kinect_source.rate_hz=100", "--set",
                            "kinect_source.loop=true", "--set", "kinect_source.num_frames=80"});
  ASSERT_EQ(live.code, 0) << live.err;
  const auto recorded = MessagesOf("OBJECTS", log);
  ASSERT_FALSE(recorded.empty());
  graph_ = "recordings.textproto";
  for (const std::string module : {"hough_segmenter", "model_verifier"}) {
    const std::string again = folder_.Path(module + ".lcm");
    const Outcome outcome =
        Run("", folder_.Path(module), {"--replay", log, "--from", module, "--record", again});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(MessagesOf("OBJECTS", again), testing::IsSupersetOf(recorded)) << module;
  }
}

TEST_F(GraphTest, GivesTheSameBytesAtEveryStageOfTwoReplays) {
  RenderScene("a");
  RenderScene("b");
  const std::string log = folder_.Path("run.lcm");
  ASSERT_EQ(Run(scenes_, output_, {"--record", log}).code, 0);
  for (const std::string again : {"first", "second"}) {
    const Outcome outcome =
        Run("", folder_.Path(again), {"--replay", log, "--record", folder_.Path(again + ".lcm")});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }
  for (const std::string channel :
       {"DEPTH_FRAME", "TABLETOP", "FEATURES", "HYPOTHESES", "OBJECTS"}) {
    const auto messages = MessagesOf(channel, folder_.Path("first.lcm"));
    EXPECT_EQ(messages.size(), 2u) << channel;
    EXPECT_EQ(messages, MessagesOf(channel, folder_.Path("second.lcm"))) << channel;
    EXPECT_EQ(messages, MessagesOf(channel, log)) << channel;
  }
}

// Of each real recording, one object that stands free.
class RecordingTest : public GraphTest, public testing::WithParamInterface<const char*> {};

TEST_P(RecordingTest, FindsAnObjectOfARealRecordingWhereItIs) {
  const char* data = std::getenv("DECLUTTER_DATA");
  if (data == nullptr || !fs::is_directory(data)) {
    GTEST_SKIP() << "DECLUTTER_DATA names no folder of recordings";
  }
  const std::string scene = std::string(data) + "/" + GetParam();
  const Outcome outcome = Run(scene, output_);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Frames(output_), ElementsAre(fs::path(scene).filename().string()));
  const Outcome score =
      Launched({Program("score_objects"), scene, output_, "--min_found", "1"}, folder_).Wait();
  EXPECT_EQ(score.code, 0) << score.out << score.err;
}

INSTANTIATE_TEST_SUITE_P(Real, RecordingTest,
                         testing::Values("d415_single/cheezit", "d415_single/cylinder",
                                         "mosd/learn00"));

}  // namespace
}  // namespace declutter
