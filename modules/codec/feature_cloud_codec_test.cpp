#include <limits>
#include <random>

#include "modules/codec/compression.h"
#include "modules/codec/test_frames.h"

namespace declutter::codec {
namespace {

using ::testing::StartsWith;

double Angle_deg(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::acos(std::min(1.0f, a.dot(b))) * 180 / M_PI;
}

// All that can be in the pixels u % step = v % step = 0 of 640 x 480, at random.
FeatureCloud NoisyFeatures(int step) {
  std::mt19937 random(6);
  std::uniform_real_distribution<float> uniform(-1, 1);
  FeatureCloud features = TestFeatures(FeatureMode::kDefault);
  features.width = 640;
  features.height = 480;
  features.thinning = step;
  features.points.clear();
  for (int v = 0; v < 480; v += step) {
    for (int u = 0; u < 640; u += step) {
      const Eigen::Vector3f n(uniform(random), uniform(random), uniform(random));
      features.points.push_back({v * 640 + u, n.normalized(), 60 * uniform(random), 0.01f, 0, 7});
    }
  }
  return features;
}

TEST(FeatureCloudCodec, RestoresFeaturesOfTheDefaultMode) {
  const FeatureCloud received = Decode(Encode(TestFeatures(FeatureMode::kDefault)));
  EXPECT_EQ(received.header.frame, "kitchen_03");
  EXPECT_EQ(received.mode, FeatureMode::kDefault);
  EXPECT_EQ(received.width, 8);
  EXPECT_EQ(received.height, 6);
  EXPECT_EQ(received.thinning, 1);
  EXPECT_EQ(received.num_components, 300);
  ASSERT_EQ(received.points.size(), 3u);
  EXPECT_EQ(received.points[0].pixel, 3);
  EXPECT_EQ(received.points[0].normal, Eigen::Vector3f(0, 0, -1));
  EXPECT_EQ(received.points[0].kappa, 12.5f);
  EXPECT_FLOAT_EQ(received.points[0].curvature, 0.0105f);
  EXPECT_EQ(received.points[0].r_min, 0);
  EXPECT_EQ(received.points[0].component, 0);
  EXPECT_EQ(received.points[1].pixel, 4);
  EXPECT_EQ(received.points[1].kappa, -3.0f);
  EXPECT_EQ(received.points[1].component, 299);
}

TEST(FeatureCloudCodec, RestoresFeaturesOfThePaperMode) {
  const FeatureCloud received = Decode(Encode(TestFeatures(FeatureMode::kPaper)));
  EXPECT_EQ(received.mode, FeatureMode::kPaper);
  EXPECT_EQ(received.points[0].kappa, 0);
  EXPECT_FLOAT_EQ(received.points[0].curvature, 0.0105f);
  EXPECT_FLOAT_EQ(received.points[0].r_min, 0.042f);
  EXPECT_EQ(received.points[1].r_min, 0);
}

TEST(FeatureCloudCodec, RestoresUnknownNormalsAndPointsOfNoComponent) {
  const FeatureCloud received = Decode(Encode(TestFeatures(FeatureMode::kDefault)));
  EXPECT_EQ(received.points[2].pixel, 47);
  EXPECT_EQ(received.points[2].normal, Eigen::Vector3f(0, 0, 0));
  EXPECT_EQ(received.points[2].component, -1);
}

TEST(FeatureCloudCodec, KeepsFeaturesWithinHalfAStep) {
  FeatureCloud sent = NoisyFeatures(8);
  const FeatureCloud received = Decode(Encode(sent));
  ASSERT_EQ(received.points.size(), sent.points.size());
  for (size_t i = 0; i < sent.points.size(); ++i) {
    ASSERT_EQ(received.points[i].pixel, sent.points[i].pixel);
    ASSERT_LE(Angle_deg(received.points[i].normal, sent.points[i].normal), 1.0);
    ASSERT_NEAR(received.points[i].kappa, sent.points[i].kappa, 0.2501);
  }
}

TEST(FeatureCloudCodec, SaturatesFeaturesBeyondTheirRange) {
  FeatureCloud sent = TestFeatures(FeatureMode::kDefault);
  sent.points[0].kappa = 1000;
  sent.points[1].kappa = -1e30f;
  sent.points[0].curvature = 0.33f;
  const FeatureCloud received = Decode(Encode(sent));
  EXPECT_EQ(received.points[0].kappa, 63.5f);
  EXPECT_EQ(received.points[1].kappa, -63.5f);
  EXPECT_FLOAT_EQ(received.points[0].curvature, 0.1275f);
}

TEST(FeatureCloudCodec, KeepsTheSmallestRadiusApartFromNone) {
  FeatureCloud sent = TestFeatures(FeatureMode::kPaper);
  sent.points[0].r_min = 1e-5f;
  sent.points[1].r_min = 3;
  const FeatureCloud received = Decode(Encode(sent));
  EXPECT_FLOAT_EQ(received.points[0].r_min, 0.001f);
  EXPECT_FLOAT_EQ(received.points[1].r_min, 0.255f);
}

TEST(FeatureCloudCodec, RestoresACloudWithoutPoints) {
  FeatureCloud sent = TestFeatures(FeatureMode::kDefault);
  sent.points.clear();
  sent.num_components = 0;
  EXPECT_TRUE(Decode(Encode(sent)).points.empty());
}

TEST(FeatureCloudCodec, RestoresAFrameWithAnError) {
  FeatureCloud sent;
  sent.header = ErrorHeader();
  const feature_cloud_t message = Encode(sent);
  EXPECT_EQ(message.num_bytes, 0);
  EXPECT_EQ(Decode(message).header.error, "no depth.png");
}

TEST(FeatureCloudCodec, ThinsJustUntilTheMessageFits) {
  const feature_cloud_t message = Encode(NoisyFeatures(1));
  EXPECT_LE(message.getEncodedSize(), kMaxMessageBytes);
  // Three random bytes a pixel: 922 KB, and 230 KB at every other pixel of every other row.
  EXPECT_EQ(message.thinning, 3);
  const FeatureCloud received = Decode(message);
  EXPECT_EQ(received.points.size(), 214u * 160u);
  for (const FeaturePoint& point : received.points) {
    ASSERT_EQ(point.pixel % 640 % 3, 0);
    ASSERT_EQ(point.pixel / 640 % 3, 0);
  }
}

TEST(FeatureCloudCodec, ThinsWhatIsThinnedByMultiples) {
  const feature_cloud_t message = Encode(NoisyFeatures(2));
  EXPECT_EQ(message.thinning, 4);
  EXPECT_EQ(message.num_points, 160 * 120);
}

TEST(FeatureCloudCodec, RefusesToEncodeWhatNoDecoderWouldTake) {
  const FeatureCloud good = TestFeatures(FeatureMode::kDefault);
  FeatureCloud bad = good;
  std::swap(bad.points[0], bad.points[1]);
  EXPECT_THROW(Encode(bad), std::logic_error);
  bad = good;
  bad.points[2].pixel = 48;
  EXPECT_THROW(Encode(bad), std::logic_error);
  bad = good;
  bad.points[1].component = 300;
  EXPECT_THROW(Encode(bad), std::logic_error);
  bad = good;
  bad.num_components = 65536;
  EXPECT_THROW(Encode(bad), std::logic_error);
  bad = good;
  bad.points[0].kappa = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Encode(bad), std::logic_error);
  bad = good;
  bad.points[0].normal.x() = std::numeric_limits<float>::infinity();
  EXPECT_THROW(Encode(bad), std::logic_error);
}

template <typename Change>
std::string RefusalAfter(const Change& change) {
  feature_cloud_t message = Encode(TestFeatures(FeatureMode::kDefault));
  change(message);
  return Refusal(message);
}

// What Decode says when byte i of the decompressed data (6 bytes of mask, then 6 planes of 3) is
// changed.
std::string RefusalOfByte(size_t i, uint8_t value) {
  return RefusalAfter([&](feature_cloud_t& message) {
    std::vector<uint8_t> bytes(6 + 6 * 3);
    ASSERT_EQ(Decompress(message.data, bytes.data(), bytes.size()), bytes.size());
    bytes[i] = value;
    message.data = Compress(bytes.data(), bytes.size());
    message.num_bytes = static_cast<int32_t>(message.data.size());
  });
}

TEST(FeatureCloudCodec, RefusesModesThatThereAreNot) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.mode = 2; }), StartsWith("mode = 2: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.mode = -1; }), StartsWith("mode = -1: "));
}

