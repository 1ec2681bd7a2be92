#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "tests/paper/method.h"

namespace declutter::experiments {

// Each prints a table of the paper's section 6 as it goes and returns its rows for a report.

// Table 2: error and spread of one scene over num_runs runs, with another seed of the random
// samples each on the same frame, and with another noise each.
nlohmann::ordered_json PrintTable2(const Scene& scene, int num_runs);

// Figure 4 as a table: what is found in the scenes without each of the inlier filters.
nlohmann::ordered_json PrintFigure4(const std::vector<RenderedScene>& scenes);

// Table 3: what is found in the scenes with I = 5 .. 150 iterations.
nlohmann::ordered_json PrintTable3(const std::vector<RenderedScene>& scenes);

}  // namespace declutter::experiments
