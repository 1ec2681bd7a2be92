#pragma once

#include <optional>

#include "modules/hough_segmenter/model_fits.h"
#include "modules/hough_segmenter/top_patches.h"

namespace declutter {

// Fits discs to top patches, with memory that is used again.
class DiscFitter {
 public:
  // The circle that most of the free edge of a patch lies on, and that the whole patch lies in;
  // nothing when there is none or when the edge is too short to tell it from a straight one. Centre
  // and radius only.
  std::optional<CircleModel> Fit(const TopPatch& patch, float min_radius_m, float max_radius_m);

 private:
  struct ScoredCircle {
    CircleModel circle;
    int score = 0;  // edge points

    // The first of the best ones.
    void Replace(const CircleModel& other, int other_score) {
      if (other_score > score) *this = {other, other_score};
    }
  };
  // The best circles through three of the corners. On an edge that is all of a disc most points are
  // on the circle; on one that has other parts too none are far inside. Scores 0: none.
  struct BestCircles {
    ScoredCircle whole;
    ScoredCircle part;
  };
  BestCircles FindBest(float min_radius_m, float max_radius_m, float tolerance) const;

  PlanarPoints corners_;  // edge points that circles are laid through
  PlanarPoints scored_;   // edge points that decide between them
};

}  // namespace declutter
