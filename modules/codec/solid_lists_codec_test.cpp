#include <limits>

#include "modules/codec/test_frames.h"

namespace declutter::codec {
namespace {

using ::testing::StartsWith;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

void ExpectSame(const Solid& a, const Solid& b) {
  EXPECT_EQ(a.shape, b.shape);
  EXPECT_TRUE(a.X_CO.isApprox(b.X_CO, 1e-12));
  EXPECT_EQ(a.size, b.size);
}

void ExpectSame(const std::vector<Plane>& a, const std::vector<Plane>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(a[i].normal.isApprox(b[i].normal, 1e-12));
    EXPECT_EQ(a[i].d, b[i].d);
  }
}

TEST(HypothesisListCodec, RestoresHypotheses) {
  const HypothesisList sent = TestHypotheses();
  const HypothesisList received = Decode(Encode(sent));
  EXPECT_EQ(received.header.utime, sent.header.utime);
  EXPECT_EQ(received.header.frame, sent.header.frame);
  EXPECT_EQ(received.mode, sent.mode);
  ExpectSame(received.planes, sent.planes);
  ASSERT_EQ(received.hypotheses.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const Hypothesis& a = received.hypotheses[i];
    const Hypothesis& b = sent.hypotheses[i];
    ExpectSame(a.solid, b.solid);
    EXPECT_EQ(a.evidence, b.evidence);
    EXPECT_EQ(a.component, b.component);
    EXPECT_EQ(a.num_votes, b.num_votes);
    EXPECT_EQ(a.num_inliers, b.num_inliers);
    EXPECT_EQ(a.score, b.score);
  }
}

TEST(HypothesisListCodec, RestoresAListWithAnError) {
  const HypothesisList received = Decode(Encode(HypothesisList{ErrorHeader(), {}, {}, {}}));
  EXPECT_EQ(received.header.error, "no depth.png");
  EXPECT_TRUE(received.hypotheses.empty());
}

TEST(HypothesisListCodec, RefusesToEncodeMoreThanFits) {
  HypothesisList list = TestHypotheses();
  list.hypotheses.resize(3000, list.hypotheses[0]);
  EXPECT_THROW(Encode(list), MessageTooLarge);
}

template <typename Change>
std::string HypothesisRefusalAfter(const Change& change) {
  hypothesis_list_t message = Encode(TestHypotheses());
  change(message);
  return Refusal(message);
}

TEST(HypothesisListCodec, RefusesShapesEvidenceAndModesThatThereAreNot) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.shape[1] = 2; }), StartsWith("shape[1] = 2"));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.evidence_y[0] = 3; }),
              StartsWith("evidence_y[0] = 3"));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.mode = 7; }), StartsWith("mode = 7"));
}

TEST(HypothesisListCodec, RefusesPosesThatAreNone) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.qw[1] = 3; }), StartsWith("qw[1] = 3: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.qz[0] = kNan; }), StartsWith("qz[0] = nan"));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.py[1] = kNan; }), StartsWith("py[1] = nan"));
}

TEST(HypothesisListCodec, RefusesSizesThatNoSolidHas) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.size_x[0] = 0; }),
              StartsWith("size_x[0] = 0: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.size_z[1] = -0.1; }),
              StartsWith("size_z[1] = -0.1: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.size_y[0] = 1 / 0.0; }),
              StartsWith("size_y[0] = inf"));
}

TEST(HypothesisListCodec, RefusesCylindersOfTwoDiameters) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.size_y[1] = 0.09; }),
              StartsWith("size_y[1] = 0.09: "));
}

TEST(HypothesisListCodec, RefusesCountsAndScoresOutOfRange) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.component[0] = -1; }),
              StartsWith("component[0] = -1: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.num_votes[1] = -2; }),
              StartsWith("num_votes[1] = -2: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.num_inliers[1] = -2; }),
              StartsWith("num_inliers[1] = -2: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.score[0] = 1.5f; }),
              StartsWith("score[0] = 1.5: "));
}

TEST(HypothesisListCodec, RefusesArraysOfOtherLengthsThanTheirCounts) {
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.num_hypotheses = 3; }),
              StartsWith("num_hypotheses = 3: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.score.clear(); }),
              StartsWith("num_hypotheses = 2: "));
  EXPECT_THAT(HypothesisRefusalAfter([](auto& m) { m.d.push_back(1); }),
              StartsWith("num_planes = 2: "));
}

TEST(HypothesisListCodec, RefusesSolidsBesideAnError) {
  HypothesisList list = TestHypotheses();
  list.planes.clear();
  hypothesis_list_t message = Encode(list);
  message.error = "unplugged";
  EXPECT_THAT(Refusal(message), StartsWith("num_hypotheses = 2: "));
}

