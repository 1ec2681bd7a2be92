#include <limits>
#include <random>

#include "modules/codec/depth_compression.h"
#include "modules/codec/test_frames.h"

namespace declutter::codec {
namespace {

using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A frame of the size that sensors have.
DepthFrame LargeFrame(uint16_t count) {
  DepthFrame frame = TestDepthFrame();
  frame.image.camera.width = 640;
  frame.image.camera.height = 480;
  frame.image.counts.assign(640 * 480, count);
  return frame;
}

void ExpectSame(const DepthFrame& a, const DepthFrame& b) {
  EXPECT_EQ(a.header.utime, b.header.utime);
  EXPECT_EQ(a.header.frame, b.header.frame);
  EXPECT_EQ(a.header.error, b.header.error);
  EXPECT_EQ(a.image.camera.width, b.image.camera.width);
  EXPECT_EQ(a.image.camera.height, b.image.camera.height);
  EXPECT_EQ(a.image.camera.fx, b.image.camera.fx);
  EXPECT_EQ(a.image.camera.fy, b.image.camera.fy);
  EXPECT_EQ(a.image.camera.cx, b.image.camera.cx);
  EXPECT_EQ(a.image.camera.cy, b.image.camera.cy);
  EXPECT_EQ(a.image.depth_scale_m, b.image.depth_scale_m);
  EXPECT_TRUE(a.image.counts == b.image.counts);
  EXPECT_TRUE(a.X_WC.isApprox(b.X_WC, 1e-12));
  EXPECT_EQ(a.decimation.has_value(), b.decimation.has_value());
}

// An image whose counts no coding makes smaller.
DepthFrame NoisyFrame(int width, int height, uint16_t amplitude, double depth_scale_m = 0.001) {
  DepthFrame frame = TestDepthFrame();
  frame.image.depth_scale_m = depth_scale_m;
  frame.image.camera = {width, height, 912, 910, 641, 361};
  frame.image.counts.resize(static_cast<size_t>(frame.image.camera.num_pixels()));
  std::mt19937 random(3);
  for (uint16_t& count : frame.image.counts) {
    count = static_cast<uint16_t>(7000 + random() % amplitude);
  }
  return frame;
}

// Exactly every k-th column and row of sent.
void ExpectDecimated(const DepthFrame& received, const DepthFrame& sent, int k) {
  const PinholeCamera &kept = received.image.camera, &sensor = sent.image.camera;
  ASSERT_TRUE(received.decimation.has_value());
  EXPECT_EQ(received.decimation->step, k);
  EXPECT_EQ(received.decimation->sensor_width, sensor.width);
  EXPECT_EQ(received.decimation->sensor_height, sensor.height);
  ASSERT_EQ(kept.width, (sensor.width + k - 1) / k);
  ASSERT_EQ(kept.height, (sensor.height + k - 1) / k);
  EXPECT_DOUBLE_EQ(kept.fx, sensor.fx / k);
  EXPECT_DOUBLE_EQ(kept.fy, sensor.fy / k);
  EXPECT_DOUBLE_EQ(kept.cx, sensor.cx / k);
  EXPECT_DOUBLE_EQ(kept.cy, sensor.cy / k);
  int num_wrong = 0;
  for (int v = 0; v < kept.height; ++v) {
    for (int u = 0; u < kept.width; ++u) {
      num_wrong += received.image.CountAt(u, v) != sent.image.CountAt(k * u, k * v);
    }
  }
  EXPECT_EQ(num_wrong, 0);
}

TEST(DepthFrameCodec, RestoresAFrame) {
  ExpectSame(Decode(Encode(TestDepthFrame())), TestDepthFrame());
}

TEST(DepthFrameCodec, RestoresImagesWithoutOrWithExtremeMeasurements) {
  ExpectSame(Decode(Encode(LargeFrame(0))), LargeFrame(0));
  ExpectSame(Decode(Encode(LargeFrame(65535))), LargeFrame(65535));
  DepthFrame pixel = TestDepthFrame();
  pixel.image.camera.width = pixel.image.camera.height = 1;
  pixel.image.counts = {1};
  ExpectSame(Decode(Encode(pixel)), pixel);
}

TEST(DepthFrameCodec, RestoresRandomCounts) {
  std::mt19937 random(2);
  DepthFrame frame = LargeFrame(0);
  for (size_t i = 0; i < 60'000; ++i) frame.image.counts[i] = static_cast<uint16_t>(random());
  ExpectSame(Decode(Encode(frame)), frame);
}

TEST(DepthFrameCodec, RestoresAFrameWithAnError) {
  const DepthFrame frame{ErrorHeader(), {}, TestPose()};
  const depth_frame_t message = Encode(frame);
  EXPECT_EQ(message.num_bytes, 0);
  ExpectSame(Decode(message), frame);
}

TEST(DepthFrameCodec, RefusesToEncodeWhatDoesNotFit) {
  EXPECT_THROW(Encode(NoisyFrame(1600, 1200, 50'000)), MessageTooLarge);
}

TEST(DepthFrameCodec, RoundsFineDepthsBeforeItDropsPixels) {
  DepthFrame frame = NoisyFrame(640, 480, 40, 0.0001);
  frame.image.counts[0] = 0;
  frame.image.counts[1] = 1;
  const DepthFrame received = Decode(Encode(frame));
  EXPECT_FALSE(received.decimation);
  EXPECT_DOUBLE_EQ(received.image.depth_scale_m, 0.0005);
  ASSERT_EQ(received.image.counts.size(), frame.image.counts.size());
  EXPECT_EQ(received.image.counts[0], 0);
  EXPECT_EQ(received.image.counts[1], 1);  // measured, if hardly
  for (int v = 1; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      ASSERT_NEAR(received.image.DepthAt(u, v), frame.image.DepthAt(u, v), 0.00025 + 1e-9);
    }
  }
}

TEST(DepthFrameCodec, KeepsEverySecondRowAndColumnOfAnImageThatDoesNotFit) {
  const DepthFrame frame = NoisyFrame(1280, 720, 30);
  ExpectDecimated(Decode(Encode(frame)), frame, 2);
  const DepthFrame small = NoisyFrame(640, 480, 5000);
  ExpectDecimated(Decode(Encode(small)), small, 2);
}

TEST(DepthFrameCodec, KeepsFewerRowsAndColumnsUntilTheImageFits) {
  const DepthFrame frame = NoisyFrame(1279, 719, 1500);
  const depth_frame_t message = Encode(frame);
  EXPECT_LE(message.getEncodedSize(), kMaxMessageBytes);
  ExpectDecimated(Decode(message), frame, 3);
}

TEST(DepthFrameCodec, SendsADecimatedImageOnAsItIs) {
  const DepthFrame frame = NoisyFrame(1279, 719, 1500);
  ExpectDecimated(Decode(Encode(Decode(Encode(frame)))), frame, 3);
}

TEST(DepthFrameCodec, RestoresTheSensorsCamera) {
  const DepthFrame frame = NoisyFrame(1279, 719, 1500);
  const DepthFrame kept = Decode(Encode(frame));
  const PinholeCamera camera = kept.decimation.value().SensorCamera(kept.image.camera);
  EXPECT_EQ(camera.width, 1279);
  EXPECT_EQ(camera.height, 719);
  EXPECT_DOUBLE_EQ(camera.fx, 912);
  EXPECT_DOUBLE_EQ(camera.fy, 910);
  EXPECT_DOUBLE_EQ(camera.cx, 641);
  EXPECT_DOUBLE_EQ(camera.cy, 361);
}

TEST(DepthFrameCodec, RefusesToEncodeAnImageThatIsNotItsCameras) {
  DepthFrame frame = TestDepthFrame();
  frame.image.counts.pop_back();
  EXPECT_THROW(Encode(frame), std::logic_error);
  EXPECT_THROW(Encode(DepthFrame{ErrorHeader(), TestDepthImage(), TestPose()}), std::logic_error);
  EXPECT_THROW(Encode(DepthFrame{TestHeader(), {}, TestPose()}), std::logic_error);
  EXPECT_THROW(Encode(DepthFrame{TestHeader(), TestDepthImage(), TestPose(), Decimation{2, 9, 12}}),
               std::logic_error);
}

// What Decode says when one thing is changed in a good message.
template <typename Change>
std::string RefusalAfter(const Change& change) {
  depth_frame_t message = Encode(TestDepthFrame());
  change(message);
  return Refusal(message);
}

TEST(DepthFrameCodec, RefusesTimesBeforeZero) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.utime = -5; }), StartsWith("utime = -5: "));
}

TEST(DepthFrameCodec, RefusesSizesThatNoCameraHas) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = -8; }), StartsWith("width = -8: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = 0; }), StartsWith("width = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = 4097; }), StartsWith("width = 4097: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.height = 2'000'000'000; }),
              StartsWith("height = 2000000000: "));
}

