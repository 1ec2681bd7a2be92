#include "modules/kinect_source/png_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "modules/imaging/temporary_folder.h"
#include "modules/kinect_source/recording_files.h"

namespace declutter {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kCameraWithoutScale =
    R"({"width": 3, "height": 2, "fx": 500, "fy": 501, "cx": 1, "cy": 0.5})";

class PngSequenceTest : public ::testing::Test {
 protected:
  std::filesystem::path Path(const std::string& name) const { return folder_.path() / name; }

  imaging::TemporaryFolder folder_;
};

TEST_F(PngSequenceTest, TakesTimesFromNames) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteDepth3x2(Path("depth/1305031102.160407.png"), 5000);
  WriteDepth3x2(Path("depth/1305031102.2.png"), 5000);
  const auto entries = ListPngSequence(folder_.path(), "");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "1305031102.160407");
  EXPECT_EQ(entries[0].utime, 1305031102160407);
  EXPECT_EQ(entries[1].utime, 1305031102200000);
}

TEST_F(PngSequenceTest, Counts5000PerMetreUnlessTold) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteDepth3x2(Path("1.0.png"), 5000);
  const auto depth = ListPngSequence(folder_.path(), "").at(0).load().depth;
  EXPECT_DOUBLE_EQ(depth.DepthAt(0, 0), 1.0);
  WriteText(Path("millimetres.json"), kCamera3x2);
  const auto other = ListPngSequence(folder_.path(), Path("millimetres.json")).at(0).load().depth;
  EXPECT_DOUBLE_EQ(other.DepthAt(0, 0), 5.0);
}

TEST_F(PngSequenceTest, SpacesNamesWithoutTimeByOneThirtiethOfASecond) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteDepth3x2(Path("0007.png"), 1);
  WriteDepth3x2(Path("0009.png"), 2);
  const auto entries = ListPngSequence(folder_.path(), "");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "0007");
  EXPECT_EQ(entries[1].utime, 33333);
}

TEST_F(PngSequenceTest, MatchesColourByNearestTime) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteDepth3x2(Path("depth/10.000000.png"), 1);
  WriteColor3x2(Path("rgb/9.985000.png"), 1);
  WriteColor3x2(Path("rgb/10.010000.png"), 2);
  const auto color = ListPngSequence(folder_.path(), "").at(0).load().color;
  ASSERT_TRUE(color);
  EXPECT_EQ(color->rgb[0], 2);
}

TEST_F(PngSequenceTest, LeavesOutColourOfAnotherTime) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteDepth3x2(Path("depth/10.000000.png"), 1);
  WriteColor3x2(Path("rgb/10.030000.png"), 2);
  const auto content = ListPngSequence(folder_.path(), "").at(0).load();
  EXPECT_FALSE(content.color);
  EXPECT_EQ(content.color_error, "");
}

TEST_F(PngSequenceTest, ReadsAssociationLists) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteText(Path("depth.txt"), "# time file\n2.5 later.png\n\n1.25 sooner.png\n");
  WriteText(Path("rgb.txt"), "1.251 color.png\n");
  WriteDepth3x2(Path("later.png"), 2);
  WriteDepth3x2(Path("sooner.png"), 1);
  WriteColor3x2(Path("color.png"), 9);
  const auto entries = ListPngSequence(folder_.path(), "");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "sooner");
  EXPECT_EQ(entries[0].utime, 1250000);
  EXPECT_TRUE(entries[0].load().color);
  EXPECT_THAT(entries[1].load().depth.counts, Each(2));
  EXPECT_FALSE(entries[1].load().color);
}

TEST_F(PngSequenceTest, GivesFramesOfTheSameTimeDifferentOnes) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteText(Path("depth.txt"), "1.5 a.png\n1.5 b.png\n");
  const auto entries = ListPngSequence(folder_.path(), "");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].utime, 1500000);
  EXPECT_EQ(entries[1].utime, 1500001);
}

TEST_F(PngSequenceTest, ReportsAMissingImageWhenItIsRead) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteText(Path("depth.txt"), "1.5 a.png\n");
  const auto entry = ListPngSequence(folder_.path(), "").at(0);
  EXPECT_THROW(entry.load(), std::runtime_error);
}

TEST_F(PngSequenceTest, RefusesAListThatCannotBeUnderstood) {
  WriteText(Path("intrinsics.json"), kCameraWithoutScale);
  WriteText(Path("depth.txt"), "1.5 a.png\nyesterday b.png\n");
  try {
    ListPngSequence(folder_.path(), "");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("depth.txt:2: a line must be"));
  }
}

TEST_F(PngSequenceTest, RefusesImagesOfAnUnknownCamera) {
  WriteDepth3x2(Path("1.0.png"), 5000);
  try {
    ListPngSequence(folder_.path(), "");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("intrinsics.json: No such file"));
    EXPECT_THAT(error.what(), HasSubstr("intrinsics_file"));
  }
}

TEST_F(PngSequenceTest, ReadsASingleImage) {
  WriteText(Path("intrinsics.json"), kCamera3x2);
  WriteDepth3x2(Path("one.png"), 7);
  WriteDepth3x2(Path("two.png"), 8);
  const auto entries = ListPngSequence(Path("two.png"), "");
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_THAT(entries[0].load().depth.counts, Each(8));
}

TEST_F(PngSequenceTest, IsEmptyWithoutImages) {
  EXPECT_THAT(ListPngSequence(folder_.path(), ""), IsEmpty());
}

}  // namespace
}  // namespace declutter
