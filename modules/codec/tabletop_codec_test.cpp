#include <limits>
#include <random>

#include "modules/codec/depth_compression.h"
#include "modules/codec/test_frames.h"

namespace declutter::codec {
namespace {

using ::testing::StartsWith;

// Random counts at the pixels u % step = v % step = 0 of 640 x 480: they do not compress.
Tabletop NoisyTabletop(int step) {
  std::mt19937 random(5);
  Tabletop tabletop = TestTabletop();
  tabletop.thinning = step;
  tabletop.objects.camera.width = 640;
  tabletop.objects.camera.height = 480;
  tabletop.objects.counts.assign(640 * 480, 0);
  for (int v = 0; v < 480; v += step) {
    for (int u = 0; u < 640; u += step) {
      const auto pixel = static_cast<size_t>(v * 640 + u);
      tabletop.objects.counts[pixel] = static_cast<uint16_t>(1 + random() % 65535);
    }
  }
  tabletop.num_object_points = 640 * 480;
  return tabletop;
}

// The counts of image that thinning by step keeps.
std::vector<uint16_t> Kept(const DepthImage& image, int step) {
  std::vector<uint16_t> counts = image.counts;
  for (size_t pixel = 0; pixel < counts.size(); ++pixel) {
    const int u = static_cast<int>(pixel) % image.camera.width;
    const int v = static_cast<int>(pixel) / image.camera.width;
    if (u % step != 0 || v % step != 0) counts[pixel] = 0;
  }
  return counts;
}

TEST(TabletopCodec, RestoresATabletop) {
  const Tabletop sent = TestTabletop();
  const Tabletop received = Decode(Encode(sent));
  EXPECT_EQ(received.header.utime, sent.header.utime);
  EXPECT_EQ(received.header.frame, sent.header.frame);
  EXPECT_EQ(received.thinning, 1);
  EXPECT_EQ(received.num_object_points, 38);
  EXPECT_EQ(received.objects.counts, sent.objects.counts);
  EXPECT_EQ(received.objects.depth_scale_m, sent.objects.depth_scale_m);
  EXPECT_EQ(received.objects.camera.cx, sent.objects.camera.cx);
  ASSERT_EQ(received.planes.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(received.planes[i].plane.normal.isApprox(sent.planes[i].plane.normal, 1e-12));
    EXPECT_EQ(received.planes[i].plane.d, sent.planes[i].plane.d);
    EXPECT_EQ(received.planes[i].hull, sent.planes[i].hull);
  }
}

TEST(TabletopCodec, RestoresATableWithoutPlanesAndPoints) {
  Tabletop sent = TestTabletop();
  sent.planes.clear();
  sent.objects.counts.assign(48, 0);
  const Tabletop received = Decode(Encode(sent));
  EXPECT_TRUE(received.planes.empty());
  EXPECT_EQ(received.num_object_points, 0);
  EXPECT_EQ(received.objects.counts, sent.objects.counts);
}

TEST(TabletopCodec, RestoresAFrameWithAnError) {
  Tabletop sent;
  sent.header = ErrorHeader();
  const Tabletop received = Decode(Encode(sent));
  EXPECT_EQ(received.header.error, "no depth.png");
  EXPECT_TRUE(received.objects.empty());
}

TEST(TabletopCodec, ThinsJustUntilTheMessageFits) {
  const Tabletop sent = NoisyTabletop(1);
  const tabletop_t message = Encode(sent);
  EXPECT_LE(message.getEncodedSize(), kMaxMessageBytes);
  EXPECT_EQ(message.thinning, 3);
  const size_t max_bytes = kMaxMessageBytes;
  EXPECT_GT(CompressDepth(sent.objects.counts).size(), max_bytes);
  EXPECT_GT(CompressDepth(Kept(sent.objects, 2)).size(), max_bytes);
  const Tabletop received = Decode(message);
  EXPECT_TRUE(received.objects.counts == Kept(sent.objects, 3));
  EXPECT_EQ(received.num_object_points, 640 * 480);
}

TEST(TabletopCodec, ThinsWhatIsThinnedByMultiples) {
  const Tabletop sent = NoisyTabletop(2);
  const Tabletop received = Decode(Encode(sent));
  EXPECT_EQ(received.thinning, 4);
  EXPECT_TRUE(received.objects.counts == Kept(sent.objects, 4));
  EXPECT_EQ(received.num_object_points, 640 * 480);
}

TEST(TabletopCodec, KeepsTheThinningOfWhatFits) {
  const Tabletop received = Decode(Encode(NoisyTabletop(8)));
  EXPECT_EQ(received.thinning, 8);
  EXPECT_EQ(received.num_object_points, 640 * 480);
}

TEST(TabletopCodec, RefusesToEncodeHullsThatDoNotFit) {
  Tabletop sent = TestTabletop();
  sent.planes[0].hull.assign(20'000, {0, 0, 1});
  EXPECT_THROW(Encode(sent), MessageTooLarge);
}

template <typename Change>
std::string RefusalAfter(const Change& change) {
  tabletop_t message = Encode(TestTabletop());
  change(message);
  return Refusal(message);
}

TEST(TabletopCodec, RefusesPlanesWithoutUnitNormalOrHeight) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.normal_y[1] = -0.7; }), StartsWith("normal_x[1] = "));
  EXPECT_THAT(
      RefusalAfter([](auto& m) { m.normal_z[0] = std::numeric_limits<double>::quiet_NaN(); }),
      StartsWith("normal_z[0] = nan"));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.d[0] = -0.5; }), StartsWith("d[0] = -0.5: "));
}

TEST(TabletopCodec, RefusesArraysOfOtherLengthsThanTheirCounts) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_planes = 3; }), StartsWith("num_planes = 3: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_planes = -1; }), StartsWith("num_planes = -1: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.hull_y.pop_back(); }),
              StartsWith("num_hull_points = 7: "));
}

TEST(TabletopCodec, RefusesHullSizesThatDoNotSumUp) {
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.hull_size = {3, 3};
              }),
              StartsWith("num_hull_points = 7: "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.hull_size = {3, 5};
              }),
              StartsWith("hull_size[1] = 5: "));
  EXPECT_THAT(RefusalAfter([](auto& m) {
                m.hull_size = {-1, 8};
              }),
              StartsWith("hull_size[0] = -1: "));
}

TEST(TabletopCodec, RefusesHullPointsThatAreNotFinite) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.hull_z[5] = std::numeric_limits<float>::infinity(); }),
              StartsWith("hull_z[5] = inf"));
}

TEST(TabletopCodec, RefusesThinningThatThePixelsContradict) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.thinning = 0; }), StartsWith("thinning = 0: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.thinning = 2; }), StartsWith("thinning = 2: "));
}

TEST(TabletopCodec, RefusesFewerObjectPointsThanThereAre) {
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_object_points = 37; }),
              StartsWith("num_object_points = 37: "));
  EXPECT_THAT(RefusalAfter([](auto& m) { m.num_object_points = 39; }),
              StartsWith("num_object_points = 39: "));
}

TEST(TabletopCodec, RefusesPlanesBesideAnError) {
  Tabletop sent;
  sent.header = ErrorHeader();
  tabletop_t message = Encode(sent);
  message.num_planes = 1;
  message.normal_x = {0};
  message.normal_y = {-1};
  message.normal_z = {0};
  message.d = {1};
  message.hull_size = {0};
  EXPECT_THAT(Refusal(message), StartsWith("num_planes = 1: "));
}

}  // namespace
}  // namespace declutter::codec
