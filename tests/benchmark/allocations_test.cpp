#include "tests/benchmark/allocations.h"

#include <gtest/gtest.h>

#include "modules/feature_estimator/feature_estimator.h"
#include "modules/hough_segmenter/hough_segmenter.h"
#include "modules/model_verifier/model_verifier.h"
#include "modules/plane_filter/plane_filter.h"
#include "tests/benchmark/bench_frame.h"

namespace declutter::benchmark {
namespace {

// Of a frame that has been seen a few times.
TEST(Allocations, OfTheSegmenterAreTheListsOfItsResult) {
  const BenchFrame frame = RenderedFrames(1)[0];
  for (const FeatureCloud* features : {&frame.features, &frame.paper_features}) {
    HoughSegmenter segmenter{HoughSegmenterConfig()};
    const auto count = [&] {
      const int64_t num_before = NumAllocations();
      const HypothesisList list = segmenter.Segment(frame.tabletop, *features);
      EXPECT_FALSE(list.hypotheses.empty());
      return NumAllocations() - num_before;
    };
    EXPECT_GT(count(), 100);
    // Patches exchange their memory until each has enough: that takes a few frames.
    for (int k = 0; k < 10; ++k) count();
    EXPECT_EQ(count(), 2);  // support planes and hypotheses
  }
}

TEST(Allocations, OfThePlaneFilterAndTheFeatureEstimatorAreNone) {
  const BenchFrame frame = RenderedFrames(1)[0];
  PlaneFilter filter{PlaneFilterConfig()};
  FeatureEstimator estimator{FeatureEstimatorConfig()};
  const auto count = [&] {
    const int64_t num_before = NumAllocations();
    const Tabletop& tabletop = filter.Filter(frame.depth);
    EXPECT_FALSE(estimator.Estimate(tabletop).points.empty());
    return NumAllocations() - num_before;
  };
  EXPECT_GT(count(), 100);
  count();
  EXPECT_EQ(count(), 0);
}

TEST(Allocations, OfTheVerifierAreTheListsOfItsResult) {
  const BenchFrame frame = RenderedFrames(1)[0];
  ModelVerifier verifier{ModelVerifierConfig()};
  const auto count = [&] {
    const int64_t num_before = NumAllocations();
    const ObjectList list = verifier.Verify(frame.depth, frame.hypotheses);
    EXPECT_FALSE(list.objects.empty());
    return NumAllocations() - num_before;
  };
  EXPECT_GT(count(), 100);
  // Evidence changes places between solids until all have enough.
  for (int k = 0; k < 40; ++k) count();
  EXPECT_EQ(count(), 3);  // support planes, objects and labels
}

}  // namespace
}  // namespace declutter::benchmark
