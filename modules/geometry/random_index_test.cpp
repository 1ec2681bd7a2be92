#include "modules/geometry/random_index.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

TEST(RandomIndexTest, SkipLeavesOutIndices) {
  RandomIndex all(7), some(7);
  for (int i = 0; i < 5; ++i) all(100);
  some.Skip(5);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(some(1000), all(1000));
}

}  // namespace
}  // namespace declutter
