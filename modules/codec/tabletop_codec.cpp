#include <cstdint>

#include "modules/codec/depth_image_parts.h"
#include "modules/codec/thinning.h"

namespace declutter::codec {
namespace {

std::vector<uint16_t> Thinned(const DepthImage& image, int step) {
  std::vector<uint16_t> counts(image.counts.size(), 0);
  const auto width = static_cast<size_t>(image.camera.width);
  const auto height = static_cast<size_t>(image.camera.height);
  const auto stride = static_cast<size_t>(step);
  for (size_t v = 0; v < height; v += stride) {
    for (size_t u = 0; u < width; u += stride) counts[v * width + u] = image.counts[v * width + u];
  }
  return counts;
}

int CountMeasured(const std::vector<uint16_t>& counts) {
  int num = 0;
  for (const uint16_t count : counts) num += count != 0;
  return num;
}

void WriteHull(const std::vector<Eigen::Vector3f>& hull, tabletop_t* message) {
  message->hull_size.push_back(static_cast<int32_t>(hull.size()));
  for (const Eigen::Vector3f& p_C : hull) {
    message->hull_x.push_back(p_C.x());
    message->hull_y.push_back(p_C.y());
    message->hull_z.push_back(p_C.z());
  }
  message->num_hull_points = static_cast<int32_t>(message->hull_x.size());
}

Eigen::Vector3f ReadHullPoint(const tabletop_t& message, size_t i) {
  Finite({"hull_x", i}, message.hull_x[i]);
  Finite({"hull_y", i}, message.hull_y[i]);
  Finite({"hull_z", i}, message.hull_z[i]);
  return {message.hull_x[i], message.hull_y[i], message.hull_z[i]};
}

std::vector<SupportPlane> ReadSupportPlanes(const tabletop_t& message) {
  const std::vector<Plane> planes = ReadPlanes(message);
  CheckLength("hull_size", message.hull_size, "num_planes", message.num_planes);
  CheckLength("hull_x", message.hull_x, "num_hull_points", message.num_hull_points);
  CheckLength("hull_y", message.hull_y, "num_hull_points", message.num_hull_points);
  CheckLength("hull_z", message.hull_z, "num_hull_points", message.num_hull_points);
  std::vector<SupportPlane> supports;
  size_t begin = 0;
  for (size_t i = 0; i < planes.size(); ++i) {
    const int32_t size = message.hull_size[i];
    Check(size >= 0 && static_cast<size_t>(size) <= message.hull_x.size() - begin, {"hull_size", i},
          size, "must not be negative nor exceed num_hull_points");
    const size_t end = begin + static_cast<size_t>(size);
    SupportPlane support{planes[i], {}};
    for (; begin < end; ++begin) support.hull.push_back(ReadHullPoint(message, begin));
    supports.push_back(std::move(support));
  }
  Check(begin == message.hull_x.size(), "num_hull_points", message.num_hull_points,
        "is not the sum of hull_size");
  return supports;
}

void CheckThinned(const DepthImage& image, int step) {
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      Check(image.CountAt(u, v) == 0 || IsKept(u, v, step), "thinning", step,
            "there are pixels that it would have dropped");
    }
  }
}

}  // namespace

tabletop_t Encode(const Tabletop& tabletop) {
  DemandConsistent(tabletop.header, tabletop.objects);
  tabletop_t message{};
  WriteHeader(tabletop.header, &message);
  WriteCamera(tabletop.objects.camera, &message);
  for (const SupportPlane& support : tabletop.planes) {
    AppendPlane(support.plane, &message);
    WriteHull(support.hull, &message);
  }
  message.num_object_points =
      tabletop.thinning == 1 ? CountMeasured(tabletop.objects.counts) : tabletop.num_object_points;
  const auto write = [&tabletop](int step, tabletop_t* out) {
    const DepthImage& objects = tabletop.objects;
    if (step == 1) return WriteDepth(objects.depth_scale_m, objects.counts, out);
    WriteDepth(objects.depth_scale_m, Thinned(objects, step), out);
  };
  ThinUntilFitting(tabletop.thinning, write, &message);
  return Fitting(std::move(message));
}

Tabletop Decode(const tabletop_t& message) {
  Tabletop tabletop;
  tabletop.header = ReadHeader(message);
  tabletop.planes = ReadSupportPlanes(message);
  tabletop.objects = ReadDepthImage(message);
  tabletop.thinning = CheckThinning(message.thinning);
  if (tabletop.thinning > 1) CheckThinned(tabletop.objects, tabletop.thinning);
  tabletop.num_object_points = message.num_object_points;
  const int num_kept = CountMeasured(tabletop.objects.counts);
  Check(tabletop.thinning == 1 ? message.num_object_points == num_kept
                               : message.num_object_points >= num_kept,
        "num_object_points", message.num_object_points, "is not the number before thinning");
  return tabletop;
}

}  // namespace declutter::codec