TEST(ObjectListCodec, RestoresObjects) {
  const ObjectList sent = TestObjects();
  const ObjectList received = Decode(Encode(sent));
  EXPECT_EQ(received.header.utime, sent.header.utime);
  EXPECT_EQ(received.mode, sent.mode);
  EXPECT_EQ(received.camera.width, sent.camera.width);
  EXPECT_EQ(received.camera.fy, sent.camera.fy);
  EXPECT_TRUE(received.X_WC.isApprox(sent.X_WC, 1e-12));
  ExpectSame(received.planes, sent.planes);
  EXPECT_EQ(received.labels, sent.labels);
  ASSERT_EQ(received.objects.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    const ObjectModel& a = received.objects[i];
    const ObjectModel& b = sent.objects[i];
    EXPECT_EQ(a.id, b.id);
    ExpectSame(a.solid, b.solid);
    EXPECT_EQ(a.evidence, b.evidence);
    EXPECT_EQ(a.confidence, b.confidence);
    EXPECT_EQ(a.supported_by, b.supported_by);
    EXPECT_EQ(a.num_votes, b.num_votes);
    EXPECT_EQ(a.num_explained, b.num_explained);
    EXPECT_EQ(a.num_occluded, b.num_occluded);
    EXPECT_EQ(a.num_violating, b.num_violating);
    EXPECT_TRUE(a.covariance.isApprox(b.covariance, 1e-6));
  }
}

TEST(ObjectListCodec, CodesLabelsAsRuns) {
  const object_list_t message = Encode(TestObjects());
  EXPECT_THAT(message.run_length, ::testing::ElementsAre(10, 10, 10, 18));
  EXPECT_THAT(message.run_label, ::testing::ElementsAre(0, 1, 2, 0));
}

TEST(ObjectListCodec, RestoresAListWithAnError) {
  ObjectList sent;
  sent.header = ErrorHeader();
  const ObjectList received = Decode(Encode(sent));
  EXPECT_EQ(received.header.error, "no depth.png");
  EXPECT_TRUE(received.labels.empty());
}

TEST(ObjectListCodec, RefusesToEncodeIdsThatDoNotCountOrThatLabelsCannotHold) {
  ObjectList list = TestObjects();
  list.objects[0].id = 256;
  EXPECT_THROW(Encode(list), std::logic_error);
  list.objects[0].id = 0;
  EXPECT_THROW(Encode(list), std::logic_error);
  list.objects[0].id = list.objects[1].id;
  EXPECT_THROW(Encode(list), std::logic_error);
  list = TestObjects();
  list.objects.resize(256, list.objects[0]);
  EXPECT_THROW(Encode(list), std::logic_error);
}

TEST(ObjectListCodec, RefusesToEncodeLabelsOfNoObject) {
  ObjectList list = TestObjects();
  list.labels[5] = 3;
  EXPECT_THROW(Encode(list), std::logic_error);
  list = TestObjects();
  list.labels.pop_back();
  EXPECT_THROW(Encode(list), std::logic_error);
}

template <typename Change>
std::string ObjectRefusalAfter(const Change& change) {
  object_list_t message = Encode(TestObjects());
  change(message);
  return Refusal(message);
}

TEST(ObjectListCodec, RefusesIdsThatDoNotCount) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.id[0] = 3; }), StartsWith("id[0] = 3: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.id[1] = 0; }), StartsWith("id[1] = 0: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.id[1] = 2; }), StartsWith("id[0] = 2: "));
}

TEST(ObjectListCodec, RefusesRunsThatDoNotFillTheImage) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.run_length[3] = 17; }),
              StartsWith("num_runs = 4: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.run_length[3] = 2'000'000'000; }),
              StartsWith("run_length[3] = 2000000000: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.run_length[2] = -10; }),
              StartsWith("run_length[2] = -10: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.run_label.pop_back(); }),
              StartsWith("num_runs = 4: "));
}

TEST(ObjectListCodec, RefusesLabelsOfNoObject) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.run_label[2] = 3; }),
              StartsWith("run_label[2] = 3: "));
}

TEST(ObjectListCodec, RefusesObjectsThatStandOnNoneOrThemselves) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.supported_by[0] = 3; }),
              StartsWith("supported_by[0] = 3: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.supported_by[0] = 2; }),
              StartsWith("supported_by[0] = 2: "));
}

TEST(ObjectListCodec, RefusesNumbersOutOfRange) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.confidence[1] = -0.5f; }),
              StartsWith("confidence[1] = -0.5: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_explained[0] = -1; }),
              StartsWith("num_explained[0] = -1: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_occluded[0] = -1; }),
              StartsWith("num_occluded[0] = -1: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_violating[0] = -1; }),
              StartsWith("num_violating[0] = -1: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.covariance[0] = -1; }),
              StartsWith("covariance[0] = -1: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_covariances = 1; }),
              StartsWith("num_covariances = 1: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.size_x[0] = kNan; }),
              StartsWith("size_x[0] = nan"));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.fx = -1; }), StartsWith("fx = -1: "));
}

TEST(ObjectListCodec, RefusesMoreObjectsThanLabels) {
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_objects = 256; }),
              StartsWith("num_objects = 256: "));
  EXPECT_THAT(ObjectRefusalAfter([](auto& m) { m.num_objects = -3; }),
              StartsWith("num_objects = -3: "));
}

}  // namespace
}  // namespace declutter::codec
