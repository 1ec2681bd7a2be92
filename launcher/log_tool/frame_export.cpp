#include "launcher/log_tool/frame_export.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "launcher/log_tool/decoded_frames.h"
#include "modules/frame_views/contact_sheet.h"
#include "modules/frame_views/point_cloud.h"
#include "modules/frame_views/top_view.h"
#include "modules/imaging/png_file.h"
#include "modules/object_exporter/feature_pictures.h"
#include "modules/object_exporter/overlay.h"
#include "modules/object_exporter/picture_names.h"
#include "modules/object_exporter/sensor_size.h"

namespace declutter::log_tool {
namespace {

namespace fs = std::filesystem;

template <typename Part>
const Part* PointerTo(const std::optional<Part>& part) {
  return part ? &*part : nullptr;
}

// Where the files of an export go, and how many there are.
class Folder {
 public:
  explicit Folder(const std::string& path) : path_(path) {
    std::error_code error;
    fs::create_directories(path_, error);
    if (!fs::is_directory(path_)) {
      throw std::runtime_error(path + ": " + (error ? error.message() : "is not a folder"));
    }
  }

  void WritePicture(const std::string& name, const ColorImage& image) {
    imaging::WriteRgbPng(path_ / name, image);
    ++num_files_;
  }

  void WriteFile(const std::string& name, const std::string& bytes) {
    const fs::path path = path_ / name;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << bytes << std::flush;
    if (!file) {
      const std::string cause = std::system_category().message(errno);
      file.close();
      std::error_code ignored;
      fs::remove(path, ignored);
      throw std::runtime_error(path.string() + ": " + cause);
    }
    ++num_files_;
  }

  int num_files() const { return num_files_; }

 private:
  fs::path path_;
  int num_files_ = 0;
};

// Objects where there are none: what is known of the frame besides.
ObjectList ObjectsOf(const DecodedFrame& frame) {
  if (frame.objects) return *frame.objects;
  ObjectList list;
  list.header = frame.header;
  if (frame.depth) list.camera = frame.depth->image.camera;
  list.labels.resize(static_cast<size_t>(list.camera.num_pixels()));
  return list;
}

void WriteOverlay(const DecodedFrame& frame, const std::string& name, Folder* folder,
                  ContactSheet* sheet, const std::function<void(const ColorImage&)>& write_page) {
  const PicturedFrame shown = AtSensorSize(ObjectsOf(frame), PointerTo(frame.depth));
  if (shown.list.camera.num_pixels() == 0) return;
  const ColorImage overlay =
      DrawOverlay(shown.list, PointerTo(shown.depth), PointerTo(frame.color));
  folder->WritePicture(name + ".overlay.png", overlay);
  if (const auto page = sheet->Add(name, overlay)) write_page(*page);
}

void WriteTopView(const DecodedFrame& frame, const std::string& name, Folder* folder) {
  const ColorImage top = DrawTopView(
      {PointerTo(frame.tabletop), PointerTo(frame.hypotheses), PointerTo(frame.objects)});
  if (top.width > 0) folder->WritePicture(name + ".top.png", top);
}

void WriteFeatures(const DecodedFrame& frame, const std::string& name, Folder* folder) {
  if (!frame.features || frame.features->width == 0) return;
  const auto decimation = frame.depth ? frame.depth->decimation : std::nullopt;
  const FeaturePictures pictures = DrawFeatures(*frame.features, decimation);
  folder->WritePicture(name + ".curvature.png", pictures.curvature);
  folder->WritePicture(name + ".r_min.png", pictures.r_min);
}

// Calls write for every frame that has an image, with a name of its own.
int ForEachFrame(const std::string& log, const launcher::Excerpt& part,
                 const std::function<void(const DecodedFrame&, const std::string& name)>& write) {
  DecodedFrames frames(log, part);
  PictureNames names;
  while (const auto frame = frames.Next()) {
    if (frame->header.error.empty()) {
      write(*frame, names.NewFor(frame->header.frame));
    } else {
      std::cerr << "log_tool: frame " << frame->header.frame
                << " has no image: " << frame->header.error << "\n";
    }
  }
  for (const std::string& fault : frames.Faults()) std::cerr << "log_tool: " << fault << "\n";
  return frames.Faults().empty() ? 0 : 1;
}

int Finish(int code, const Folder& folder, const std::string& log) {
  if (folder.num_files() == 0) throw std::runtime_error(log + ": has nothing to show");
  std::cout << folder.num_files() << " files\n" << std::flush;
  return code;
}

}  // namespace

int WritePictures(const std::string& log, const std::string& path, const launcher::Excerpt& part) {
  Folder folder(path);
  ContactSheet sheet({});
  int num_pages = 0;
  const auto write_page = [&](const ColorImage& page) {
    folder.WritePicture("contact_sheet_" + std::to_string(++num_pages) + ".png", page);
  };
  const int code = ForEachFrame(log, part, [&](const DecodedFrame& frame, const std::string& name) {
    WriteOverlay(frame, name, &folder, &sheet, write_page);
    WriteTopView(frame, name, &folder);
    WriteFeatures(frame, name, &folder);
  });
  if (const auto page = sheet.TakeRest()) write_page(*page);
  return Finish(code, folder, log);
}

int WriteClouds(const std::string& log, const std::string& path, const launcher::Excerpt& part) {
  constexpr double kSpacing_m = 0.003;
  Folder folder(path);
  const int code = ForEachFrame(log, part, [&](const DecodedFrame& frame, const std::string& name) {
    if (frame.depth && !frame.depth->image.empty()) {
      const PointCloud cloud =
          MeasuredCloud(frame.depth->image, PointerTo(frame.color), PointerTo(frame.objects));
      folder.WriteFile(name + ".pcd", PcdFile(cloud));
    }
    if (frame.objects) {
      folder.WriteFile(name + ".models.pcd", PcdFile(ModelCloud(*frame.objects, kSpacing_m)));
    }
  });
  return Finish(code, folder, log);
}

}  // namespace declutter::log_tool
