#include "modules/model_verifier/supported_objects.h"

#include <algorithm>

namespace declutter {
namespace {

// [px] of what speaks for an object and for no other, less what speaks against it.
double OwnBalance(const RayEvidence& evidence, const std::vector<uint8_t>& num_explaining) {
  return FitAlone(evidence, num_explaining, 1) - evidence.num_violating -
         evidence.num_contradicting - NumOverhangingAlone(evidence, num_explaining);
}

// True when enough is seen of an object, whatever else is there: of one of which no extent is seen,
// twice as much.
bool IsSeen(const ObjectModel& object, const RayEvidence& evidence, double min_px) {
  const bool has_extent = std::any_of(object.evidence.begin(), object.evidence.end(),
                                      [](Evidence extent) { return extent != Evidence::kAssumed; });
  return evidence.Fit() - evidence.num_violating - evidence.num_contradicting >= min_px &&
         (has_extent || evidence.num_explained() >= 2 * min_px);
}

// True when so much speaks for an object alone that it is not mostly others that the rest speaks
// for.
bool IsSupported(const RayEvidence& evidence, double own_balance, double min_px) {
  constexpr double kMinOwnShare = 0.4;  // of what speaks for it
  return own_balance >= std::max(min_px, kMinOwnShare * evidence.Fit());
}

}  // namespace

const std::vector<uint8_t>& SupportedObjects::Find(const std::vector<ObjectModel>& objects,
                                                   const std::vector<RayEvidence>& evidence,
                                                   int num_pixels) {
  is_kept_.assign(objects.size(), 0);
  num_explaining_.assign(static_cast<size_t>(num_pixels), 0);
  for (size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].confidence < config_.min_confidence() ||
        !IsSeen(objects[i], evidence[i], config_.min_explained_px())) {
      continue;
    }
    is_kept_[i] = 1;
    for (const int32_t pixel : evidence[i].explained) {
      ++num_explaining_[static_cast<size_t>(pixel)];
    }
  }
  // One at a time: what it shared speaks for the others alone when it is gone, or against them
  // where their top goes on there.
  while (const auto least = LeastSupported(evidence)) {
    is_kept_[*least] = 0;
    for (const int32_t pixel : evidence[*least].explained) {
      --num_explaining_[static_cast<size_t>(pixel)];
    }
  }
  return is_kept_;
}

// Of the objects that are kept and not supported, the one of which the least share speaks for it
// alone.
std::optional<size_t> SupportedObjects::LeastSupported(
    const std::vector<RayEvidence>& evidence) const {
  std::optional<size_t> least;
  double least_share = 0;
  for (size_t i = 0; i < is_kept_.size(); ++i) {
    if (!is_kept_[i]) continue;
    const double own_balance = OwnBalance(evidence[i], num_explaining_);
    if (IsSupported(evidence[i], own_balance, config_.min_explained_px())) continue;
    const double share = own_balance / evidence[i].Fit();
    if (least && share >= least_share) continue;
    least = i;
    least_share = share;
  }
  return least;
}

}  // namespace declutter
