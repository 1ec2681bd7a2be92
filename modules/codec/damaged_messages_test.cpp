#include <cstring>
#include <random>

#include "modules/codec/compression.h"
#include "modules/codec/test_frames.h"

// Decoders of messages in which bytes were changed: they refuse, or return what can be sent again.
namespace declutter::codec {
namespace {

struct Bytes {
  void* data;
  size_t size;
};

template <typename Number>
Bytes BytesOf(Number& number) {
  return {&number, sizeof number};
}

template <typename Number>
Bytes BytesOf(std::vector<Number>& array) {
  return {array.data(), array.size() * sizeof(Number)};
}

template <typename Message>
std::vector<Bytes> SolidBytes(Message& m) {
  return {BytesOf(m.utime),      BytesOf(m.mode),     BytesOf(m.num_planes), BytesOf(m.normal_x),
          BytesOf(m.normal_y),   BytesOf(m.normal_z), BytesOf(m.d),          BytesOf(m.shape),
          BytesOf(m.qw),         BytesOf(m.qx),       BytesOf(m.qy),         BytesOf(m.qz),
          BytesOf(m.px),         BytesOf(m.py),       BytesOf(m.pz),         BytesOf(m.size_x),
          BytesOf(m.size_y),     BytesOf(m.size_z),   BytesOf(m.evidence_x), BytesOf(m.evidence_y),
          BytesOf(m.evidence_z), BytesOf(m.num_votes)};
}

std::vector<Bytes> NumbersOf(hypothesis_list_t& m) {
  std::vector<Bytes> bytes = SolidBytes(m);
  for (const Bytes& more : {BytesOf(m.num_hypotheses), BytesOf(m.component), BytesOf(m.num_inliers),
                            BytesOf(m.score)}) {
    bytes.push_back(more);
  }
  return bytes;
}

std::vector<Bytes> NumbersOf(object_list_t& m) {
  std::vector<Bytes> bytes = SolidBytes(m);
  for (const Bytes& more :
       {BytesOf(m.width), BytesOf(m.height), BytesOf(m.fx), BytesOf(m.cy), BytesOf(m.q_WC),
        BytesOf(m.p_WC), BytesOf(m.num_objects), BytesOf(m.num_runs), BytesOf(m.id),
        BytesOf(m.confidence), BytesOf(m.supported_by), BytesOf(m.num_explained),
        BytesOf(m.run_length), BytesOf(m.run_label)}) {
    bytes.push_back(more);
  }
  return bytes;
}

std::vector<Bytes> NumbersOf(depth_frame_t& m) {
  return {BytesOf(m.utime), BytesOf(m.width),     BytesOf(m.height),     BytesOf(m.fx),
          BytesOf(m.cx),    BytesOf(m.q_WC),      BytesOf(m.p_WC),       BytesOf(m.depth_scale_m),
          BytesOf(m.data),  BytesOf(m.num_bytes), BytesOf(m.decimation), BytesOf(m.sensor_width)};
}

std::vector<Bytes> NumbersOf(tabletop_t& m) {
  return {BytesOf(m.width),
          BytesOf(m.height),
          BytesOf(m.fy),
          BytesOf(m.num_planes),
          BytesOf(m.num_hull_points),
          BytesOf(m.thinning),
          BytesOf(m.normal_x),
          BytesOf(m.num_object_points),
          BytesOf(m.d),
          BytesOf(m.hull_size),
          BytesOf(m.hull_x),
          BytesOf(m.data)};
}

std::vector<Bytes> NumbersOf(feature_cloud_t& m) {
  return {BytesOf(m.mode),       BytesOf(m.width),          BytesOf(m.height),
          BytesOf(m.thinning),   BytesOf(m.num_points),     BytesOf(m.num_components),
          BytesOf(m.kappa_step), BytesOf(m.curvature_step), BytesOf(m.data)};
}

std::vector<Bytes> NumbersOf(color_frame_t& m) {
  return {BytesOf(m.width), BytesOf(m.height), BytesOf(m.num_bytes), BytesOf(m.jpeg)};
}

// One to four bits flipped anywhere in the numbers and arrays.
template <typename Message>
void FlipBits(Message& message, std::mt19937& random) {
  const std::vector<Bytes> numbers = NumbersOf(message);
  for (size_t num_flips = 1 + random() % 4; num_flips > 0; --num_flips) {
    const Bytes& bytes = numbers[random() % numbers.size()];
    if (bytes.size == 0) continue;
    auto* byte = static_cast<uint8_t*>(bytes.data) + random() % bytes.size;
    *byte = static_cast<uint8_t>(*byte ^ (1u << (random() % 8)));
  }
}

template <typename Core>
void EncodeAgain(const Core& decoded) {
  Encode(decoded);
}
void EncodeAgain(const ColorImage& decoded) { Encode(TestHeader(), decoded); }

// The number of damaged messages that were refused; the others could be encoded again.
template <typename Message>
int NumRefused(const Message& good, int num_messages) {
  std::mt19937 random(8);
  int num_refused = 0;
  for (int i = 0; i < num_messages; ++i) {
    Message message = good;
    FlipBits(message, random);
    try {
      EncodeAgain(Decode(message));
    } catch (const BadMessage&) {
      ++num_refused;
    }
  }
  return num_refused;
}

TEST(DamagedMessages, OfDepthFramesAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestDepthFrame()), 5000), 2500);
}

TEST(DamagedMessages, OfTabletopsAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestTabletop()), 5000), 2500);
}

TEST(DamagedMessages, OfFeaturesAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestFeatures(FeatureMode::kDefault)), 5000), 2500);
  EXPECT_GT(NumRefused(Encode(TestFeatures(FeatureMode::kPaper)), 5000), 2500);
}

TEST(DamagedMessages, OfHypothesesAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestHypotheses()), 5000), 2000);
}

TEST(DamagedMessages, OfObjectsAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestObjects()), 5000), 2000);
}

TEST(DamagedMessages, OfColoursAreRefusedOrMeanSomething) {
  EXPECT_GT(NumRefused(Encode(TestHeader(), TestColorImage()), 5000), 2500);
}

// The compressor refuses most damage before the codes behind it are read.
TEST(DamagedMessages, OfDepthBehindTheCompressorAreRefusedOrMeanSomething) {
  const depth_frame_t good = Encode(TestDepthFrame());
  std::vector<uint8_t> rvl(1000);
  rvl.resize(Decompress(good.data, rvl.data(), rvl.size()).value());
  std::mt19937 random(9);
  int num_refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    std::vector<uint8_t> damaged = rvl;
    damaged[random() % damaged.size()] = static_cast<uint8_t>(random());
    if (random() % 4 == 0) damaged.resize(random() % 2 == 0 ? random() % damaged.size() : 1000);
    depth_frame_t message = good;
    message.data = Compress(damaged.data(), damaged.size());
    message.num_bytes = static_cast<int32_t>(message.data.size());
    try {
      EXPECT_EQ(Decode(message).image.counts.size(), 48u);
    } catch (const BadMessage&) {
      ++num_refused;
    }
  }
  EXPECT_GT(num_refused, 5'000);
  EXPECT_LT(num_refused, 20'000);
}

}  // namespace
}  // namespace declutter::codec
