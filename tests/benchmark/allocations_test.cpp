#include "tests/benchmark/allocations.h"

#include <gtest/gtest.h>

#include "modules/hough_segmenter/hough_segmenter.h"
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

}  // namespace
}  // namespace declutter::benchmark
