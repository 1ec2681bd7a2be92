#include "modules/synthetic_sensor/driver/sensor.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "modules/runtime/config.h"

namespace declutter {
namespace {

std::string ReadFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::runtime_error(path + ": cannot be read");
  return text.str();
}

SyntheticSensor ReadDescription(const std::string& path) {
  SyntheticSensor description;
  runtime::ParseConfig(ReadFile(path), path, &description);
  runtime::CheckComplete(description);
  return description;
}

// OpenNI2 knows depth in these units only.
void CheckDepthUnit(const DepthImage& image, const std::string& path) {
  for (const double unit_m : {1e-3, 1e-4}) {
    if (std::abs(image.depth_scale_m - unit_m) < 1e-9) return;
  }
  throw std::invalid_argument(path + ": the scene's depth_scale_m must be 0.001 or 0.0001");
}

}  // namespace

Sensor::Sensor(std::string path, std::function<void(bool)> on_plug)
    : path_(std::move(path)), on_plug_(std::move(on_plug)) {}

Sensor::~Sensor() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  if (thread_.joinable()) thread_.join();
  Close();
}

void Sensor::Open() {
  if (lock_fd_ < 0) lock_fd_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (lock_fd_ < 0) throw std::runtime_error(path_ + ": " + std::strerror(errno));
  if (flock(lock_fd_, LOCK_EX | LOCK_NB) != 0) {
    Close();
    throw std::runtime_error(path_ + ": in use by another program");
  }
  if (!images_.depth.empty()) return;
  try {
    const SyntheticSensor description = ReadDescription(path_);
    RenderedImages images = RenderImages(description, path_);
    CheckDepthUnit(images.depth.front(), path_);
    description_ = description;
    images_ = std::move(images);
  } catch (...) {
    Close();
    throw;
  }
}

void Sensor::Close() {
  if (lock_fd_ >= 0) close(lock_fd_);
  lock_fd_ = -1;
}

void Sensor::Start(SensorStream* stream) {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_.insert(stream);
  if (!thread_.joinable()) thread_ = std::thread([this] { Live(); });
}

void Sensor::Stop(SensorStream* stream) {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_.erase(stream);
}

void Sensor::Live() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  for (int64_t n = 0;; ++n) {
    const std::chrono::duration<double> due(static_cast<double>(n + 1) / kSensorRate_hz);
    std::this_thread::sleep_until(start + std::chrono::duration_cast<Clock::duration>(due));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (is_ending_) return;
    }
    LivePeriod(n);
  }
}

void Sensor::LivePeriod(int64_t n) {
  const SensorPeriod period = PeriodOf(description_, n);
  // Without the lock: OpenNI2 has locks of its own, which it holds when it stops a stream.
  if (period.is_plugged != is_plugged_) on_plug_(period.is_plugged);
  is_plugged_ = period.is_plugged;
  if (!period.has_frame || period.is_lost) return;
  const int64_t device_us = (n + 1) * 1'000'000 / kSensorRate_hz + period.time_shift_us;
  const size_t image = static_cast<size_t>(n) % images_.depth.size();
  const SensorOutput output{images_.depth[image], images_.color, n,
                            static_cast<uint64_t>(device_us), period};
  const std::lock_guard<std::mutex> lock(mutex_);
  for (SensorStream* stream : started_) stream->Receive(output);
}

}  // namespace declutter
