#include "launcher/excerpt.h"

#include <sstream>
#include <stdexcept>

#include "modules/runtime/config_error.h"

namespace declutter::launcher {

double ParseNumber(const std::string& text, double min) {
  size_t end = 0;
  double number = 0.0;
  try {
    number = std::stod(text, &end);
  } catch (const std::logic_error&) {
    end = 0;
  }
  if (end > 0 && end == text.size() && number >= min) return number;
  std::ostringstream fault;
  fault << "'" << text << "' is no number from " << min;
  throw runtime::ConfigError(fault.str());
}

}  // namespace declutter::launcher
