#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/model_verifier.pb.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// Tells again and again, with memory that is used again, which objects to report.
class SupportedObjects {
 public:
  explicit SupportedObjects(const ModelVerifierConfig& config) : config_(config) {}

  // 1 for each object in its final place that is certain, and for which enough speaks that speaks
  // for no other one. Where two are in one place the one gives way of which a smaller share speaks
  // for it alone. evidence: of the objects, at most 255, on one grid of num_pixels; there may be
  // more. Valid until the next call.
  const std::vector<uint8_t>& Find(const std::vector<ObjectModel>& objects,
                                   const std::vector<RayEvidence>& evidence, int num_pixels);

 private:
  std::optional<size_t> LeastSupported(const std::vector<RayEvidence>& evidence) const;

  ModelVerifierConfig config_;
  std::vector<uint8_t> is_kept_;
  std::vector<uint8_t> num_explaining_;  // kept objects, per pixel
};

}  // namespace declutter
