#pragma once

#include "modules/kinect_source/kinect_source.h"
#include "modules/kinect_source/live_reader.h"

namespace declutter {

// What a config's input means.
struct Input {
  KinectSource::Input kind = KinectSource::Input::kRecording;
  KinectSource::ReadFrame read;
};

// Opens config.input: a live sensor (live, live:serial=NUMBER, live:URI), an .oni file, or any
// other recording. Throws NoSensor for a sensor that is not there, std::invalid_argument for what
// no second try can mend.
Input OpenInput(const KinectSourceConfig& config, LiveReader::Now now_us, SensorEvents events);

}  // namespace declutter
