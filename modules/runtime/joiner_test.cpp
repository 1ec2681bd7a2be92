#include "modules/runtime/joiner.h"

#include <gtest/gtest.h>

namespace declutter::runtime {
namespace {

constexpr auto kA = Joiner::Side::kA;
constexpr auto kB = Joiner::Side::kB;

Part PartOf(std::uint8_t content) { return std::make_shared<const Bytes>(1, content); }

TEST(Joiner, PairsPartsOfTheSameTime) {
  Joiner joiner(4);
  EXPECT_FALSE(joiner.Put(kA, 10, PartOf(1)));
  EXPECT_FALSE(joiner.Put(kB, 20, PartOf(2)));
  const std::optional<Parts> pair = joiner.Put(kB, 10, PartOf(3));
  ASSERT_TRUE(pair);
  EXPECT_EQ(*(*pair)[0], Bytes{1});
  EXPECT_EQ(*(*pair)[1], Bytes{3});
}

TEST(Joiner, KeepsTheOrderOfTheChannelsWhenTheFirstComesLast) {
  Joiner joiner(4);
  joiner.Put(kB, 10, PartOf(2));
  const std::optional<Parts> pair = joiner.Put(kA, 10, PartOf(1));
  ASSERT_TRUE(pair);
  EXPECT_EQ(*(*pair)[0], Bytes{1});
  EXPECT_EQ(*(*pair)[1], Bytes{2});
}

TEST(Joiner, PairsAgainWhenEitherPartIsSentAgain) {
  Joiner joiner(4);
  joiner.Put(kA, 10, PartOf(1));
  joiner.Put(kB, 10, PartOf(2));
  EXPECT_TRUE(joiner.Put(kA, 10, PartOf(1)));
  EXPECT_TRUE(joiner.Put(kB, 10, PartOf(2)));
}

TEST(Joiner, TakesOtherContentUnderTheSameTimeForAnotherFrame) {
  Joiner joiner(4);
  joiner.Put(kA, 10, PartOf(1));
  joiner.Put(kB, 10, PartOf(2));
  EXPECT_FALSE(joiner.Put(kA, 10, PartOf(7)));
  const std::optional<Parts> pair = joiner.Put(kB, 10, PartOf(8));
  ASSERT_TRUE(pair);
  EXPECT_EQ(*(*pair)[0], Bytes{7});
}

TEST(Joiner, DropsTheOldestAndCountsItWhenItHadNoPartner) {
  Joiner joiner(2);
  joiner.Put(kA, 1, PartOf(1));
  joiner.Put(kA, 2, PartOf(2));
  joiner.Put(kB, 2, PartOf(2));
  joiner.Put(kA, 3, PartOf(3));
  EXPECT_EQ(joiner.num_unpaired(), 1);
  EXPECT_FALSE(joiner.Put(kB, 1, PartOf(1)));
  joiner.Put(kA, 4, PartOf(4));
  EXPECT_EQ(joiner.num_unpaired(), 1);
}

}  // namespace
}  // namespace declutter::runtime
