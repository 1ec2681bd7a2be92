#pragma once

#include <cstdint>
#include <vector>

#include "modules/scene_renderer/layout.h"
#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// How cluttered a layout is.
struct ClutterFigures {
  int num_touching_pairs = 0;   // side by side, gap at most 1 mm
  int num_stacked = 0;          // objects that stand on another
  int num_half_hidden = 0;      // objects less than half visible
  double median_gap_m = 0;      // of the gaps to the nearest neighbour at the same height
  std::vector<int> visible_px;  // [px] per object
};

// Figures of a layout seen by the camera of `scene`, counted on every `step`-th pixel.
ClutterFigures Measure(const Scene& scene, const std::vector<PlacedObject>& objects, int step = 1);

// `fixed` and the objects of scene.clutter(), put down so that nothing overlaps, nothing leaves the
// image and the limits of the clutter hold. Starts from a random layout and puts objects down again
// until they do; same seed, same layout. Throws std::invalid_argument after max_moves.
std::vector<PlacedObject> AddClutter(const Scene& scene, uint64_t seed,
                                     const std::vector<PlacedObject>& fixed);

}  // namespace declutter
