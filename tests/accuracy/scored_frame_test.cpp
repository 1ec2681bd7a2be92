#include "tests/accuracy/scored_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "modules/imaging/png_file.h"
#include "modules/scene_renderer/scene_folder.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter::accuracy {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

constexpr char kSceneOfOneBox[] = R"({
  "width": 4, "height": 4, "table_plane": {"normal_cam": [0, 0, -1]},
  "objects": [{"id": 2, "labels": [20], "shape": "box", "pose": "standing_on_face",
               "scope": "core"}]})";

constexpr char kBox[] =
    R"({"id": 1, "shape": "box", "position": [0, 0, 1], "orientation": [1, 0, 0, 0],
        "size": [0.1, 0.2, 0.3], "confidence": 0.9,
        "evidence": ["observed", "free_space", "assumed"]})";

// Folders of scenes and results that go with the test.
class ScoreFolderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) /
            ::testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(root_);
    fs::create_directories(results());
  }
  void TearDown() override { fs::remove_all(root_); }

  fs::path scenes() const { return root_ / "scenes"; }
  fs::path results() const { return root_ / "results"; }

  void AddScene(const fs::path& folder, const std::string& text = kSceneOfOneBox) {
    fs::create_directories(folder);
    std::ofstream(folder / "scene.json") << text;
    imaging::WriteGray8Png((folder / "labels.png").string(),
                           {4, 4, std::vector<uint8_t>(16, uint8_t{20})});
  }

  void AddResult(const std::string& frame, const std::string& objects) {
    std::string line = R"({"frame": ")" + frame + R"(", "utime": 1, "objects": [)" + objects + "]}";
    std::replace(line.begin(), line.end(), '\n', ' ');
    std::ofstream(results() / "objects.jsonl", std::ios::app) << line << '\n';
    imaging::WriteGray8Png((results() / (frame + ".labels.png")).string(),
                           {4, 4, std::vector<uint8_t>(16, uint8_t{1})});
  }

  std::string ErrorOfScoring() const {
    try {
      ScoreFolder(scenes(), results());
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  }

 private:
  fs::path root_;
};

TEST_F(ScoreFolderTest, NamesFramesByTheirPathAndGroupsThemByItsFirstFolder) {
  AddScene(scenes() / "b" / "01");
  AddScene(scenes() / "a" / "02");
  AddResult("a_02", kBox);
  AddResult("b_01", "");
  const auto frames = ScoreFolder(scenes(), results());
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[0].truth.frame, "a_02");
  EXPECT_EQ(frames[0].truth.group, "a");
  EXPECT_TRUE(frames[0].score.objects[0].model);
  EXPECT_EQ(frames[0].found.objects[0].evidence[1], Evidence::kFreeSpace);
  EXPECT_TRUE(frames[1].has_result);
  EXPECT_FALSE(frames[1].score.objects[0].model);
}

TEST_F(ScoreFolderTest, NamesTheOnlySceneByItsFolder) {
  AddScene(scenes());
  AddResult("scenes", kBox);
  const auto frames = ScoreFolder(scenes() / "", results());
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].truth.frame, "scenes");
  EXPECT_TRUE(frames[0].has_result);
}

TEST_F(ScoreFolderTest, MarksAFrameWithoutALine) {
  AddScene(scenes() / "01");
  AddScene(scenes() / "02");
  AddResult("02", kBox);
  const auto frames = ScoreFolder(scenes(), results());
  EXPECT_FALSE(frames[0].has_result);
  EXPECT_TRUE(frames[1].has_result);
}

TEST_F(ScoreFolderTest, LeavesOutScenesWithoutTruth) {
  AddScene(scenes() / "01", R"({"width": 4, "height": 4})");
  AddResult("01", "");
  EXPECT_TRUE(ScoreFolder(scenes(), results()).empty());
}

TEST_F(ScoreFolderTest, BoundsTheRadiiOfRenderedCylinders) {
  const RenderedScene scene =
      Render(ParseScene("object { cylinder {} } object { box {} x_m: 0.2 }", "scene"), 1);
  WriteSceneFolder(scene, "01", (scenes() / "01").string());
  AddResult("01", "");
  const auto frames = ScoreFolder(scenes(), results());
  ASSERT_EQ(frames.size(), 1u);
  const auto& objects = frames[0].truth.objects;
  ASSERT_EQ(objects.size(), 2u);
  ASSERT_TRUE(objects[0].radius_bound_m);
  EXPECT_GT(*objects[0].radius_bound_m, 1e-4);
  EXPECT_LT(*objects[0].radius_bound_m, 1e-3);
  EXPECT_FALSE(objects[1].radius_bound_m);
}

TEST_F(ScoreFolderTest, SaysWhichLineOfTheResultsIsBroken) {
  AddScene(scenes() / "01");
  AddResult("01", "");
  std::ofstream(results() / "objects.jsonl", std::ios::app) << "{\"frame\": \n";
  EXPECT_THAT(ErrorOfScoring(), HasSubstr("objects.jsonl:2: "));
}

TEST_F(ScoreFolderTest, SaysWhichFrameComesTwice) {
  AddScene(scenes() / "01");
  AddResult("01", "");
  AddResult("01", "");
  EXPECT_THAT(ErrorOfScoring(), HasSubstr("frame 01 for the second time"));
}

TEST_F(ScoreFolderTest, SaysWhichSceneIsBroken) {
  AddScene(scenes() / "01", "not json");
  AddResult("01", "");
  EXPECT_THAT(ErrorOfScoring(), HasSubstr((scenes() / "01").string()));
}

}  // namespace
}  // namespace declutter::accuracy
