#pragma once

#include <OpenNI.h>

#include "modules/geometry/depth_image.h"

namespace declutter {

// The pixels of an OpenNI2 frame, turned around when the stream is mirrored. Throw DamagedFrame
// when the frame's data is not as long as its size says. The camera of a depth image is left to the
// caller.
DepthImage CopyDepth(const openni::VideoFrameRef& frame, bool is_mirrored);
ColorImage CopyColor(const openni::VideoFrameRef& frame, bool is_mirrored);

}  // namespace declutter