TEST(DepthFrameCodec, RefusesAnImageBesideAnError) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.error = "unplugged"; }), StartsWith("width = 8: "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.error = "unplugged";
                m.width = m.height = 0;
              }),
              StartsWith("num_bytes = "));
}

TEST(DepthFrameCodec, RefusesCamerasThatDoNotProject) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.fx = 0; }), StartsWith("fx = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.fy = -525; }), StartsWith("fy = -525: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.fx = kNan; }), StartsWith("fx = nan: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.cx = kNan; }), StartsWith("cx = nan: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.cy = 1 / 0.0; }), StartsWith("cy = inf: "));
}

TEST(DepthFrameCodec, RefusesDecimationsThatDoNotGiveTheImage) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.decimation = 0; }), StartsWith("decimation = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.decimation = 17; }), StartsWith("decimation = 17: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.decimation = 2; }), StartsWith("sensor_width = 8: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.sensor_height = 7; }),
              StartsWith("sensor_height = 7: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.sensor_width = 2'147'483'647; }),
              StartsWith("sensor_width = 2147483647: "));
}

TEST(DepthFrameCodec, RefusesDepthScalesOutsideZeroToOneMetre) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.depth_scale_m = 0; }), StartsWith("depth_scale_m = 0"));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.depth_scale_m = 2; }), StartsWith("depth_scale_m = 2"));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.depth_scale_m = kNan; }),
              StartsWith("depth_scale_m = nan"));
}

