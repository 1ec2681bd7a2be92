#include "modules/geometry/packing_table.h"

#include <gtest/gtest.h>

#include <vector>

namespace declutter {
namespace {

TEST(PackedLanes, AreThoseOfTheSetAndThenTheOthersInTheirOrder) {
  for (size_t set = 0; set < kPackedLanes.size(); ++set) {
    std::vector<uint8_t> expected, others;
    for (uint8_t lane = 0; lane < 8; ++lane) {
      ((set >> lane & 1) != 0 ? expected : others).push_back(lane);
    }
    expected.insert(expected.end(), others.begin(), others.end());
    EXPECT_EQ(std::vector<uint8_t>(kPackedLanes[set].begin(), kPackedLanes[set].end()), expected);
  }
}

}  // namespace
}  // namespace declutter
