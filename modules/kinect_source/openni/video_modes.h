#pragma once

#include <OpenNI.h>

#include <optional>
#include <string>

#include "modules/kinect_source/sensor.h"

// The modes of a stream whose pixels can be read here: depth in millimetres or tenths of them,
// 8-bit RGB.
namespace declutter {

// What is asked; of what is left open, the usual, then anything. Nothing when there is no such
// mode.
std::optional<openni::VideoMode> ChooseMode(const openni::VideoStream& stream,
                                            const SensorRequest& request);

// "640x480 px at 30 Hz", what is asked.
std::string AskedText(const SensorRequest& request);

// "640x480 at 30 Hz, 320x240 at 30 or 60 Hz", what there is.
std::string SupportedText(const openni::VideoStream& stream);

}  // namespace declutter