TEST(FeatureCloudCodec, RefusesCountsThatDisagreeWithTheData) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_points = 4; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_points = -1; }), StartsWith("num_points = -1: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_points = 49; }), StartsWith("num_points = 49: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.width = 4000; }), StartsWith("num_bytes = "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_bytes = 1; }), StartsWith("num_bytes = 1: "));
}

TEST(FeatureCloudCodec, RefusesMasksOfAnotherNumberOfPoints) {
  EXPECT_THAT(RefusalOfByte(0, 0xFF), StartsWith("num_points = 3: "));
}

TEST(FeatureCloudCodec, RefusesMasksThatContradictTheThinning) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.thinning = 2; }), StartsWith("data mask[3] = 1: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.thinning = 0; }), StartsWith("thinning = 0: "));
}

TEST(FeatureCloudCodec, RefusesMasksThatGoOnBeyondTheImage) {
  // 9 x 5 = 45 pixels have six bytes too, but the last point is pixel 47.
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.width = 9;
                m.height = 5;
              }),
              StartsWith("data mask[47] = 1: "));
}

TEST(FeatureCloudCodec, RefusesNormalsThatNoCodeStandsFor) {
  EXPECT_THAT(RefusalOfByte(6, 0x80), StartsWith("data normal[0] = "));
}

TEST(FeatureCloudCodec, RefusesComponentsBeyondTheirNumber) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_components = 299; }),
              StartsWith("data component[1] = 299: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_components = -1; }),
              StartsWith("num_components = -1: "));
}

TEST(FeatureCloudCodec, RefusesStepsThatQuantiseNothing) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.kappa_step = 0; }), StartsWith("kappa_step = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.curvature_step = 1e300; }),
              StartsWith("curvature_step = 1e+300: "));
  EXPECT_THAT(
      RefusalAfter([](auto& m) { m.r_min_step_m = std::numeric_limits<double>::quiet_NaN(); }),
      StartsWith("r_min_step_m = nan: "));
}

}  // namespace
}  // namespace declutter::codec
