#pragma once

#include "modules/geometry/solid.h"
#include "modules/imaging/canvas.h"

namespace declutter {

// [m] What is nearer to the camera than this is not drawn.
inline constexpr double kMinDrawnDepthM = 0.05;

// The colour in which an object is drawn; ids count from 1.
imaging::Rgb ColorOf(int id);

// Writes id, shape, size and confidence of every object beside it, where the tag hides few pixels
// of objects and no other tag. `scale` is the size of a dot of the larger letters [px].
void DrawTags(const ObjectList& list, int scale, imaging::Canvas* canvas);

}  // namespace declutter
