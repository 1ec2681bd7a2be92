#include "modules/kinect_source/openni/video_modes.h"

#include <functional>
#include <map>
#include <set>
#include <utility>

namespace declutter {
namespace {

using openni::VideoMode;
using openni::VideoStream;

constexpr int kUsualWidth = 640, kUsualHeight = 480, kUsualRate_hz = 30;

bool IsReadable(const VideoMode& mode) {
  const openni::PixelFormat format = mode.getPixelFormat();
  return format == openni::PIXEL_FORMAT_DEPTH_1_MM || format == openni::PIXEL_FORMAT_DEPTH_100_UM ||
         format == openni::PIXEL_FORMAT_RGB888;
}

bool Fits(const VideoMode& mode, int width, int height, int rate_hz) {
  return IsReadable(mode) && (width == 0 || mode.getResolutionX() == width) &&
         (height == 0 || mode.getResolutionY() == height) &&
         (rate_hz == 0 || mode.getFps() == rate_hz);
}

std::optional<VideoMode> FindMode(const VideoStream& stream, int width, int height, int rate_hz) {
  const VideoMode current = stream.getVideoMode();
  if (Fits(current, width, height, rate_hz)) return current;
  const openni::Array<VideoMode>& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (Fits(modes[i], width, height, rate_hz)) return modes[i];
  }
  return std::nullopt;
}

}  // namespace

std::optional<VideoMode> ChooseMode(const VideoStream& stream, const SensorRequest& request) {
  const int width = request.width > 0 ? request.width : kUsualWidth;
  const int height = request.height > 0 ? request.height : kUsualHeight;
  const int rate_hz = request.rate_hz > 0 ? request.rate_hz : kUsualRate_hz;
  if (const auto mode = FindMode(stream, width, height, rate_hz)) return mode;
  return FindMode(stream, request.width, request.height, request.rate_hz);
}

std::string AskedText(const SensorRequest& request) {
  std::string text;
  if (request.width > 0) {
    text += std::to_string(request.width) + "x" + std::to_string(request.height) + " px";
  }
  if (request.rate_hz > 0) {
    text += (text.empty() ? "" : " at ") + std::to_string(request.rate_hz) + " Hz";
  }
  return text.empty() ? "its default mode" : text;
}

std::string SupportedText(const VideoStream& stream) {
  std::map<std::pair<int, int>, std::set<int>, std::greater<>> rates;  // of each size
  const openni::Array<VideoMode>& modes = stream.getSensorInfo().getSupportedVideoModes();
  for (int i = 0; i < modes.getSize(); ++i) {
    if (!IsReadable(modes[i])) continue;
    rates[{modes[i].getResolutionX(), modes[i].getResolutionY()}].insert(modes[i].getFps());
  }
  std::string text;
  for (const auto& [size, of_size] : rates) {
    text += (text.empty() ? "" : ", ") + std::to_string(size.first) + "x" +
            std::to_string(size.second) + " at ";
    for (const int rate : of_size) {
      text += (rate == *of_size.begin() ? "" : " or ") + std::to_string(rate);
    }
    text += " Hz";
  }
  return text.empty() ? "none that can be read" : text;
}

}  // namespace declutter
