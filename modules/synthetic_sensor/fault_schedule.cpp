#include "modules/synthetic_sensor/fault_schedule.h"

#include <cmath>
#include <string>

namespace declutter {

SensorPeriod PeriodOf(const SyntheticSensor& sensor, int64_t n) {
  if (sensor.repeat_after() > 0) n %= sensor.repeat_after();
  SensorPeriod period;
  for (const SensorFault& fault : sensor.fault()) {
    if (n < fault.begin() || n >= fault.begin() + fault.num_periods()) continue;
    const std::string& kind = fault.kind();
    if (kind == "unplug") period.is_plugged = false;
    if (kind == "unplug" || kind == "stall") period.has_frame = false;
    if (kind == "drop") period.is_lost = true;
    if (kind == "corrupt") period.is_corrupt = true;
    if (kind == "zero") period.is_zero = true;
    if (kind == "wrong_time") period.time_shift_us += std::llround(1e6 * fault.time_shift_s());
  }
  return period;
}

}  // namespace declutter
