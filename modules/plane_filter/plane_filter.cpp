#include "modules/plane_filter/plane_filter.h"

#include <algorithm>

#include "modules/plane_filter/object_pixels.h"
#include "modules/plane_filter/outlier_filter.h"
#include "modules/plane_filter/plane_search.h"
#include "modules/plane_filter/prism.h"
#include "modules/plane_filter/support_choice.h"

namespace declutter {
namespace {

// The connected region of the plane on all pixels, and the plane by least squares over it.
PlaneCandidate Refine(const InverseDepth& image, const PlaneCandidate& candidate,
                      const PlaneFilterConfig& config) {
  const float sigma = static_cast<float>(config.inverse_depth_sigma());
  const float band = static_cast<float>(config.inlier_sigmas()) * sigma;
  const int min_region_pixels =
      static_cast<int>(config.min_plane_fraction() / 4 * static_cast<double>(image.values.size()));
  PlaneCandidate refined = candidate;
  refined.region =
      CoherentRegion(image, PlaneInliers(image, refined.plane, band), min_region_pixels);
  // Feet of objects are in the band on one side only; a narrower one leaves them out.
  for (const float sigmas : {2.5f, 2.0f, 2.0f}) {
    const auto plane = FitInliers(image, refined.region, refined.plane, sigmas * sigma);
    if (plane) refined.plane = *plane;
  }
  refined.region =
      CoherentRegion(image, PlaneInliers(image, refined.plane, band), min_region_pixels);
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
  const std::vector<PlaneCandidate> candidates = FindPlanes(grid, config_);
  PixelMask objects;
  for (const size_t index : ChooseSupports(grid, candidates, config_)) {
    const PlaneCandidate support = Refine(image, candidates[index], config_);
    const auto hull_T = HullInPlane(image, support.plane, support.region);
    if (hull_T.empty()) continue;
    const Plane plane = support.plane.ToPlane();
    tabletop.planes.push_back({plane, HullInCamera(plane, hull_T)});
    if (!objects.empty()) continue;
    const PixelMask standing =
        ObjectPixels(image, support.plane, hull_T, PixelMask(image.values.size()), config_);
    objects = RemoveOutliers(image, standing, config_);
  }
  for (size_t i = 0; i < objects.size(); ++i) {
    if (objects[i]) tabletop.objects.counts[i] = frame.image.counts[i];
  }
  tabletop.num_object_points = static_cast<int>(std::count(objects.begin(), objects.end(), 1));
  return tabletop;
}

}  // namespace declutter
