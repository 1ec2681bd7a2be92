#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/surface_parts.h"

namespace declutter {

// Lays solids over parts again and again, with memory that is used again.
class PartCompletion {
 public:
  // Standing solids in C whose surface a part may be: a box along its outline, or several where it
  // is too thin to tell on which side of it the body is, and a cylinder through it. X_CT is the
  // pose of T in C. Valid until the next call.
  const std::vector<Hypothesis>& SolidsOver(const SurfacePart& part, const Eigen::Isometry3d& X_CT);

 private:
  std::vector<Hypothesis> solids_;
  std::vector<float> values_, side_heights_;
};

}  // namespace declutter
