#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "tests/accuracy/scored_frame.h"
#include "tests/accuracy/summary.h"

namespace declutter::accuracy {

// The summary, and of each frame every object and model with what it counts as.
nlohmann::ordered_json JsonReport(const std::vector<ScoredFrame>& frames, const Summary& summary);

}  // namespace declutter::accuracy
