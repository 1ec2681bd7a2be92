#pragma once

#include <string>

#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"

// What a module made of a frame, as lines of words and numbers: what a reader wants to know of it
// and a harmless change leaves as it is. Lengths in mm, angles in degrees; what is placed is placed
// in table frame T.
namespace declutter::golden {

std::string Text(const Tabletop& tabletop);
std::string Text(const FeatureCloud& features);
std::string Text(const HypothesisList& list);

// Objects from left to right.
std::string Text(const ObjectList& list);

}  // namespace declutter::golden
