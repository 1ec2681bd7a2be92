#include "modules/synthetic_sensor/driver/stream.h"

#include <cmath>

namespace declutter {
namespace {

constexpr int kMaxDepthCount = 10000;

int BytesPerPixel(OniSensorType type) { return type == ONI_SENSOR_DEPTH ? 2 : 3; }

OniPixelFormat FormatOf(OniSensorType type, const Sensor& sensor) {
  if (type == ONI_SENSOR_COLOR) return ONI_PIXEL_FORMAT_RGB888;
  return sensor.images().depth.front().depth_scale_m < 0.0005 ? ONI_PIXEL_FORMAT_DEPTH_100_UM
                                                              : ONI_PIXEL_FORMAT_DEPTH_1_MM;
}

const PinholeCamera& CameraOf(const Sensor& sensor) { return sensor.images().depth.front().camera; }

bool IsSame(const OniVideoMode& a, const OniVideoMode& b) {
  return a.pixelFormat == b.pixelFormat && a.resolutionX == b.resolutionX &&
         a.resolutionY == b.resolutionY && a.fps == b.fps;
}

}  // namespace

std::vector<OniVideoMode> Stream::Modes(OniSensorType type, const Sensor& sensor) {
  const PinholeCamera& camera = CameraOf(sensor);
  const OniPixelFormat format = FormatOf(type, sensor);
  return {{format, camera.width, camera.height, kSensorRate_hz},
          {format, camera.width / 2, camera.height / 2, kSensorRate_hz}};
}

Stream::Stream(OniSensorType type, Sensor* sensor)
    : type_(type), sensor_(sensor), mode_(Modes(type, *sensor).front()) {}

Stream::~Stream() { stop(); }

OniStatus Stream::start() {
  is_started_ = true;
  sensor_->Start(this);
  return ONI_STATUS_OK;
}

void Stream::stop() {
  sensor_->Stop(this);
  is_started_ = false;
}

OniBool Stream::isPropertySupported(int id) {
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
    case ONI_STREAM_PROPERTY_CROPPING:
    case ONI_STREAM_PROPERTY_MIRRORING:
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
    case ONI_STREAM_PROPERTY_STRIDE:
      return TRUE;
    case ONI_STREAM_PROPERTY_MAX_VALUE:
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return type_ == ONI_SENSOR_DEPTH;
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
    case ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE:
      return type_ == ONI_SENSOR_COLOR;
    default:
      return FALSE;
  }
}

OniStatus Stream::getProperty(int id, void* data, int* size) {
  if (!isPropertySupported(id)) return ONI_STATUS_NOT_SUPPORTED;
  switch (id) {
    case ONI_STREAM_PROPERTY_VIDEO_MODE:
      return GetProperty(mode_, data, size);
    case ONI_STREAM_PROPERTY_CROPPING:
      return GetProperty(cropping_, data, size);
    case ONI_STREAM_PROPERTY_MIRRORING:
      return GetProperty(is_mirrored_, data, size);
    case ONI_STREAM_PROPERTY_HORIZONTAL_FOV:
    case ONI_STREAM_PROPERTY_VERTICAL_FOV:
      return GetProperty(FieldOfView(id == ONI_STREAM_PROPERTY_HORIZONTAL_FOV), data, size);
    case ONI_STREAM_PROPERTY_STRIDE:
      return GetProperty(Stride(), data, size);
    case ONI_STREAM_PROPERTY_MAX_VALUE:
      return GetProperty(kMaxDepthCount, data, size);
    case ONI_STREAM_PROPERTY_MIN_VALUE:
      return GetProperty(0, data, size);
    case ONI_STREAM_PROPERTY_AUTO_EXPOSURE:
      return GetProperty(auto_exposure_, data, size);
    default:
      return GetProperty(auto_white_balance_, data, size);
  }
}

OniStatus Stream::setProperty(int id, const void* data, int size) {
  if (!isPropertySupported(id)) return ONI_STATUS_NOT_SUPPORTED;
  if (is_started_) return ONI_STATUS_OUT_OF_FLOW;  // what Receive reads does not change under it
  OniStatus status = ONI_STATUS_NOT_SUPPORTED;
  if (id == ONI_STREAM_PROPERTY_VIDEO_MODE) {
    OniVideoMode mode{};
    status = SetProperty(data, size, &mode);
    return status == ONI_STATUS_OK ? SetMode(mode) : status;
  }
  if (id == ONI_STREAM_PROPERTY_CROPPING) {
    OniCropping cropping{};
    status = SetProperty(data, size, &cropping);
    return status == ONI_STATUS_OK ? SetCropping(cropping) : status;
  }
  if (id == ONI_STREAM_PROPERTY_MIRRORING) status = SetProperty(data, size, &is_mirrored_);
  if (id == ONI_STREAM_PROPERTY_AUTO_EXPOSURE) status = SetProperty(data, size, &auto_exposure_);
  if (id == ONI_STREAM_PROPERTY_AUTO_WHITE_BALANCE) {
    status = SetProperty(data, size, &auto_white_balance_);
  }
  if (status == ONI_STATUS_OK) Notify(id, data, size);
  return status;
}