TEST(DepthFrameCodec, RefusesPosesThatAreNone) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.q_WC[0] += 0.01; }), StartsWith("q_WC[0] = "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.q_WC[2] = kNan; }), StartsWith("q_WC[2] = nan"));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.p_WC[1] = 1 / 0.0; }), StartsWith("p_WC[1] = inf"));
}

TEST(DepthFrameCodec, NormalisesQuaternionsThatAreNearlyUnit) {
  depth_frame_t message = Encode(TestDepthFrame());
  for (double& q : message.q_WC) q *= 1.0005;
  const Eigen::Matrix3d rotation = Decode(message).X_WC.linear();
  EXPECT_TRUE(rotation.isUnitary(1e-12));
}

TEST(DepthFrameCodec, RefusesDataOfAnotherSize) {
  EXPECT_THAT(RefusalAfter([](auto& m) { ++m.num_bytes; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_bytes = -1; }), StartsWith("num_bytes = -1: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = 9; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.height = 5; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.data.pop_back();
                --m.num_bytes;
              }),
              StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.data.clear();
                m.num_bytes = 0;
              }),
              StartsWith("num_bytes = 0: "));
}

TEST(DepthFrameCodec, RefusesDataThatDecompressesToMoreThanTheImage) {
  // Well coded, a few kilobytes that ask for 20 MB.
  depth_frame_t message = Encode(TestDepthFrame());
  message.data = CompressDepth(std::vector<uint16_t>(10'000'000, 9));
  message.num_bytes = static_cast<int32_t>(message.data.size());
  EXPECT_THAT(Refusal(message), StartsWith("num_bytes = "));
}

}  // namespace
}  // namespace declutter::codec
