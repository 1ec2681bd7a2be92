#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "modules/imaging/png_file.h"
#include "modules/plane_filter/plane_filter.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

// Scene folders below $DECLUTTER_DATA with a depth image, the true table and, for some, labels.
class RealRecordingsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("DECLUTTER_DATA");
    if (data == nullptr) GTEST_SKIP() << "DECLUTTER_DATA is not set: no real recordings to filter";
    for (const auto& entry : fs::recursive_directory_iterator(data)) {
      if (entry.path().filename() == "scene.json") scenes_.push_back(entry.path().parent_path());
    }
    std::sort(scenes_.begin(), scenes_.end());
    ASSERT_FALSE(scenes_.empty());
  }

  std::vector<fs::path> scenes_;
};

nlohmann::json Truth(const fs::path& scene) {
  return nlohmann::json::parse(std::ifstream(scene / "scene.json"));
}

DepthFrame Load(const fs::path& scene, const std::string& image) {
  const nlohmann::json truth = Truth(scene);
  DepthFrame frame;
  frame.image.camera = {truth["width"], truth["height"], truth["fx"],
                        truth["fy"],    truth["cx"],     truth["cy"]};
  frame.image.depth_scale_m = truth["depth_scale_m"];
  frame.image.counts = imaging::ReadGray16Png((scene / image).string()).pixels;
  return frame;
}

void ExpectTable(const Tabletop& tabletop, const nlohmann::json& table, const std::string& name) {
  ASSERT_FALSE(tabletop.planes.empty()) << name;
  const auto& normal = table["normal_cam"];
  const Eigen::Vector3d true_normal(normal[0], normal[1], normal[2]);
  const double cosine = tabletop.planes[0].plane.normal.dot(true_normal.normalized());
  EXPECT_LT(std::acos(std::min(cosine, 1.0)) * 180 / M_PI, 1.0) << name;
  EXPECT_NEAR(tabletop.planes[0].plane.d, table["d"].get<double>(), 0.006) << name;
}

TEST_F(RealRecordingsTest, MainSupportIsTheTableOfEveryScene) {
  PlaneFilter filter{PlaneFilterConfig()};
  for (const fs::path& scene : scenes_) {
    for (const std::string image : {"depth.png", "depth_uncropped.png"}) {
      if (!fs::exists(scene / image)) continue;
      const Tabletop tabletop = filter.Filter(Load(scene, image));
      ExpectTable(tabletop, Truth(scene)["table_plane"], (scene / image).string());
    }
  }
}

TEST_F(RealRecordingsTest, KeepsLabelledObjectsAndDropsTheTable) {
  PlaneFilter filter{PlaneFilterConfig()};
  int num_labelled = 0;
  for (const fs::path& scene : scenes_) {
    if (!fs::exists(scene / "labels.png")) continue;
    ++num_labelled;
    const DepthFrame frame = Load(scene, "depth.png");
    const Tabletop tabletop = filter.Filter(frame);
    const auto labels = imaging::ReadGray8Png((scene / "labels.png").string()).pixels;
    int num_object = 0, num_object_kept = 0, num_table = 0, num_table_kept = 0;
    for (size_t i = 0; i < labels.size(); ++i) {
      if (frame.image.counts[i] == 0 || labels[i] == 0) continue;
      const bool object = labels[i] >= 20;
      const bool kept = tabletop.objects.counts[i] > 0;
      num_object += object;
      num_object_kept += object && kept;
      num_table += !object;
      num_table_kept += !object && kept;
    }
    // Inside a bowl or a pot some pixels are as low as the table.
    EXPECT_GT(num_object_kept, 0.94 * num_object) << scene;
    EXPECT_LT(num_table_kept, 0.01 * num_table) << scene;
  }
  EXPECT_GT(num_labelled, 0);
}

}  // namespace
}  // namespace declutter
