#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>

#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/object_exporter/object_exporter.pb.h"
#include "modules/object_exporter/picture_names.h"

namespace declutter {

// Writes what was found to a folder: a line of objects.jsonl for each frame, and for frames with an
// image <frame>.labels.png and <frame>.overlay.png, all at the size of the sensor's image; with
// feature_pictures also <frame>.curvature.png and <frame>.r_min.png.
class ObjectExporter {
 public:
  // Creates the folder and begins objects.jsonl anew. Throws std::runtime_error that names the
  // folder or file when that is not possible.
  explicit ObjectExporter(const ObjectExporterConfig& config);

  // What pictures show; the most recent ones are kept until their objects come.
  void AddDepth(const DepthFrame& frame);
  void AddColor(int64_t utime, const ColorImage& image);
  void AddFeatures(const FeatureCloud& features);

  // Writes pictures and line of a frame. One that was written already is left as it is. Throws
  // std::runtime_error that names the file that cannot be written; the line is written even when
  // a picture is not.
  void Export(const ObjectList& list);

 private:
  bool IsNew(const FrameHeader& header);
  void WritePictures(const ObjectList& list, const std::string& picture_name) const;
  void WriteLine(const std::string& line);

  std::filesystem::path output_;
  bool pictures_ = true;
  bool feature_pictures_ = false;
  std::ofstream lines_;
  std::uintmax_t num_bytes_ = 0;  // of complete lines
  std::map<int64_t, DepthFrame> depths_;
  std::map<int64_t, ColorImage> colors_;
  std::map<int64_t, FeatureCloud> features_;
  std::deque<std::pair<int64_t, std::string>> written_;  // utime and name of the latest frames
  PictureNames picture_names_;
};

}  // namespace declutter
