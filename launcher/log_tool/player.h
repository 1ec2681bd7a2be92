#pragma once

#include <functional>
#include <string>
#include <vector>

#include "launcher/excerpt.h"
#include "modules/runtime/event_log.h"

namespace declutter::log_tool {

// Gives take every event of a part of a log when it is due: in the time in which it was recorded,
// divided by speed. Where stdin is a terminal, the space bar stops it and lets it go on, and n
// gives the next event while it is stopped. Between events goes_on is called, at least ten times a
// second, with a key that was pressed, else 0; it ends the playing by returning false. Returns what
// is damaged, each with its place. Throws std::runtime_error when the log cannot be opened or has
// nothing in that part.
std::vector<std::string> PlayTo(
    const std::function<void(const runtime::LogEvent&, double at_s)>& take, const std::string& log,
    const launcher::Excerpt& excerpt, double speed, const std::function<bool(char key)>& goes_on);

// Publishes it; again and again when it loops. Returns the exit code: 1 when the log is damaged.
// Throws std::runtime_error when log or network cannot be opened.
int Play(const std::string& log, const launcher::Excerpt& excerpt, double speed, bool loops,
         const std::string& url);

}  // namespace declutter::log_tool
