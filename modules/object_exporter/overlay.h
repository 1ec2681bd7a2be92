#pragma once

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"

namespace declutter {

// The models of a frame drawn over its colour image, else over its depth as grey (near is bright).
// Each object has a colour of its own: its pixels are tinted, its outline is drawn bright where it
// should be seen and thin where the object itself or something in front hides it, and a tag tells
// id, shape, confidence and size. Images that are null or not of list.camera's size are not used.
ColorImage DrawOverlay(const ObjectList& list, const DepthImage* depth, const ColorImage* color);

}  // namespace declutter
