#pragma once

#include <cstdint>

#include "modules/synthetic_sensor/synthetic_sensor.pb.h"

namespace declutter {

// What the sensor does in one of its periods.
struct SensorPeriod {
  bool is_plugged = true;
  bool has_frame = true;      // one leaves the sensor
  bool is_lost = false;       // and is lost on the way
  bool is_corrupt = false;    // data cut short
  bool is_zero = false;       // nothing measured
  int64_t time_shift_us = 0;  // error of the timestamp
};

// The sensor's behaviour in period n = 0, 1, ... after its first start, by its list of faults.
SensorPeriod PeriodOf(const SyntheticSensor& sensor, int64_t n);

}  // namespace declutter
