#include "modules/object_exporter/object_exporter.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <system_error>

#include "modules/imaging/png_file.h"
#include "modules/object_exporter/feature_pictures.h"
#include "modules/object_exporter/object_line.h"
#include "modules/object_exporter/overlay.h"
#include "modules/object_exporter/sensor_size.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;

// At 30 Hz, half a second of images.
constexpr size_t kMaxImages = 16;
// A frame is sent again at once or never.
constexpr size_t kMaxWritten = 256;

template <typename Image>
void Keep(int64_t utime, const Image& image, std::map<int64_t, Image>* images) {
  (*images)[utime] = image;
  if (images->size() > kMaxImages) images->erase(images->begin());
}

template <typename Image>
const Image* Find(int64_t utime, const std::map<int64_t, Image>& images) {
  const auto found = images.find(utime);
  return found == images.end() ? nullptr : &found->second;
}

}  // namespace

ObjectExporter::ObjectExporter(const ObjectExporterConfig& config)
    : output_(config.output()),
      pictures_(config.pictures()),
      feature_pictures_(config.pictures() && config.feature_pictures()) {
  std::error_code error;
  fs::create_directories(output_, error);
  if (!fs::is_directory(output_)) {
    throw std::runtime_error(output_.string() + ": " +
                             (error ? error.message() : "is not a folder"));
  }
  const fs::path path = output_ / "objects.jsonl";
  lines_.open(path, std::ios::binary | std::ios::trunc);
  if (!lines_) throw std::runtime_error(path.string() + ": " + std::strerror(errno));
}

void ObjectExporter::AddDepth(const DepthFrame& frame) {
  if (pictures_ && !frame.image.empty()) Keep(frame.header.utime, frame, &depths_);
}

void ObjectExporter::AddColor(int64_t utime, const ColorImage& image) {
  if (pictures_) Keep(utime, image, &colors_);
}

void ObjectExporter::AddFeatures(const FeatureCloud& features) {
  if (feature_pictures_ && features.width > 0) Keep(features.header.utime, features, &features_);
}

void ObjectExporter::Export(const ObjectList& list) {
  if (!IsNew(list.header)) return;
  std::string picture_name;
  std::string picture_error;
  if (pictures_ && list.header.error.empty() && list.camera.num_pixels() > 0) {
    picture_name = picture_names_.NewFor(list.header.frame);
    try {
      WritePictures(list, picture_name);
    } catch (const std::runtime_error& error) {
      picture_name.clear();
      picture_error = error.what();
    }
  }
  WriteLine(ObjectLine(list, picture_name));
  if (!picture_error.empty()) throw std::runtime_error(picture_error);
}

bool ObjectExporter::IsNew(const FrameHeader& header) {
  const std::pair<int64_t, std::string> key(header.utime, header.frame);
  if (std::find(written_.begin(), written_.end(), key) != written_.end()) return false;
  written_.push_back(key);
  if (written_.size() > kMaxWritten) written_.pop_front();
  return true;
}

void ObjectExporter::WritePictures(const ObjectList& list, const std::string& picture_name) const {
  const fs::path path = output_ / picture_name;
  const DepthFrame* depth = Find(list.header.utime, depths_);
  const PicturedFrame shown = AtSensorSize(list, depth);
  imaging::WriteGray8Png(path.string() + ".labels.png",
                         {shown.list.camera.width, shown.list.camera.height, shown.list.labels});
  imaging::WriteRgbPng(path.string() + ".overlay.png",
                       DrawOverlay(shown.list, shown.depth ? &*shown.depth : nullptr,
                                   Find(list.header.utime, colors_)));
  if (const FeatureCloud* features = Find(list.header.utime, features_)) {
    const auto decimation = depth != nullptr ? depth->decimation : std::nullopt;
    const FeaturePictures pictures = DrawFeatures(*features, decimation);
    imaging::WriteRgbPng(path.string() + ".curvature.png", pictures.curvature);
    imaging::WriteRgbPng(path.string() + ".r_min.png", pictures.r_min);
  }
}

void ObjectExporter::WriteLine(const std::string& line) {
  const fs::path path = output_ / "objects.jsonl";
  errno = 0;
  lines_ << line << '\n' << std::flush;
  if (lines_) {
    num_bytes_ += line.size() + 1;
    return;
  }
  const std::string cause = errno != 0 ? std::strerror(errno) : "cannot be written";
  // What was written of the line would spoil the next one.
  lines_.close();
  std::error_code ignored;
  fs::resize_file(path, num_bytes_, ignored);
  lines_.clear();
  lines_.open(path, std::ios::binary | std::ios::app);
  throw std::runtime_error(path.string() + ": " + cause);
}

}  // namespace declutter
