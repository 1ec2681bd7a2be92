#pragma once

namespace declutter {

// [px] Longest side of an image on its way through the graph.
inline constexpr int kMaxImageSide_px = 4096;

}  // namespace declutter
