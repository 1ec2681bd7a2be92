#include "modules/plane_filter/plane_filter.h"

#include "modules/geometry/marked_pixels.h"
#include "modules/plane_filter/object_pixels.h"
#include "modules/plane_filter/outlier_filter.h"
#include "modules/plane_filter/plane_search.h"
#include "modules/plane_filter/prism.h"
#include "modules/plane_filter/scene_roles.h"

namespace declutter {
namespace {

// Supports are refined on every n-th pixel: neighbours share most of their noise.
constexpr int kRefineStride = 2;

// Smallest connected region of a support, as part of the image: objects in front leave islands.
constexpr double kMinRegionPart = 0.001;

// The plane by least squares over its connected region in image, and that region.
PlaneCandidate Refine(const InverseDepth& image, const InversePlane& plane,
                      const PlaneFilterConfig& config) {
  const float sigma = static_cast<float>(config.inverse_depth_sigma());
  const float band = static_cast<float>(config.inlier_sigmas()) * sigma;
  const int min_region_pixels =
      static_cast<int>(config.min_plane_fraction() / 4 * static_cast<double>(image.values.size()));
  PlaneCandidate refined;
  refined.plane = plane;
  refined.region = CoherentRegion(image, plane, band, min_region_pixels);
  // Feet of objects are in the band on one side only; a narrower one leaves them out.
  for (const float sigmas : {2.5f, 2.0f, 2.0f}) {
    const auto fit = FitInliers(image, refined.region, refined.plane, sigmas * sigma);
    if (fit) refined.plane = *fit;
  }
  return refined;
}

std::vector<Eigen::Vector3f> HullInCamera(const Plane& plane,
                                          const std::vector<Eigen::Vector2d>& hull_T) {
  const Eigen::Isometry3d X_CT = TableFrame(plane).inverse();
  std::vector<Eigen::Vector3f> hull_C;
  for (const Eigen::Vector2d& p_T : hull_T) {
    hull_C.push_back((X_CT * Eigen::Vector3d(p_T.x(), p_T.y(), 0)).cast<float>());
  }
  return hull_C;
}

}  // namespace

PlaneFilter::PlaneFilter(const PlaneFilterConfig& config) : config_(config) {}

Tabletop PlaneFilter::Filter(const DepthFrame& frame) const {
  Tabletop tabletop;
  tabletop.header = frame.header;
  tabletop.objects.camera = frame.image.camera;
  tabletop.objects.depth_scale_m = frame.image.depth_scale_m;
  if (!frame.header.error.empty() || frame.image.empty()) return tabletop;
  tabletop.objects.counts.resize(frame.image.counts.size());

  const InverseDepth image = Invert(frame.image);
  const InverseDepth grid = Subsample(image, config_.sample_stride());
  const InverseDepth half = Subsample(image, kRefineStride);
  const std::vector<PlaneCandidate> candidates = FindPlanes(grid, config_);
  const SceneRoles roles = AssignRoles(grid, candidates, config_);
  std::vector<InversePlane> walls;
  for (const size_t wall : roles.walls) walls.push_back(candidates[wall].plane);
  PixelMask objects;
  for (const size_t index : roles.supports) {
    const PlaneCandidate support = Refine(half, candidates[index].plane, config_);
    const auto hull_T = HullInPlane(half, support.plane, support.region);
    if (hull_T.empty()) continue;
    const Plane plane = support.plane.ToPlane();
    tabletop.planes.push_back({plane, HullInCamera(plane, hull_T)});
    if (!objects.empty()) continue;
    const PixelMask standing = ObjectPixels(image, support.plane, hull_T, walls, config_);
    objects = RemoveOutliers(image, standing, config_);
  }
  ForEachMarked(objects.data(), 0, objects.size(), [&](size_t i) {
    tabletop.objects.counts[i] = frame.image.counts[i];
    ++tabletop.num_object_points;
  });
  return tabletop;
}

}  // namespace declutter
