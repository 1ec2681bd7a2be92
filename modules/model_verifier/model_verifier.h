#pragma once

#include <cstdint>
#include <vector>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/solid.h"
#include "modules/model_verifier/end_evidence.h"
#include "modules/model_verifier/model_selection.h"
#include "modules/model_verifier/model_verifier.pb.h"
#include "modules/model_verifier/observation.h"
#include "modules/model_verifier/pixel_owners.h"
#include "modules/model_verifier/separate_fits.h"
#include "modules/model_verifier/support_settling.h"
#include "modules/model_verifier/supported_objects.h"

namespace declutter {

// Checks hypotheses against the depth image by ray casting: free, occluded and occupied space
// (paper, sections 1 and 4).
class ModelVerifier {
 public:
  explicit ModelVerifier(const ModelVerifierConfig& config);

  // Objects in C with their visible pixels. Frame and hypotheses must be of the same utime.
  ObjectList Verify(const DepthFrame& frame, const HypothesisList& hypotheses);

 private:
  // The hypotheses that explain the image best, fitted to all pixels.
  void Select(const std::vector<Hypothesis>& hypotheses, const Observation& observation,
              std::vector<ObjectModel>* objects);
  // Fits those again that are mostly new since they were settled: their side may have been seen.
  void RefineExtended(std::vector<ObjectModel>* objects);
  // How certain each object is, what its extents rest on, and how well a cylinder is known.
  void Measure(ObjectList* list);
  // Keeps only what is certain and supported, and numbers it.
  void DropDoubtful(std::vector<ObjectModel>* objects);
  void LabelPixels(ObjectList* list);
  // The hidden ends of boxes, and how well their extents are known.
  void CompleteBoxes(ObjectList* list);
  void FindOthers(size_t index, const ObjectList& list);

  ModelVerifierConfig config_;
  ModelSelection selection_;
  SeparateFits fits_;
  SupportSettler settler_;
  SupportedObjects supported_objects_;
  // Room that the next frame uses again.
  ObservedImage observed_;
  FitBuffers buffers_;
  RayEvidence extended_;  // RefineExtended
  std::vector<RayEvidence> evidence_;
  std::vector<Candidate*> selected_;
  std::vector<const RayEvidence*> of_objects_;
  PixelOwners owners_;
  PixelGrid unexplained_;
  std::vector<int32_t> new_ids_;  // of objects in place of their old ones; 0: none
  std::vector<SolidEnds> ends_;   // of each object
  std::vector<Solid> others_;     // CompleteHiddenEnds
};

}  // namespace declutter
