#include "modules/hough_segmenter/quantile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace declutter {
namespace {

TEST(Quantiles, AreValuesOfTheSortedSample) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0.3f, 0.01f);
  for (const size_t num : {size_t{1}, size_t{2}, size_t{15}, size_t{16}, size_t{1000}}) {
    std::vector<float> values(num);
    for (float& value : values) value = normal(random);
    values[0] = -10;  // nearly all others are in one bin
    std::vector<float> sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double fraction) {
      return sorted[static_cast<size_t>(fraction * static_cast<double>(num - 1))];
    };
    const std::vector<float> before = values;
    const Range range = Quantiles(&values, 0.02, 0.995);
    EXPECT_EQ(range.low, at(0.02));
    EXPECT_EQ(range.high, at(0.995));
    EXPECT_EQ(Quantile(&values, 0.5), at(0.5));
    EXPECT_EQ(values, before);
  }
}

TEST(Quantiles, OfEqualValuesAreThatValue) {
  std::vector<float> values(20, 0.1f);
  EXPECT_EQ(Quantile(&values, 0.5), 0.1f);
}

}  // namespace
}  // namespace declutter
