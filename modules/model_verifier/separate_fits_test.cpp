#include "modules/model_verifier/separate_fits.h"

#include <gtest/gtest.h>

#include "modules/model_verifier/ray_casting.h"
#include "modules/model_verifier/refinement.h"
#include "modules/model_verifier/test_scene.h"

namespace declutter {
namespace {

RayEvidence EvidenceWith(const std::vector<int32_t>& explained, const std::vector<int32_t>& fits) {
  RayEvidence evidence;
  evidence.explained.assign(explained.begin(), explained.end());
  evidence.fits.assign(fits.begin(), fits.end());
  return evidence;
}

TEST(PixelOwners, AreTheSolidsThatPixelsFitBest) {
  const RayEvidence first = EvidenceWith({0, 1, 2}, {10, 50, 70});
  const RayEvidence second = EvidenceWith({1, 2, 4}, {60, 70, 1});
  PixelOwners owners;
  owners.Assign({&first, &second}, 6);
  EXPECT_EQ(owners.owners(), (std::vector<uint8_t>{1, 2, 1, 0, 2, 0}));
}

// Candidates that are these solids, fitted.
std::vector<Candidate> FitSeparately(const std::vector<Solid>& solids,
                                     const ObservedImage& observed) {
  std::vector<Candidate> candidates(solids.size());
  std::vector<Candidate*> selected;
  for (size_t i = 0; i < solids.size(); ++i) {
    candidates[i].hypothesis.solid = solids[i];
    CastRays(solids[i], observed.every_second_pixel(), &candidates[i].evidence);
    selected.push_back(&candidates[i]);
  }
  FitBuffers buffers;
  SeparateFits fits;
  fits.Run(observed, selected, &buffers);
  return candidates;
}

std::vector<Solid> SolidsIn(const RenderedScene& scene) {
  std::vector<Solid> solids;
  for (const TrueObject& object : scene.objects) solids.push_back(object.solid);
  return solids;
}

// A low box, and one in contact with it whose top and right side continue those of the first.
constexpr char kScene[] =
    "object { box { size_x_m: 0.1 size_y_m: 0.08 size_z_m: 0.08 } x_m: -0.15 y_m: 0.6 }"
    "object { box { size_x_m: 0.1 size_y_m: 0.06 size_z_m: 0.08 } x_m: -0.15 y_m: 0.6702 }";

TEST(SeparateFits, KeepBoxesApartOfWhichOneContinuesTheOther) {
  const ObservedScene seen(kScene);
  FitPoints buffer;
  const Solid& truth = seen.scene.objects[0].solid;
  Solid together = truth;
  for (int i = 0; i < 2; ++i) together = Refine(together, seen.observed.every_pixel(), &buffer);
  EXPECT_GT(together.size.y(), truth.size.y() + 0.010);

  const std::vector<Candidate> candidates = FitSeparately(SolidsIn(seen.scene), seen.observed);
  for (size_t i = 0; i < candidates.size(); ++i) {
    const Solid& solid = candidates[i].hypothesis.solid;
    EXPECT_LT((solid.size - seen.scene.objects[i].solid.size).cwiseAbs().maxCoeff(), 0.003) << i;
    EXPECT_EQ(candidates[i].evidence.Balance(),
              CastRays(solid, seen.observed.every_second_pixel()).Balance());
  }
  EXPECT_NE(candidates[0].hypothesis.solid.size, truth.size);
}

// A can of which the top is seen, between two boxes that are somewhat lower.
constexpr char kCanBetweenBoxes[] =
    "object { cylinder { radius_m: 0.025 height_m: 0.08 } y_m: 0.7 }"
    "object { box { size_x_m: 0.06 size_y_m: 0.05 size_z_m: 0.077 } x_m: -0.0555 y_m: 0.7 }"
    "object { box { size_x_m: 0.06 size_y_m: 0.05 size_z_m: 0.077 } x_m: 0.0555 y_m: 0.7 }"
    "object { box { size_x_m: 0.1 size_y_m: 0.03 size_z_m: 0.1 } y_m: 0.63 }"
    "noise { model: \"white\" }";

TEST(SeparateFits, LeaveToOthersWhatACylinderThatIsTooLargeReaches) {
  const ObservedScene seen(kCanBetweenBoxes);
  std::vector<Solid> solids = SolidsIn(seen.scene);
  solids[0].size.head<2>().array() += 0.010;
  solids[0].X_CO.translation() += solids[0].X_CO.linear() * Eigen::Vector3d(0, 0.005, 0);
  const Solid can = FitSeparately(solids, seen.observed)[0].hypothesis.solid;
  EXPECT_NEAR(can.radius(), 0.025, 0.001);
}

}  // namespace
}  // namespace declutter
