#pragma once

#include <string>
#include <vector>

#include "tests/accuracy/scored_frame.h"
#include "tests/accuracy/summary.h"

namespace declutter::accuracy {

// A page with the totals and, for every frame with a miss or a false model, its remarks above its
// overlay picture, which the page finds at overlay_folder/<frame>.overlay.png.
std::string HtmlReport(const std::vector<ScoredFrame>& frames, const Summary& summary,
                       const std::string& overlay_folder);

}  // namespace declutter::accuracy
