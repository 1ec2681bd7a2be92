#include "modules/ransac_segmenter/single_shot.h"

namespace declutter {

void FitSidesOnce(int component, SideSearch* search, SideDetections* detections) {
  FitSides(search, [&](const auto& fit) { detections->Add(fit, component, 1); });
}

}  // namespace declutter
