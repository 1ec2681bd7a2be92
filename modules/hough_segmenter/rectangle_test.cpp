#include "modules/hough_segmenter/rectangle.h"

#include <gtest/gtest.h>

namespace declutter {
namespace {

// A face along x, 0.1 m long, at y = 0; its body has larger y.
Face FaceBetween(float z_min, float z_max) {
  Face face;
  face.model.n = {0, -1};
  face.model.s_min = 0;
  face.model.s_max = 0.1f;
  face.model.z_min = z_min;
  face.model.z_max = z_max;
  return face;
}

// A square of points that begins at that face.
TopPatch PatchAt(float height) {
  TopPatch patch;
  patch.height = height;
  patch.hull = {{0, 0}, {0.095f, 0}, {0.095f, 0.095f}, {0, 0.095f}};
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      patch.points.Add({0.005f * static_cast<float>(i), 0.005f * static_cast<float>(j)});
    }
  }
  return patch;
}

TEST(IsAttached, HoldsForTheTopAtTheUpperEndOfAFace) {
  EXPECT_TRUE(IsAttached(FaceBetween(0, 0.075f), PatchAt(0.070f)));
}

TEST(IsAttached, DoesNotHoldForATopThatLiesBelowAFlatFace) {
  EXPECT_FALSE(IsAttached(FaceBetween(0.058f, 0.075f), PatchAt(0.053f)));
}

}  // namespace
}  // namespace declutter
