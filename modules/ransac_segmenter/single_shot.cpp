#include "modules/ransac_segmenter/single_shot.h"

namespace declutter {

void FitSidesOnce(const HoughSegmenterConfig& config, FeatureMode mode,
                  const std::vector<SideCell>& cells, int component, uint64_t seed,
                  SideDetections* detections) {
  SideFitter fitter(config, mode, cells, seed);
  const SideFits fits = FitSides(&fitter, std::vector<char>(cells.size(), 1));
  for (const LineFit& line : fits.lines) {
    detections->faces.push_back(MakeDetection(line, component, 1));
  }
  for (const CircleFit& circle : fits.circles) {
    detections->arcs.push_back(MakeDetection(circle, component, 1));
  }
}

}  // namespace declutter
