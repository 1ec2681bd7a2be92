#pragma once

#include "declutter/color_frame_t.hpp"
#include "declutter/depth_frame_t.hpp"
#include "declutter/feature_cloud_t.hpp"
#include "declutter/hypothesis_list_t.hpp"
#include "declutter/module_status_t.hpp"
#include "declutter/object_list_t.hpp"
#include "declutter/run_info_t.hpp"
#include "declutter/tabletop_t.hpp"

namespace declutter {

// A channel carries messages of one type: publishing or subscribing another does not compile.
template <typename Message>
struct Channel {
  const char* name;
};

inline constexpr Channel<depth_frame_t> kDepthFrame{"DEPTH_FRAME"};
inline constexpr Channel<color_frame_t> kColorFrame{"COLOR_FRAME"};
inline constexpr Channel<tabletop_t> kTabletop{"TABLETOP"};
inline constexpr Channel<feature_cloud_t> kFeatures{"FEATURES"};
inline constexpr Channel<hypothesis_list_t> kHypotheses{"HYPOTHESES"};
inline constexpr Channel<object_list_t> kObjects{"OBJECTS"};
inline constexpr Channel<module_status_t> kModuleStatus{"MODULE_STATUS"};
inline constexpr Channel<run_info_t> kRunInfo{"RUN_INFO"};

}  // namespace declutter
