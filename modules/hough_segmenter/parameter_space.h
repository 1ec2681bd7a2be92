#pragma once

#include <optional>
#include <vector>

#include "modules/hough_segmenter/ransac_fits.h"

namespace declutter {

// Votes for models of one shape: (theta, rho) for lines, (cx, cy, r) for circles (paper, section
// 4).
template <typename Model>
class ParameterSpace {
 public:
  void Add(Fit<Model> vote) { votes_.push_back(std::move(vote)); }

  struct Peak {
    Model model;        // mean of its votes, weighted by support
    Model strongest;    // the vote with the densest neighbourhood
    float density = 0;  // sum of the support of its votes [px]
    int num_votes = 0;
  };

  // The highest concentration of votes; nothing when there are none.
  std::optional<Peak> HighestPeak() const;

  // Forgets the votes in the neighbourhood of a model.
  void Remove(const Model& model);

  // Forgets the votes of which less than half of the points are still free.
  void KeepSupported(const std::vector<SideCell>& cells, const std::vector<char>& is_free);

 private:
  std::vector<Fit<Model>> votes_;
};

extern template class ParameterSpace<LineModel>;
extern template class ParameterSpace<CircleModel>;

}  // namespace declutter
