#include <random>

#include "modules/codec/test_frames.h"

namespace declutter::codec {
namespace {

using ::testing::StartsWith;

ColorImage Noise(int width, int height) {
  std::mt19937 random(7);
  ColorImage image{width, height, std::vector<uint8_t>(static_cast<size_t>(3 * width * height))};
  for (uint8_t& value : image.rgb) value = static_cast<uint8_t>(random());
  return image;
}

template <typename Change>
std::string RefusalAfter(const Change& change) {
  color_frame_t message = Encode(TestHeader(), TestColorImage());
  change(message);
  return Refusal(message);
}

TEST(ColorFrameCodec, RestoresAnImageNearly) {
  const ColorImage sent = TestColorImage();
  const color_frame_t message = Encode(TestHeader(), sent);
  EXPECT_EQ(message.utime, TestHeader().utime);
  EXPECT_EQ(message.frame, "kitchen_03");
  const ColorImage received = Decode(message);
  EXPECT_EQ(received.width, 16);
  EXPECT_EQ(received.height, 12);
  ASSERT_EQ(received.rgb.size(), sent.rgb.size());
  for (size_t i = 0; i < sent.rgb.size(); ++i) {
    EXPECT_NEAR(received.rgb[i], sent.rgb[i], 16) << "byte " << i;
  }
}

TEST(ColorFrameCodec, LowersTheQualityUntilTheMessageFits) {
  const color_frame_t message = Encode(TestHeader(), Noise(640, 480));
  EXPECT_LE(message.getEncodedSize(), kMaxMessageBytes);
  EXPECT_EQ(Decode(message).rgb.size(), 3u * 640u * 480u);
}

TEST(ColorFrameCodec, RefusesToEncodeWhatDoesNotFit) {
  EXPECT_THROW(Encode(TestHeader(), Noise(4096, 2048)), MessageTooLarge);
}

TEST(ColorFrameCodec, RefusesToEncodeAnImageOfAnotherSize) {
  ColorImage image = TestColorImage();
  image.rgb.pop_back();
  EXPECT_THROW(Encode(TestHeader(), image), std::logic_error);
  EXPECT_THROW(Encode(TestHeader(), ColorImage{}), std::logic_error);
}

TEST(ColorFrameCodec, RefusesSizesOtherThanTheFiles) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = 17; }), StartsWith("width = 17: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.height = 11; }), StartsWith("height = 11: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = -16; }), StartsWith("width = -16: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.height = 5000; }), StartsWith("height = 5000: "));
}

TEST(ColorFrameCodec, RefusesFilesThatAreNotWhole) {
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.jpeg.resize(m.jpeg.size() - 20);
                m.num_bytes -= 20;
              }),
              StartsWith("num_bytes = "));
}

TEST(ColorFrameCodec, RefusesFilesThatAreNoJpeg) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.jpeg[0] = 0; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.jpeg.clear();
                m.num_bytes = 0;
              }),
              StartsWith("num_bytes = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { ++m.num_bytes; }), StartsWith("num_bytes = "));
}

}  // namespace
}  // namespace declutter::codec
