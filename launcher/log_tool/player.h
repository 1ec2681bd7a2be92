#pragma once

#include <functional>
#include <string>

#include "launcher/excerpt.h"
#include "modules/runtime/event_log.h"

namespace declutter::log_tool {

// Gives every event of a part of a log when it is due: in the time in which it was recorded,
// divided by speed. Where stdin is a terminal, the space bar stops it and lets it go on, and n
// gives the next event while it is stopped. Returns what is damaged, each with its place. Throws
// std::runtime_error when the log cannot be opened.
std::vector<std::string> PlayTo(const std::function<void(const runtime::LogEvent&)>& take,
                                const std::string& log, const launcher::Excerpt& excerpt,
                                double speed);

// Publishes it; again and again when it loops. Returns the exit code: 1 when the log is damaged.
// Throws std::runtime_error when log or network cannot be opened.
int Play(const std::string& log, const launcher::Excerpt& excerpt, double speed, bool loops,
         const std::string& url);

}  // namespace declutter::log_tool
