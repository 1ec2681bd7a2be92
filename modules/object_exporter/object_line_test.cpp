#include "modules/object_exporter/object_line.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace declutter {
namespace {

using nlohmann::json;

ObjectModel Box() {
  ObjectModel box;
  box.id = 1;
  box.solid.X_CO.translation() = Eigen::Vector3d(0.1, -0.2, 0.9);
  box.solid.size = Eigen::Vector3d(0.12, 0.08, 1.0 / 3);
  box.evidence = {Evidence::kObserved, Evidence::kFreeSpace, Evidence::kAssumed};
  box.confidence = 0.75f;
  box.covariance(3, 3) = 4e-6;
  box.covariance(0, 3) = box.covariance(3, 0) = -1e-7;
  box.num_votes = 9;
  return box;
}

ObjectList List(const std::vector<ObjectModel>& objects) {
  ObjectList list;
  list.header = {33333, "desk_mug", ""};
  list.planes = {{Eigen::Vector3d(0, -0.6, -0.8), 0.7}};
  list.objects = objects;
  return list;
}

TEST(ObjectLineTest, WritesFrameTimeAndPlanes) {
  const json line = json::parse(ObjectLine(List({}), ""));
  EXPECT_EQ(line, json::parse(R"({"frame": "desk_mug", "utime": 33333,
      "planes": [{"normal": [0.0, -0.6, -0.8], "d": 0.7}], "objects": []})"));
}

TEST(ObjectLineTest, WritesABox) {
  ObjectList list = List({Box()});
  list.labels = {0, 1, 1, 2};
  const json box = json::parse(ObjectLine(list, "")).at("objects").at(0);
  EXPECT_EQ(box.at("id"), 1);
  EXPECT_EQ(box.at("shape"), "box");
  EXPECT_EQ(box.at("position"), json::parse("[0.1, -0.2, 0.9]"));
  EXPECT_EQ(box.at("orientation"), json::parse("[1.0, 0.0, 0.0, 0.0]"));
  EXPECT_EQ(box.at("size"), json::parse("[0.12, 0.08, 0.333333]"));
  EXPECT_EQ(box.at("confidence"), 0.75);
  EXPECT_EQ(box.at("evidence"), json::parse(R"(["observed", "free_space", "assumed"])"));
  EXPECT_EQ(box.at("covariance").size(), 7u);
  EXPECT_EQ(box.at("covariance").at(3).at(3), 4e-6);
  EXPECT_EQ(box.at("covariance").at(0).at(3), box.at("covariance").at(3).at(0));
  EXPECT_EQ(box.at("votes"), 9);
  EXPECT_EQ(box.at("visible_px"), 2);
  EXPECT_FALSE(box.contains("radius"));
}

TEST(ObjectLineTest, WritesACylinderByRadiusAndHeight) {
  ObjectModel can = Box();
  can.solid.shape = Shape::kCylinder;
  can.solid.size = Eigen::Vector3d(0.07, 0.07, 0.11);
  const json cylinder = json::parse(ObjectLine(List({can}), "")).at("objects").at(0);
  EXPECT_EQ(cylinder.at("shape"), "cylinder");
  EXPECT_EQ(cylinder.at("radius"), 0.035);
  EXPECT_EQ(cylinder.at("height"), 0.11);
  EXPECT_FALSE(cylinder.contains("size"));
}

TEST(ObjectLineTest, OrientationTurnsTheSolidIntoTheCamera) {
  ObjectModel box = Box();
  box.solid.X_CO.linear() =
      Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const json line = json::parse(ObjectLine(List({box}), ""));
  EXPECT_EQ(line.at("objects").at(0).at("orientation"),
            json::parse("[0.707107, 0.707107, 0.0, 0.0]"));
}

TEST(ObjectLineTest, WritesWhyThereIsNoImage) {
  ObjectList list;
  list.header = {0, "a", "depth.png: truncated PNG"};
  EXPECT_EQ(
      ObjectLine(list, ""),
      R"({"frame":"a","utime":0,"error":"depth.png: truncated PNG","planes":[],"objects":[]})");
}

TEST(ObjectLineTest, NamesThePictures) {
  const json line = json::parse(ObjectLine(List({}), "mug-2"));
  EXPECT_EQ(line.at("labels"), "mug-2.labels.png");
  EXPECT_EQ(line.at("overlay"), "mug-2.overlay.png");
}

TEST(ObjectLineTest, IsOneLineOfJsonWhateverTheNameIs) {
  ObjectList list = List({});
  list.header.frame = "a\n\"b\"\xFF";
  const std::string line = ObjectLine(list, "");
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(json::parse(line).at("frame"), "a\n\"b\"\xEF\xBF\xBD");
}

}  // namespace
}  // namespace declutter