OniStatus Stream::SetMode(const OniVideoMode& mode) {
  for (const OniVideoMode& supported : Modes(type_, *sensor_)) {
    if (!IsSame(supported, mode)) continue;
    mode_ = mode;
    cropping_ = {};
    notifyAllProperties();
    return ONI_STATUS_OK;
  }
  return ONI_STATUS_NOT_SUPPORTED;
}

OniStatus Stream::SetCropping(const OniCropping& cropping) {
  // OpenNI2 leaves the rest unset when cropping is switched off.
  const bool fits = cropping.enabled && cropping.originX >= 0 && cropping.originY >= 0 &&
                    cropping.width > 0 && cropping.height > 0 &&
                    cropping.originX + cropping.width <= mode_.resolutionX &&
                    cropping.originY + cropping.height <= mode_.resolutionY;
  if (cropping.enabled && !fits) return ONI_STATUS_BAD_PARAMETER;
  cropping_ = cropping.enabled ? cropping : OniCropping{};
  notifyAllProperties();
  return ONI_STATUS_OK;
}

int Stream::Stride() const { return Window().width * BytesPerPixel(type_); }

float Stream::FieldOfView(bool is_horizontal) const {
  const PinholeCamera& camera = CameraOf(*sensor_);
  const double tangent =
      is_horizontal ? 0.5 * camera.width / camera.fx : 0.5 * camera.height / camera.fy;
  return static_cast<float>(2 * std::atan(tangent));
}

ImageWindow Stream::Window() const {
  ImageWindow window;
  window.step = CameraOf(*sensor_).width / mode_.resolutionX;
  window.is_mirrored = is_mirrored_;
  window.width = cropping_.enabled ? cropping_.width : mode_.resolutionX;
  window.height = cropping_.enabled ? cropping_.height : mode_.resolutionY;
  if (cropping_.enabled) {
    window.x = cropping_.originX;
    window.y = cropping_.originY;
  }
  return window;
}

void Stream::Notify(int id, const void* data, int size) { raisePropertyChanged(id, data, size); }

// A recorder asks for them when it begins, and plays nothing without them.
void Stream::notifyAllProperties() {
  const float horizontal = FieldOfView(true), vertical = FieldOfView(false);
  const int stride = Stride(), min = 0, max = kMaxDepthCount;
  Notify(ONI_STREAM_PROPERTY_VIDEO_MODE, &mode_, sizeof(mode_));
  Notify(ONI_STREAM_PROPERTY_CROPPING, &cropping_, sizeof(cropping_));
  Notify(ONI_STREAM_PROPERTY_MIRRORING, &is_mirrored_, sizeof(is_mirrored_));
  Notify(ONI_STREAM_PROPERTY_HORIZONTAL_FOV, &horizontal, sizeof(horizontal));
  Notify(ONI_STREAM_PROPERTY_VERTICAL_FOV, &vertical, sizeof(vertical));
  Notify(ONI_STREAM_PROPERTY_STRIDE, &stride, sizeof(stride));
  if (type_ != ONI_SENSOR_DEPTH) return;
  Notify(ONI_STREAM_PROPERTY_MIN_VALUE, &min, sizeof(min));
  Notify(ONI_STREAM_PROPERTY_MAX_VALUE, &max, sizeof(max));
}

void Stream::Receive(const SensorOutput& output) {
  OniFrame* frame = getServices().acquireFrame();
  if (frame == nullptr) return;
  const ImageWindow window = Window();
  frame->sensorType = type_;
  frame->videoMode = mode_;
  frame->timestamp = output.device_us;
  frame->frameIndex = static_cast<int>(output.n + 1);
  frame->width = window.width;
  frame->height = window.height;
  frame->croppingEnabled = cropping_.enabled;
  frame->cropOriginX = window.x;
  frame->cropOriginY = window.y;
  frame->stride = Stride();
  frame->dataSize = frame->stride * window.height;
  if (type_ == ONI_SENSOR_DEPTH) {
    CopyDepth(output.depth, window, static_cast<uint16_t*>(frame->data));
    if (output.period.is_zero) std::memset(frame->data, 0, static_cast<size_t>(frame->dataSize));
  } else {
    CopyColor(output.color, window, static_cast<uint8_t*>(frame->data));
  }
  if (output.period.is_corrupt) frame->dataSize /= 3;
  raiseNewFrame(frame);
  getServices().releaseFrame(frame);
}

}  // namespace declutter
