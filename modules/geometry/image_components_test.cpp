#include "modules/geometry/image_components.h"

#include <gmock/gmock.h>

namespace declutter {
namespace {

using ::testing::ElementsAre;

TEST(ImageComponentsTest, JoinsPixelsThatTouchAtACorner) {
  const std::vector<uint8_t> mask = {1, 0, 0, 1,  //
                                     0, 1, 0, 1,  //
                                     0, 0, 0, 0,  //
                                     1, 0, 0, 0};
  const ImageComponents components = LabelComponents(4, 4, mask, std::vector<float>(16), 0);
  EXPECT_THAT(components.label,
              ElementsAre(0, -1, -1, 1, -1, 0, -1, 1, -1, -1, -1, -1, 2, -1, -1, -1));
  EXPECT_THAT(components.num_pixels, ElementsAre(2, 2, 1));
}

TEST(ImageComponentsTest, ArmsThatMeetBelowAreOneComponent) {
  const std::vector<uint8_t> mask = {1, 0, 1, 0, 1,  //
                                     1, 0, 1, 0, 1,  //
                                     1, 1, 1, 1, 1};
  const ImageComponents components = LabelComponents(5, 3, mask, std::vector<float>(15), 0);
  EXPECT_THAT(components.num_pixels, ElementsAre(11));
}

TEST(ImageComponentsTest, AStepInTheValuesSeparates) {
  const std::vector<uint8_t> mask = {1, 1, 1, 1};
  EXPECT_THAT(LabelComponents(4, 1, mask, {1.0f, 1.1f, 1.3f, 1.35f}, 0.15f).label,
              ElementsAre(0, 0, 1, 1));
}

TEST(ImageComponentsTest, AnEmptyMaskHasNone) {
  const std::vector<uint8_t> mask(6);
  EXPECT_THAT(LabelComponents(3, 2, mask, std::vector<float>(6), 1).num_pixels, ElementsAre());
}

}  // namespace
}  // namespace declutter
