#pragma once

#include <OpenNI.h>

#include <string>

namespace declutter {

// Why the last call of OpenNI2 failed, on one line.
std::string OpenniError();

// "640x480 at 30 Hz, 320x240 at 30 or 60 Hz": the modes of a stream in formats that are read here.
std::string ModesText(const openni::SensorInfo& stream);

// Whether a mode's pixels can be read: depth in millimetres or tenths of them, 8-bit RGB.
bool IsReadable(const openni::VideoMode& mode);

}  // namespace declutter
