#pragma once

#include <algorithm>

#include "modules/codec/checks.h"

// Regular thinning of the points of an image: step k keeps pixels (u, v) with u % k = v % k = 0.
namespace declutter::codec {

inline bool IsKept(int u, int v, int step) { return u % step == 0 && v % step == 0; }

// Calls write(step, message) with step = thinning, 2 thinning, ... until the message fits. With
// multiples of the thinning that the points already have, the rule above stays true.
template <typename Message, typename Write>
void ThinUntilFitting(int thinning, const Write& write, Message* message) {
  Demand(thinning >= 1, "thinning " + std::to_string(thinning));
  const int side = std::max(message->width, message->height);
  for (int step = thinning;; step += thinning) {
    write(step, message);
    message->thinning = step;
    // From here on only pixel (0, 0) is left.
    if (message->getEncodedSize() <= kMaxMessageBytes || step >= side) return;
  }
}

inline int32_t CheckThinning(int32_t thinning) {
  Check(thinning >= 1, "thinning", thinning, "must be at least 1");
  return thinning;
}

}  // namespace declutter::codec
