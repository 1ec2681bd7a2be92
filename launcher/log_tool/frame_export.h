#pragma once

#include <string>

#include "launcher/excerpt.h"

namespace declutter::log_tool {

// Both write files for every frame of a part of a log into a folder, which is made, in place of
// those that have their names. They return the exit code: 1 when something of the log could not be
// read, of which they tell on stderr. Throw std::runtime_error when log or folder cannot be used.

// FRAME.overlay.png, the objects over the image; FRAME.top.png, table, points, hypotheses with
// their votes and objects from above; FRAME.curvature.png and FRAME.r_min.png, the features; and
// contact_sheet_1.png, ... with all overlays. Each where the log has something to show there.
int WritePictures(const std::string& log, const std::string& folder, const launcher::Excerpt& part);

// FRAME.pcd, the depth image as an organised cloud in C with colours and ids of objects, and
// FRAME.models.pcd, points of the objects' whole surfaces.
int WriteClouds(const std::string& log, const std::string& folder, const launcher::Excerpt& part);

}  // namespace declutter::log_tool
