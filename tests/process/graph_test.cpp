#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/process/launched.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Standing apart from each other, seen whole.
constexpr const char* kScene = R"(
object { box { size_x_m: 0.16 size_y_m: 0.08 size_z_m: 0.2 } x_m: -0.12 y_m: 0.65 yaw_rad: 0.5 }
object { cylinder { radius_m: 0.045 height_m: 0.15 } x_m: 0.12 y_m: 0.6 }
)";

std::string Program(const std::string& name) { return fs::path(LAUNCHER).parent_path() / name; }

// The whole graph over scene folders, as a user runs it.
class GraphTest : public testing::Test {
 protected:
  std::string RenderScene(const std::string& name) {
    const std::string scene = folder_.Write("scene.textproto", kScene);
    const std::string path = folder_.Path("scenes/" + name);
    EXPECT_EQ(Launched({Program("scene_renderer"), scene, path}, folder_).Wait().code, 0);
    return path;
  }

  Outcome Run(const std::string& input, const std::string& output,
              const std::vector<std::string>& options = {}) {
    std::vector<std::string> arguments = {"run", std::string(CONFIG_FOLDER) + "/" + graph_, "--set",
                                          "object_exporter.output=" + output};
    if (!input.empty()) {
      arguments.insert(arguments.end(), {"--set", "kinect_source.input=" + input});
    }
    arguments.insert(arguments.end(), options.begin(), options.end());
    return RunLauncher(arguments, folder_);
  }

  static std::vector<json> Lines(const std::string& output) {
    std::vector<json> lines;
    std::istringstream text(ReadFile(output + "/objects.jsonl"));
    for (std::string line; std::getline(text, line);) lines.push_back(json::parse(line));
    return lines;
  }

  static std::vector<std::string> Frames(const std::string& output) {
    std::vector<std::string> frames;
    for (const json& line : Lines(output)) frames.push_back(line.at("frame"));
    return frames;
  }

  TemporaryFolder folder_;
  std::string scenes_ = folder_.Path("scenes");
  std::string output_ = folder_.Path("out");
  std::string graph_ = "recordings.textproto";
};

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

TEST_F(GraphTest, FindsThePlaneUnderTheObjects) {
  const std::string scene = RenderScene("one");
  ASSERT_EQ(Run(scene, output_).code, 0);
  const json truth = json::parse(ReadFile(scene + "/scene.json")).at("table_plane");
  const json plane = Lines(output_).at(0).at("planes").at(0);
  EXPECT_LT(Distance_m(plane.at("normal"), truth.at("normal_cam")), 0.01);
  EXPECT_NEAR(plane.at("d"), truth.at("d"), 0.003);
}

TEST_F(GraphTest, GoesOnAfterAnUnreadableSceneAndEndsWithOne) {
  RenderScene("a");
  const std::string damaged = RenderScene("b");
  RenderScene("c");
  std::ofstream(damaged + "/depth.png") << "not an image";
  EXPECT_EQ(Run(scenes_, output_).code, 1);
  EXPECT_THAT(Frames(output_), ElementsAre("a", "b", "c"));
  const std::vector<json> lines = Lines(output_);
  EXPECT_THAT(lines[1].at("error").get<std::string>(), HasSubstr("depth.png"));
  EXPECT_THAT(lines[1].at("objects"), IsEmpty());
  EXPECT_FALSE(lines[0].contains("error"));
  EXPECT_EQ(lines[0].at("objects").size(), 2u);
  EXPECT_EQ(lines[2].at("objects"), lines[0].at("objects"));
}

TEST_F(GraphTest, EndsWithTwoWhenThereIsNothingToRead) {
  EXPECT_EQ(Run(folder_.Path("no_such_folder"), output_).code, 2);
  fs::create_directory(scenes_);
  EXPECT_EQ(Run(scenes_, output_).code, 2);
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

TEST_F(GraphTest, RunsWithTheFeaturesOfThePaper) {
  graph_ = "paper_mode.textproto";
  const Outcome outcome = Run(RenderScene("one"), output_);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(Frames(output_), ElementsAre("one"));
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
