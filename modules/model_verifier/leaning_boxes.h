#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "modules/geometry/disjoint_sets.h"
#include "modules/geometry/reused_list.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/projection.h"

namespace declutter {

// A box that neither stands nor lies on a face, and how much it was laid over.
struct LeaningBox {
  Solid solid;
  int num_px = 0;  // [px] of the sensor on the two faces that tell it
};

// Lays boxes over pairs of flat patches at right angles of which none is level: what leans against
// something, or has it below one end. Each patch tells two of the extents. Memory is used again.
class LeaningBoxFinder {
 public:
  // Among the marked pixels of a window of the grid; is_marked has one element per pixel of the
  // grid. Each of the faces has at least min_px. The result is valid until the next call.
  const std::vector<LeaningBox>& Find(const std::vector<uint8_t>& is_marked,
                                      const PixelWindow& window, int min_px,
                                      const Observation& observation);

 private:
  // Points on a plane.
  struct Patch {
    std::vector<Eigen::Vector3d> points;  // [m] in C
    Eigen::Vector3d normal;               // in C, toward the camera
    Eigen::Vector3d mean;                 // [m] in C
    bool is_flat = false;
  };

  void LabelPatches(const std::vector<uint8_t>& is_marked, const PixelWindow& window,
                    const Observation& observation);
  void GatherPatches(size_t min_points);
  std::optional<Solid> BoxOver(const Patch& a, const Patch& b, const Eigen::Vector3d& up);

  static constexpr size_t kNone = static_cast<size_t>(-1);

  // Of the pixels that count, in row-major order.
  DisjointSets sets_;
  std::vector<Eigen::Vector3f> points_, normals_;  // in C
  std::vector<size_t> num_points_;                 // of each set, at its root
  std::vector<size_t> patch_of_root_;

  std::vector<size_t> above_;  // the pixel of the row above, of each column, or kNone
  ReusedList<Patch> patches_;
  std::vector<double> coordinates_;
  std::vector<LeaningBox> boxes_;
};

}  // namespace declutter
