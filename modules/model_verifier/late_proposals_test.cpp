#include "modules/model_verifier/late_proposals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/model_verifier/model_verifier.h"
#include "modules/model_verifier/ray_casting.h"
#include "modules/scene_renderer/scene_renderer.h"
#include "modules/scene_renderer/scene_text.h"

namespace declutter {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

// A wide box hides much of what stands behind it.
RenderedScene SceneWith(const std::string& hidden) {
  return Render(ParseScene("object { box { size_x_m: 0.2 size_y_m: 0.06 size_z_m: 0.06 }"
                           "  x_m: -0.05 y_m: 0.6 }" +
                               hidden,
                           "scene"),
                1);
}

constexpr char kHiddenBox[] =
    "object { box { size_x_m: 0.08 size_y_m: 0.05 size_z_m: 0.10 } x_m: 0.03 y_m: 0.68 }";
constexpr char kHiddenCylinder[] =
    "object { cylinder { radius_m: 0.035 height_m: 0.11 } x_m: 0.03 y_m: 0.68 }";

ObjectList VerifyFirst(const RenderedScene& scene) {
  DepthFrame frame;
  frame.image = scene.depth;
  HypothesisList list;
  list.planes = {scene.table};
  list.hypotheses.emplace_back().solid = scene.objects[0].solid;
  return ModelVerifier(ModelVerifierConfig()).Verify(frame, list);
}

// The proposals when the first object was selected.
std::vector<LateProposal> ProposalsBesideFirst(const RenderedScene& scene) {
  ObservedImage observed;
  observed.Set(scene.depth, scene.table);
  const Observation observation = observed.every_second_pixel();
  const Solid& first = scene.objects[0].solid;
  std::vector<uint8_t> num_explaining(static_cast<size_t>(observation.grid.num_pixels()), 0);
  for (const int32_t pixel : CastRays(first, observation).explained) {
    num_explaining[static_cast<size_t>(pixel)] = 1;
  }
  return LateProposer().ProposeForUnexplained({first}, num_explaining, 150, observation);
}

TEST(LateProposer, LaysABoxOverWhatIsSeenOfOne) {
  const RenderedScene scene = SceneWith(kHiddenBox);
  const ObjectList found = VerifyFirst(scene);
  ASSERT_THAT(found.objects, SizeIs(2));
  for (const ObjectModel& object : found.objects) EXPECT_EQ(object.solid.shape, Shape::kBox);
  const Solid& box = found.objects[1].solid;
  EXPECT_LT((box.X_CO.translation() - scene.objects[1].solid.X_CO.translation()).norm(), 0.004);
  EXPECT_NEAR(box.size.head<2>().maxCoeff(), 0.08, 0.004);
  EXPECT_NEAR(box.size.head<2>().minCoeff(), 0.05, 0.004);
}

TEST(LateProposer, LaysACylinderOverWhatIsSeenOfOne) {
  const ObjectList found = VerifyFirst(SceneWith(kHiddenCylinder));
  ASSERT_THAT(found.objects, SizeIs(2));
  EXPECT_EQ(found.objects[1].solid.shape, Shape::kCylinder);
  EXPECT_NEAR(found.objects[1].solid.radius(), 0.035, 0.002);
}

TEST(LateProposer, PutsTheBodyOfAStripBehindWhatHidesIt) {
  // Of the box, a strip along the right edge of its top is seen, and the body is left of it.
  const RenderedScene scene =
      Render(ParseScene("object { cylinder { radius_m: 0.05 height_m: 0.2 } x_m: 0.1 y_m: 0.6 }"
                        "object { box { size_x_m: 0.075 size_y_m: 0.106 size_z_m: 0.038 }"
                        "  x_m: 0.15 y_m: 0.7 yaw_rad: -0.2 }",
                        "scene"),
             1);
  const ObjectList found = VerifyFirst(scene);
  ASSERT_THAT(found.objects, SizeIs(2));
  EXPECT_EQ(found.objects[0].solid.shape, Shape::kBox);
  const Eigen::Vector3d centre_O =
      scene.objects[1].solid.X_CO.inverse() * found.objects[0].solid.X_CO.translation();
  EXPECT_LT(centre_O.cwiseAbs().maxCoeff(), 0.03);
}

TEST(LateProposer, TellsHowMuchASolidWasLaidOver) {
  const RenderedScene scene = SceneWith(kHiddenBox);
  int num_seen = 0;
  for (const uint8_t label : scene.labels) num_seen += label == scene.objects[1].label;
  const auto proposals = ProposalsBesideFirst(scene);
  ASSERT_FALSE(proposals.empty());
  for (const LateProposal& proposal : proposals) {
    EXPECT_NEAR(proposal.num_px, num_seen, 0.1 * num_seen);
  }
}

TEST(LateProposer, ProposesNothingWhereAllIsExplained) {
  EXPECT_THAT(ProposalsBesideFirst(SceneWith("")), IsEmpty());
}

TEST(LateProposer, LeavesAloneWhatIsFarFromAllThatWasSelected) {
  const RenderedScene scene = SceneWith(
      "object { box { size_x_m: 0.08 size_y_m: 0.05 size_z_m: 0.10 } x_m: 0.3 y_m: 0.85 }");
  EXPECT_THAT(ProposalsBesideFirst(scene), IsEmpty());
}

}  // namespace
}  // namespace declutter
