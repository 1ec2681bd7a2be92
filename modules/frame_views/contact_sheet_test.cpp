#include "modules/frame_views/contact_sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace declutter {
namespace {

using testing::ElementsAre;

ColorImage Plain(int width, int height, uint8_t value) {
  return {width, height, std::vector<uint8_t>(static_cast<size_t>(3 * width * height), value)};
}

int CountOf(uint8_t red, const ColorImage& image) {
  int num = 0;
  for (size_t i = 0; i < image.rgb.size(); i += 3) num += image.rgb[i] == red ? 1 : 0;
  return num;
}

TEST(ContactSheet, GivesAPageWhenItIsFullAndTheRestAtTheEnd) {
  ContactSheet sheet({2, 2, 40, 30});
  const ColorImage picture = Plain(40, 30, 200);
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(sheet.Add("", picture));
  const auto page = sheet.Add("", picture);
  ASSERT_TRUE(page);
  EXPECT_EQ(CountOf(200, *page), 4 * 40 * 30);
  EXPECT_FALSE(sheet.TakeRest());
  EXPECT_FALSE(sheet.Add("", picture));
  const auto rest = sheet.TakeRest();
  ASSERT_TRUE(rest);
  EXPECT_EQ(CountOf(200, *rest), 40 * 30);
  EXPECT_EQ(rest->width, page->width);
  EXPECT_LT(rest->height, page->height);
  EXPECT_EQ(rest->rgb.size(), 3u * static_cast<size_t>(rest->width * rest->height));
}

TEST(ContactSheet, WritesTheEndOfANameThatIsTooLong) {
  const auto page_of = [](const std::string& name) {
    ContactSheet sheet({1, 1, 60, 30});
    return sheet.Add(name, Plain(60, 30, 0))->rgb;
  };
  EXPECT_NE(page_of("7"), page_of(""));
  EXPECT_EQ(page_of(std::string(40, 'a') + "0123456789"), page_of("b0123456789"));
}

TEST(ShrinkToFit, KeepsTheShapeAndTakesMeans) {
  ColorImage image = Plain(4, 2, 0);
  std::fill(image.rgb.begin(), image.rgb.begin() + 6, 100);  // two pixels of the upper left four
  const ColorImage small = ShrinkToFit(image, 2, 100);
  EXPECT_EQ(small.width, 2);
  EXPECT_EQ(small.height, 1);
  EXPECT_THAT(small.rgb, ElementsAre(50, 50, 50, 0, 0, 0));
}

TEST(ShrinkToFit, LeavesASmallImage) {
  EXPECT_EQ(ShrinkToFit(Plain(4, 2, 7), 4, 2).rgb, Plain(4, 2, 7).rgb);
}

}  // namespace
}  // namespace declutter
