#pragma once

#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"

namespace declutter {

// What there is of a frame; null where there is nothing.
struct TopViewParts {
  const Tabletop* tabletop = nullptr;
  const HypothesisList* hypotheses = nullptr;
  const ObjectList* objects = nullptr;
};

// A frame seen from above, x of T to the right, y of T up: the support planes' hulls, the measured
// points of what stands on them, the outlines of hypotheses, brighter the more votes they have and
// with the number of votes where they have most, and of the objects, in the colours and with the
// ids of the overlay. An empty image when no part tells of a support plane.
ColorImage DrawTopView(const TopViewParts& parts);

}  // namespace declutter
