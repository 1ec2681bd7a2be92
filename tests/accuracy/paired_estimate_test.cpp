#include "tests/accuracy/paired_estimate.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace declutter::accuracy {
namespace {

TEST(WilsonInterval, GivesTheTextbookValues) {
  const Estimate half = WilsonInterval(5, 10);
  EXPECT_DOUBLE_EQ(half.value, 0.5);
  EXPECT_NEAR(half.low, 0.2366, 1e-4);
  EXPECT_NEAR(half.high, 0.7634, 1e-4);
  const Estimate all = WilsonInterval(10, 10);
  EXPECT_NEAR(all.low, 0.7225, 1e-4);
  EXPECT_NEAR(all.high, 1, 1e-12);
}

TEST(WilsonInterval, RefusesWhatIsNoShare) {
  EXPECT_THROW(WilsonInterval(0, 0), std::logic_error);
  EXPECT_THROW(WilsonInterval(3, 2), std::logic_error);
}

// 40 frames of 10 objects: of every second frame the candidate finds one more.
std::vector<FrameShare> Found(int num_more) {
  std::vector<FrameShare> frames;
  for (int i = 0; i < 40; ++i) frames.push_back({5.0 + i % 5 + i % 2 * num_more, 10, {}});
  return frames;
}

TEST(EstimatePair, IsSureOfWhatEveryFrameShares) {
  std::vector<FrameShare> candidate = Found(0);
  for (FrameShare& frame : candidate) ++frame.part;
  const PairedEstimate pair = EstimatePair(QuantityKind::kShare, Found(0), candidate);
  EXPECT_NEAR(pair.difference->value, 0.1, 1e-12);
  EXPECT_NEAR(pair.difference->low, 0.1, 1e-12);
  EXPECT_NEAR(pair.difference->high, 0.1, 1e-12);
  EXPECT_LT(pair.baseline->low, 0.7);
  EXPECT_GT(pair.baseline->high, 0.7);
}

// One more in half of the frames: 20 +- 1.96 sqrt(40 / 4), of 400 objects.
TEST(EstimatePair, HasTheSpreadOfTheDifferencesOfFrames) {
  const PairedEstimate pair = EstimatePair(QuantityKind::kShare, Found(0), Found(1));
  EXPECT_NEAR(pair.difference->value, 0.05, 1e-12);
  EXPECT_NEAR(pair.difference->low, 0.0345, 0.003);
  EXPECT_NEAR(pair.difference->high, 0.0655, 0.003);
  const PairedEstimate count = EstimatePair(QuantityKind::kCount, Found(0), Found(1));
  EXPECT_DOUBLE_EQ(count.difference->value, 20);
  EXPECT_NEAR(count.difference->low, 13.8, 1.3);
  EXPECT_NEAR(count.difference->high, 26.2, 1.3);
}

TEST(EstimatePair, TakesMediansOfAbsoluteErrors) {
  const std::vector<FrameShare> baseline{{0, 0, {-3, 1}}, {0, 0, {2}}, {0, 0, {}}};
  const std::vector<FrameShare> candidate{{0, 0, {-5, 5}}, {0, 0, {5}}, {0, 0, {5}}};
  const PairedEstimate pair = EstimatePair(QuantityKind::kMedianAbsoluteError, baseline, candidate);
  EXPECT_DOUBLE_EQ(pair.baseline->value, 2);
  EXPECT_DOUBLE_EQ(pair.candidate->value, 5);
  EXPECT_DOUBLE_EQ(pair.candidate->high, 5);
  EXPECT_DOUBLE_EQ(pair.difference->value, 3);
}

TEST(EstimatePair, IsEmptyWhereThereIsNothingToMeasure) {
  const std::vector<FrameShare> frames(40);
  const PairedEstimate share = EstimatePair(QuantityKind::kShare, frames, Found(0));
  EXPECT_FALSE(share.baseline);
  EXPECT_TRUE(share.candidate);
  EXPECT_FALSE(share.difference);
  EXPECT_FALSE(EstimatePair(QuantityKind::kMedianAbsoluteError, frames, frames).candidate);
}

TEST(EstimatePair, RefusesFramesWithoutAPartner) {
  EXPECT_THROW(EstimatePair(QuantityKind::kCount, Found(0), {}), std::logic_error);
}

}  // namespace
}  // namespace declutter::accuracy
