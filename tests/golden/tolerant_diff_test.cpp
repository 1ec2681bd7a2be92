#include "tests/golden/tolerant_diff.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace declutter::golden {
namespace {

constexpr char kExpected[] =
    "== first\n"
    "objects 2\n"
    "box at 10 20 30 size 160 80\n"
    "can at 50 20 30 size 90 150\n"
    "== second\n"
    "objects 0\n";

std::string With(const std::string& part, const std::string& other) {
  std::string text = kExpected;
  return text.replace(text.find(part), part.size(), other);
}

const Tolerances kTolerances = {{"at", {2.0, 0.0}}, {"size", {0.0, 0.1}}};

TEST(TolerantDiff, IsEmptyForTextsWhoseNumbersAreNear) {
  EXPECT_EQ(TolerantDiff(kExpected, kExpected, {}), "");
  EXPECT_EQ(TolerantDiff(kExpected, With("50 20 30 size 90", "52 18 30 size 98.9"), kTolerances),
            "");
}

TEST(TolerantDiff, TellsTheNumberThatIsTooFarOff) {
  EXPECT_EQ(TolerantDiff(kExpected, With("90 150", "90 170"), kTolerances),
            "== first\n"
            "- can at 50 20 30 size 90 150\n"
            "+ can at 50 20 30 size 90 170   (size 150 -> 170, may differ by 15)\n");
}

TEST(TolerantDiff, WantsNumbersWithoutAToleranceEqual) {
  EXPECT_EQ(TolerantDiff(kExpected, With("objects 0", "objects 1"), kTolerances),
            "== second\n- objects 0\n+ objects 1   (objects 0 -> 1, may differ by 0)\n");
}

TEST(TolerantDiff, ShowsLinesThatAreGoneOrNew) {
  const std::string fewer = With("box at 10 20 30 size 160 80\n", "");
  EXPECT_EQ(TolerantDiff(kExpected, fewer, kTolerances),
            "== first\n- box at 10 20 30 size 160 80\n");
  EXPECT_EQ(TolerantDiff(fewer, kExpected, kTolerances),
            "== first\n+ box at 10 20 30 size 160 80\n");
  EXPECT_EQ(TolerantDiff(kExpected, "", kTolerances).substr(0, 23), "== first\n- == first\n- o");
}

TEST(TolerantDiff, ShowsALineWithOtherWordsAsBothGoneAndNew) {
  EXPECT_EQ(TolerantDiff(kExpected, With("can at 50", "box at 50"), kTolerances),
            "== first\n"
            "- can at 50 20 30 size 90 150\n"
            "+ box at 50 20 30 size 90 150\n");
}

TEST(ParseTolerances, TakesALineForEachWord) {
  const Tolerances tolerances = ParseTolerances("# word\nat 2 0  # mm\n\nsize 0 0.1\n");
  ASSERT_EQ(tolerances.size(), 2u);
  EXPECT_EQ(tolerances.at("at").absolute, 2.0);
  EXPECT_EQ(tolerances.at("size").relative, 0.1);
  EXPECT_THROW(ParseTolerances("at 2"), std::runtime_error);
  EXPECT_THROW(ParseTolerances("at 2 0 mm"), std::runtime_error);
}

}  // namespace
}  // namespace declutter::golden
