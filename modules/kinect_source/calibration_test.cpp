#include "modules/kinect_source/calibration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/imaging/temporary_folder.h"
#include "modules/kinect_source/recording_files.h"

namespace declutter {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kRosYaml = R"(image_width: 3
image_height: 2
camera_name: depth
camera_matrix:
  rows: 3
  cols: 3
  data: [570.5, 0, 1.25, 0, 571.5, 0.75, 0, 0, 1]
distortion_model: plumb_bob
distortion_coefficients:
  rows: 1
  cols: 5
  data: [0, 0, 0, 0, 0]
)";

constexpr const char* kOpenCvYaml = R"(%YAML:1.0
---
image_width: 3
image_height: 2
camera_matrix: !!opencv-matrix
   rows: 3
   cols: 3
   dt: d
   data: [ 5.705e+02, 0., 1.25, 0., 5.715e+02, 0.75, 0., 0., 1. ]
distortion_coefficients: !!opencv-matrix
   rows: 5
   cols: 1
   dt: d
   data: [ -2.6e-01, 9.1e-01, 1.0e-03, -2.0e-03, -1.0e+00 ]
)";

RecordedFrame Frame() {
  RecordedFrame frame;
  frame.depth.image = {{3, 2, 500, 500, 1, 0.5}, 0.001, {1000, 0, 2000, 500, 65535, 1}};
  frame.color = ColorImage{3, 2, std::vector<uint8_t>(18, 7)};
  return frame;
}

class CalibrationTest : public testing::Test {
 protected:
  Calibration Make(const std::string& text, const std::string& name) {
    WriteText(folder_ / name, text);
    config_.set_intrinsics_file(folder_ / name);
    return Calibration(config_, false);
  }

  std::string FaultOf(const std::string& text) {
    try {
      Make(text, "camera.yaml");
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  imaging::TemporaryFolder folder_;
  KinectSourceConfig config_;
};

TEST_F(CalibrationTest, ChangesNothingUnlessTold) {
  RecordedFrame frame = Frame();
  Calibration(config_, false).Apply(&frame);
  EXPECT_EQ(frame.depth.image.counts, Frame().depth.image.counts);
  EXPECT_EQ(frame.depth.image.camera.fx, 500);
}

TEST_F(CalibrationTest, CorrectsDepthByScaleAndOffset) {
  config_.set_depth_scale(1.01);
  config_.set_depth_offset_m(-0.005);
  RecordedFrame frame = Frame();
  Calibration(config_, true).Apply(&frame);
  EXPECT_THAT(frame.depth.image.counts, ElementsAre(1005, 0, 2015, 500, 65535, 0));
}

TEST_F(CalibrationTest, TakesIntrinsicsAsRosWritesThem) {
  RecordedFrame frame = Frame();
  Make(kRosYaml, "camera.yaml").Apply(&frame);
  const PinholeCamera& camera = frame.depth.image.camera;
  EXPECT_EQ(camera.fx, 570.5);
  EXPECT_EQ(camera.fy, 571.5);
  EXPECT_EQ(camera.cx, 1.25);
  EXPECT_EQ(camera.cy, 0.75);
  EXPECT_EQ(frame.depth.image.counts, Frame().depth.image.counts);
}

TEST_F(CalibrationTest, TakesIntrinsicsAndLensAsOpenCvWritesThem) {
  const Calibration calibration = Make(kOpenCvYaml, "camera.yml");
  ASSERT_TRUE(calibration.file());
  EXPECT_EQ(calibration.file()->camera.fx, 570.5);
  EXPECT_THAT(calibration.file()->distortion, ElementsAre(-0.26, 0.91, 0.001, -0.002, -1));
}

TEST_F(CalibrationTest, TakesIntrinsicsFromJson) {
  EXPECT_EQ(Make(kCamera3x2, "camera.json").file()->camera.fy, 501);
}

TEST_F(CalibrationTest, RefusesAFrameOfAnotherSize) {
  RecordedFrame frame = Frame();
  frame.depth.image.camera.width = 6;
  frame.depth.image.camera.height = 1;
  Make(kRosYaml, "camera.yaml").Apply(&frame);
  EXPECT_THAT(frame.depth.header.error, HasSubstr("another size than the image's 6x1 px"));
  EXPECT_TRUE(frame.depth.image.empty());
}

TEST_F(CalibrationTest, SaysWhatIsWrongWithAFile) {
  EXPECT_THAT(FaultOf("image_width: 3\n"), HasSubstr("camera.yaml: image_height is missing"));
  EXPECT_THAT(FaultOf("image_width: three\n"), HasSubstr("image_width is not a number"));
  EXPECT_THAT(FaultOf("a: [1,\n"), HasSubstr("not YAML"));
  EXPECT_THAT(FaultOf("5"), HasSubstr("not a calibration"));
  std::string text = kRosYaml;
  text.replace(text.find("570.5"), 5, "0");
  EXPECT_THAT(FaultOf(text), HasSubstr("fx = 0 outside"));
  text = kRosYaml;
  text.replace(text.find("570.5, "), 7, "");
  EXPECT_THAT(FaultOf(text), HasSubstr("camera_matrix has 8 numbers, not 9"));
}

// A lens that moves what it sees by 10 % at the image's left and right ends.
TEST(RectificationTest, PutsPixelsWhereTheirRaysBelong) {
  const PinholeCamera camera{101, 1, 50, 50, 50, 0};
  const Distortion distortion = {-0.1, 0, 0, 0, 0};
  DepthImage seen{camera, 0.001, std::vector<uint16_t>(101, 0)};
  ColorImage color{101, 1, std::vector<uint8_t>(303, 0)};
  seen.counts[95] = 700;  // the ray x = 1 is seen at 0.9
  color.rgb[3 * 95 + 1] = 200;
  const Rectification rectification(camera, distortion);
  rectification.Apply(&seen);
  rectification.Apply(&color);
  EXPECT_EQ(seen.counts[100], 700);
  EXPECT_EQ(color.rgb[3 * 100 + 1], 200);
  EXPECT_EQ(seen.counts[50], 0);
}

TEST(RectificationTest, LeavesNothingWhereTheLensSawNothing) {
  const PinholeCamera camera{101, 1, 50, 50, 50, 0};
  DepthImage seen{camera, 0.001, std::vector<uint16_t>(101, 900)};
  Rectification(camera, {0.1, 0, 0, 0, 0}).Apply(&seen);
  EXPECT_EQ(seen.counts[100], 0);
  EXPECT_EQ(seen.counts[90], 900);
}

}  // namespace
}  // namespace declutter
