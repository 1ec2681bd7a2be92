#include "modules/kinect_source/point_clouds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "modules/imaging/temporary_folder.h"
#include "modules/kinect_source/recording_files.h"

namespace declutter {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr PinholeCamera kCamera = {20, 12, 30, 31, 9.5, 5.25};
constexpr const char* kCameraJson =
    R"({"width": 20, "height": 12, "fx": 30, "fy": 31, "cx": 9.5, "cy": 5.25})";

// An ASCII .pcd of a wall 0.9 m away, red everywhere.
std::string Wall(int width, int height, const std::string& fields = "x y z rgba") {
  std::ostringstream text;
  text << "VERSION 0.7\nFIELDS " << fields << "\nSIZE 4 4 4 4\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH "
       << width << "\nHEIGHT " << height << "\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " << width * height
       << "\nDATA ascii\n";
  for (int v = 0; v < kCamera.height; ++v) {
    for (int u = 0; u < kCamera.width; ++u) {
      text << (kCamera.Ray(u, v) * 0.9).transpose() << " " << 0xFFC80000u << "\n";
    }
  }
  return text.str();
}

class PointCloudsTest : public ::testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  std::string ErrorOf(const std::string& name) const {
    try {
      ListPointClouds(Path(name), "").at(0).load();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  imaging::TemporaryFolder folder_;
};

TEST_F(PointCloudsTest, ReadsAnOrganisedCloud) {
  WriteText(Path("wall.pcd"), Wall(20, 12));
  const auto entries = ListPointClouds(Path("wall.pcd"), "");
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].name, "wall");
  const auto content = entries[0].load();
  EXPECT_NEAR(content.depth.camera.fx, 30, 0.01);
  EXPECT_NEAR(content.depth.camera.cy, 5.25, 0.01);
  EXPECT_EQ(content.depth.counts.size(), 240u);
  EXPECT_THAT(content.depth.counts, Each(900));
  ASSERT_TRUE(content.color);
  EXPECT_EQ(content.color->rgb[0], 0xC8);
  EXPECT_EQ(content.color->rgb[1], 0);
}

TEST_F(PointCloudsTest, ReadsAFolderInByteOrder) {
  WriteText(Path("b.pcd"), Wall(20, 12));
  WriteText(Path("a.pcd"), Wall(20, 12));
  const auto entries = ListPointClouds(folder_.path(), "");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "a");
  EXPECT_EQ(entries[1].name, "b");
  EXPECT_EQ(entries[1].utime, 33333);
}

TEST_F(PointCloudsTest, ProjectsAnUnorganisedCloudOfAKnownCamera) {
  WriteText(Path("wall.pcd"), Wall(240, 1));
  WriteText(Path("intrinsics.json"), kCameraJson);
  const auto content = ListPointClouds(Path("wall.pcd"), "").at(0).load();
  EXPECT_EQ(content.depth.camera.width, 20);
  EXPECT_THAT(content.depth.counts, Each(900));
}

TEST_F(PointCloudsTest, SaysWhatAnUnorganisedCloudLacks) {
  WriteText(Path("wall.pcd"), Wall(240, 1));
  EXPECT_THAT(ErrorOf("wall.pcd"), HasSubstr("wall.pcd: not organised (height 1)"));
  EXPECT_THAT(ErrorOf("wall.pcd"), HasSubstr("intrinsics_file"));
}

TEST_F(PointCloudsTest, TakesACloudWithoutColour) {
  WriteText(Path("wall.pcd"), Wall(20, 12, "x y z label"));
  EXPECT_FALSE(ListPointClouds(Path("wall.pcd"), "").at(0).load().color);
}

TEST_F(PointCloudsTest, TakesTheCameraOfACloudWithoutMeasurementsFromTheFile) {
  std::string text = Wall(20, 12);
  text.resize(text.find("DATA ascii") + 11);
  for (int i = 0; i < 240; ++i) text += "nan nan nan 0\n";
  WriteText(Path("dark.pcd"), text);
  EXPECT_THAT(ErrorOf("dark.pcd"), HasSubstr("dark.pcd: only 0 measured points"));
  WriteText(Path("intrinsics.json"), kCameraJson);
  EXPECT_THAT(ListPointClouds(Path("dark.pcd"), "").at(0).load().depth.counts, Each(0));
}

TEST_F(PointCloudsTest, RefusesAnIntrinsicsFileThatIsNotThere) {
  WriteText(Path("wall.pcd"), Wall(20, 12));
  EXPECT_THROW(ListPointClouds(Path("wall.pcd"), Path("none.json")), std::invalid_argument);
}

TEST_F(PointCloudsTest, IsEmptyWithoutClouds) {
  EXPECT_THAT(ListPointClouds(folder_.path(), ""), IsEmpty());
}

}  // namespace
}  // namespace declutter
