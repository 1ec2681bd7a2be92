#pragma once

#include <vector>

#include "modules/plane_filter/plane_search.h"

namespace declutter {

// What the dominant planes of a scene are, as indices of the candidates.
struct SceneRoles {
  // First the main support: the plane that is large, in the middle of the image, roughly level and
  // carries most; the floor carries less than the table that stands on it, a wall nothing. Then
  // planes parallel to it, largest first, such as the floor or other tables; those over its hull
  // are the tops of objects and no supports. Empty when there is no candidate.
  std::vector<size_t> supports;
  // Steep planes at the border of the main support with nothing of it behind them: walls, or what
  // stands beside the table. A box as wide as all that is seen of the table cannot be told from
  // one.
  std::vector<size_t> walls;
};

SceneRoles AssignRoles(const InverseDepth& grid, const std::vector<PlaneCandidate>& candidates,
                       const PlaneFilterConfig& config);

}  // namespace declutter
