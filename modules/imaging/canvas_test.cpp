#include "modules/imaging/canvas.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace declutter::imaging {
namespace {

constexpr Rgb kRed = {255, 0, 0};

Canvas Black(int width, int height) {
  return Canvas({width, height, std::vector<uint8_t>(static_cast<size_t>(3 * width * height))});
}

int RedAt(const Canvas& canvas, int u, int v) {
  return canvas.image().rgb[static_cast<size_t>(3 * (v * canvas.image().width + u))];
}

TEST(CanvasTest, RefusesAnImageWithoutAllItsPixels) {
  EXPECT_THROW(Canvas({4, 4, std::vector<uint8_t>(3)}), std::logic_error);
}

TEST(CanvasTest, BlendsByOpacity) {
  Canvas canvas({1, 1, {100, 100, 100}});
  canvas.Blend(0, 0, {200, 0, 100}, 0.5);
  EXPECT_THAT(canvas.image().rgb, ::testing::ElementsAre(150, 50, 100));
}

TEST(CanvasTest, LineHasItsThickness) {
  Canvas canvas = Black(9, 9);
  canvas.DrawLine({-20, 4}, {20, 4}, 3, kRed);
  EXPECT_EQ(RedAt(canvas, 5, 2), 0);
  for (int v = 3; v <= 5; ++v) EXPECT_EQ(RedAt(canvas, 5, v), 255);
  EXPECT_EQ(RedAt(canvas, 5, 6), 0);
}

TEST(CanvasTest, DrawsTheVisiblePartOfALineFarOutside) {
  Canvas canvas = Black(8, 8);
  canvas.DrawLine({-1e9, -1e9}, {1e9, 1e9}, 1, kRed);
  for (int i = 0; i < 8; ++i) EXPECT_GT(RedAt(canvas, i, i), 200);
  EXPECT_EQ(RedAt(canvas, 0, 7), 0);
}

TEST(CanvasTest, DrawsNothingOutsideTheImage) {
  Canvas canvas = Black(4, 4);
  canvas.DrawLine({10, 0}, {10, 3}, 2, kRed);
  canvas.DrawLine({-10, 0}, {-10, 3}, 2, kRed);
  canvas.FillRectangle(4, 0, 3, 3, kRed);
  canvas.DrawText(-40, -40, "8", 2, kRed);
  EXPECT_THAT(canvas.image().rgb, ::testing::Each(0));
}

TEST(CanvasTest, DrawsDigitsByTheirDots) {
  Canvas canvas = Black(5, 7);
  canvas.DrawText(0, 0, "1", 1, kRed);
  EXPECT_EQ(RedAt(canvas, 2, 0), 255);
  EXPECT_EQ(RedAt(canvas, 0, 0), 0);
  EXPECT_EQ(RedAt(canvas, 1, 6), 255);
  EXPECT_EQ(RedAt(canvas, 3, 6), 255);
}

TEST(CanvasTest, TextFitsTheSizeItTells) {
  const int width = Canvas::TextWidth("8 box", 2);
  const int height = Canvas::TextHeight(2);
  Canvas canvas = Black(width + 1, height + 1);
  canvas.DrawText(0, 0, "8 box", 2, kRed);
  EXPECT_EQ(RedAt(canvas, width - 1, height - 1), 255);
  for (int v = 0; v <= height; ++v) EXPECT_EQ(RedAt(canvas, width, v), 0);
  for (int u = 0; u <= width; ++u) EXPECT_EQ(RedAt(canvas, u, height), 0);
}

}  // namespace
}  // namespace declutter::imaging
