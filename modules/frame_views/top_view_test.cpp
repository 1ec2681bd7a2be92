#include "modules/frame_views/top_view.h"

#include <gtest/gtest.h>

#include "modules/object_exporter/object_tags.h"

namespace declutter {
namespace {

// A camera 1 m above a table, looking straight down: T lies as C does, seen from the other side.
const Plane kTable{-Eigen::Vector3d::UnitZ(), 1.0};

ObjectList OneBox() {
  ObjectList list;
  list.planes = {kTable};
  list.objects.resize(1);
  ObjectModel& box = list.objects[0];
  box.id = 1;
  box.solid.X_CO.linear() = Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()).toRotationMatrix();
  box.solid.X_CO.translation() = Eigen::Vector3d(0.1, 0.0, 0.95);
  box.solid.size = Eigen::Vector3d(0.3, 0.2, 0.1);
  return list;
}

int CountOf(const imaging::Rgb& color, const ColorImage& image) {
  int num = 0;
  for (size_t i = 0; i < image.rgb.size(); i += 3) {
    const bool is_it =
        image.rgb[i] == color[0] && image.rgb[i + 1] == color[1] && image.rgb[i + 2] == color[2];
    num += is_it ? 1 : 0;
  }
  return num;
}

TEST(TopView, OutlinesAnObjectAtItsSize) {
  const ObjectList list = OneBox();
  const ColorImage image = DrawTopView({nullptr, nullptr, &list});
  // 0.3 m x 0.2 m and margins of 0.1 m.
  EXPECT_NEAR(image.width, 0.5 * 1500, 2);
  EXPECT_NEAR(image.height, 0.4 * 1500, 2);
  // A line of 3 px along all four sides, with smooth edges.
  EXPECT_NEAR(CountOf(ColorOf(1), image), 3 * (2 * 450 + 2 * 300), 500);
}

TEST(TopView, TellsTheVotesOfAHypothesis) {
  HypothesisList hypotheses;
  hypotheses.planes = {kTable};
  hypotheses.hypotheses.resize(1);
  hypotheses.hypotheses[0].solid = OneBox().objects[0].solid;
  const ObjectList list = OneBox();
  const ColorImage without = DrawTopView({nullptr, &hypotheses, &list});
  hypotheses.hypotheses[0].num_votes = 25;
  const ColorImage with = DrawTopView({nullptr, &hypotheses, &list});
  EXPECT_NE(without.rgb, with.rgb);
  hypotheses.hypotheses[0].num_votes = 24;
  EXPECT_NE(DrawTopView({nullptr, &hypotheses, &list}).rgb, with.rgb);
}

TEST(TopView, ShowsMeasuredPoints) {
  Tabletop tabletop;
  tabletop.planes = {{kTable, {{-0.2f, -0.2f, 1}, {0.2f, -0.2f, 1}, {0.2f, 0.2f, 1}}}};
  tabletop.objects = {{2, 1, 100, 100, 0.5, 0}, 0.001, {900, 900}};
  const ColorImage image = DrawTopView({&tabletop, nullptr, nullptr});
  tabletop.objects.counts = {0, 0};
  EXPECT_NE(DrawTopView({&tabletop, nullptr, nullptr}).rgb, image.rgb);
}

TEST(TopView, IsEmptyWithoutASupportPlane) {
  const ObjectList list;
  EXPECT_EQ(DrawTopView({nullptr, nullptr, &list}).width, 0);
}

}  // namespace
}  // namespace declutter
