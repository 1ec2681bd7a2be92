#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "modules/geometry/reused_list.h"
#include "modules/hough_segmenter/model_fits.h"

namespace declutter {

// Votes for models of one shape: (theta, rho) for lines, (cx, cy, r) for circles (paper, section
// 4). Votes are cast, then peaks are taken one after the other. Memory is used again.
template <typename Model>
class ParameterSpace {
 public:
  struct Peak {
    Model model;           // mean of its votes, weighted by support
    size_t strongest = 0;  // the vote with the densest neighbourhood
    float density = 0;     // sum of the support of its votes [px]
    int num_votes = 0;
  };

  void Clear() { votes_.Clear(); }
  void Add(const Fit<Model>& fit);

  // Finds the neighbours of each vote, after the last Add().
  void Connect();

  // The highest concentration of votes; nothing when there are none.
  std::optional<Peak> HighestPeak() const;

  // Forgets the strongest vote of a peak and its neighbours.
  void Remove(const Peak& peak);

  // To be told what was explained: forgets the votes of which less than half of the points are
  // still open. cells are those of the component.
  void Explain(const std::vector<SideCell>& cells, const CellSet& explained);

 private:
  struct Vote {
    Fit<Model> fit;
    float key = 0;       // votes that are near have keys that differ little
    float num_open = 0;  // [px] of its points
    bool is_left = true;
    float density = 0;           // sum of the support of its neighbours that are left
    size_t first_neighbour = 0;  // in neighbours_
    size_t num_neighbours = 0;
  };

  template <typename Visit>
  void ForEachLeftNear(size_t vote, Visit visit) const;
  void Forget(size_t vote);

  ReusedList<Vote> votes_;
  std::vector<size_t> neighbours_;  // of one vote after the other; each is its own neighbour
  std::vector<size_t> order_;       // of keys
  std::vector<std::pair<size_t, size_t>> pairs_;
};

extern template class ParameterSpace<LineModel>;
extern template class ParameterSpace<CircleModel>;

}  // namespace declutter
