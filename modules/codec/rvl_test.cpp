#include "modules/codec/rvl.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace declutter::codec {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

std::vector<uint8_t> Encoded(const std::vector<uint16_t>& counts) {
  std::vector<uint8_t> bytes(MaxRvlBytes(counts.size()));
  bytes.resize(EncodeRvl(counts, bytes.data()));
  return bytes;
}

std::optional<std::vector<uint16_t>> Decoded(const std::vector<uint8_t>& bytes, size_t num_counts) {
  return DecodeRvl(bytes.data(), bytes.size(), num_counts);
}

TEST(Rvl, WritesTheNibblesOfThePaper) {
  // Two zeros, three others: 2 3. Differences +4, -1, +9 are the numbers 8, 1, 18, in groups of
  // three bits, lowest first: 8 1, 1, A 2. Then 0 fills the word 0x23811A20, stored lowest byte
  // first.
  EXPECT_THAT(Encoded({0, 0, 4, 3, 12}), ElementsAre(0x20, 0x1A, 0x81, 0x23));
}

TEST(Rvl, RestoresRandomCounts) {
  std::mt19937 random(1);
  std::vector<uint16_t> counts(20'000);
  for (uint16_t& count : counts) count = static_cast<uint16_t>(random());
  EXPECT_THAT(Decoded(Encoded(counts), counts.size()), Optional(counts));
}

TEST(Rvl, RestoresRunsOfAllLengths) {
  std::vector<uint16_t> counts;
  for (size_t length = 1; length < 700; length += 23) {
    counts.insert(counts.end(), length, 0);
    for (size_t i = 0; i < length; ++i) counts.push_back(static_cast<uint16_t>(1000 + i % 9));
  }
  EXPECT_THAT(Decoded(Encoded(counts), counts.size()), Optional(counts));
}

TEST(Rvl, RestoresTheLargestJumpsWithinItsBound) {
  std::vector<uint16_t> counts;
  for (int i = 0; i < 1000; ++i) counts.push_back(i % 2 == 0 ? 1 : 65535);
  const std::vector<uint8_t> bytes = Encoded(counts);
  EXPECT_LE(bytes.size(), MaxRvlBytes(counts.size()));
  EXPECT_THAT(Decoded(bytes, counts.size()), Optional(counts));
}

TEST(Rvl, RestoresZerosAndNothing) {
  const std::vector<uint16_t> zeros(4096 * 4096, 0);
  EXPECT_TRUE(Decoded(Encoded(zeros), zeros.size()) == zeros);
  EXPECT_THAT(Decoded(Encoded({}), 0), Optional(std::vector<uint16_t>{}));
}

TEST(Rvl, RefusesEveryTruncation) {
  std::vector<uint16_t> counts;
  for (int i = 0; i < 100; ++i) counts.push_back(static_cast<uint16_t>(i % 7 * 3000));
  std::vector<uint8_t> bytes = Encoded(counts);
  while (!bytes.empty()) {
    bytes.pop_back();
    EXPECT_EQ(Decoded(bytes, counts.size()), std::nullopt) << bytes.size() << " bytes";
  }
}

TEST(Rvl, RefusesBytesAfterTheEnd) {
  std::vector<uint8_t> bytes = Encoded({7, 8, 9});
  bytes.resize(bytes.size() + 4);
  EXPECT_EQ(Decoded(bytes, 3), std::nullopt);
}

TEST(Rvl, RefusesAnotherNumberOfCounts) {
  const std::vector<uint8_t> bytes = Encoded({7, 8, 9, 0, 0, 5});
  EXPECT_EQ(Decoded(bytes, 5), std::nullopt);
  EXPECT_EQ(Decoded(bytes, 7), std::nullopt);
}

TEST(Rvl, RefusesRunsThatMakeNoProgress) {
  EXPECT_EQ(Decoded(std::vector<uint8_t>(400, 0), 5), std::nullopt);
}

TEST(Rvl, RefusesNumbersWithoutEnd) {
  EXPECT_EQ(Decoded(std::vector<uint8_t>(400, 0xFF), 5), std::nullopt);
}

TEST(Rvl, RefusesDifferencesThatLeaveTheRangeOfCounts) {
  // No zeros, one other; difference -1.
  EXPECT_EQ(Decoded({0x00, 0x00, 0x10, 0x01}, 1), std::nullopt);
  // The same with difference +1 is the count 1.
  EXPECT_THAT(Decoded({0x00, 0x00, 0x20, 0x01}, 1), Optional(ElementsAre(1)));
}

}  // namespace
}  // namespace declutter::codec
