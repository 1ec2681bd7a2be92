#pragma once

#include <string>

#include "launcher/excerpt.h"

namespace declutter::log_tool {

// Copies a part of a log to a new one, with RUN_INFO, without what is damaged. Returns the exit
// code: 1 when something was damaged, of which it tells on stderr. Throws runtime::ConfigError when
// there is a file of that name, std::runtime_error when nothing can be read or not all be written;
// then there is no new log.
int Cut(const std::string& log, const std::string& new_log, const launcher::Excerpt& excerpt);

}  // namespace declutter::log_tool
