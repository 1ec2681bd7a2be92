#include "modules/plane_filter/plane_filter.h"

#include <algorithm>
#include <utility>

#include "modules/geometry/for_each_processor.h"
#include "modules/plane_filter/independent_noise.h"

namespace declutter {
namespace {

// Supports are refined on every n-th pixel: neighbours share most of their noise.
constexpr int kRefineStride = 2;

// Noise of an image in that of the sensor it is made for: with more it shows no plane.
constexpr double kMaxNoise = 10;

void MoveToCamera(const Plane& plane, const std::vector<Eigen::Vector2d>& hull_T,
                  std::vector<Eigen::Vector3f>* hull_C) {
  const Eigen::Isometry3d X_CT = TableFrame(plane).inverse();
  hull_C->clear();
  for (const Eigen::Vector2d& p_T : hull_T) {
    hull_C->push_back((X_CT * Eigen::Vector3d(p_T.x(), p_T.y(), 0)).cast<float>());
  }
}

// Copies marked counts, leaves 0 for the others, and returns how many are marked.
DECLUTTER_FOR_EACH_PROCESSOR int CopyMarked(const uint16_t* counts, const uint8_t* marked,
                                            size_t num, uint16_t* copies) {
  int num_marked = 0;
  for (size_t i = 0; i < num; ++i) {
    copies[i] = marked[i] > 0 ? counts[i] : uint16_t{0};
    num_marked += marked[i];
  }
  return num_marked;
}

}  // namespace

PlaneFilter::PlaneFilter(const PlaneFilterConfig& config)
    : config_(config),
      search_(config),
      roles_(config),
      object_pixels_(config),
      outlier_filter_(config) {}

// Where the plane is coherent in half_.
const PixelMask& PlaneFilter::RegionOf(const InversePlane& plane) {
  const float band = static_cast<float>(config_.inlier_sigmas()) * static_cast<float>(sigma_);
  const int min_region_pixels =
      static_cast<int>(config_.min_plane_fraction() / 4 * static_cast<double>(half_.values.size()));
  inliers_ = PlaneInliers(half_, plane, band, std::move(inliers_));
  return region_.Find(half_, plane, inliers_, band, min_region_pixels);
}

// The plane by least squares over its region.
InversePlane PlaneFilter::Refine(const InversePlane& plane, const PixelMask& region) const {
  InversePlane refined = plane;
  // Feet of objects are in the band on one side only; a narrower one leaves them out.
  for (const float sigmas : {2.5f, 2.0f, 2.0f}) {
    const float band = sigmas * static_cast<float>(sigma_);
    const auto fit = FitInliers(half_, &region, refined, band);
    if (fit) refined = *fit;
  }
  return refined;
}

void PlaneFilter::KeepObjects(const DepthImage& image, const PixelMask& objects) {
  tabletop_.num_object_points = CopyMarked(image.counts.data(), objects.data(), objects.size(),
                                           tabletop_.objects.counts.data());
}

void PlaneFilter::FindTabletop(const DepthImage& image) {
  image_ = Invert(image, std::move(image_));
  sigma_ = std::clamp(IndependentNoise(image_, &differences_), config_.inverse_depth_sigma(),
                      kMaxNoise * config_.inverse_depth_sigma());
  grid_ = Subsample(image_, config_.sample_stride(), std::move(grid_));
  half_ = Subsample(image_, kRefineStride, std::move(half_));
  const PlaneCandidates& candidates = search_.Find(grid_, sigma_);
  roles_.Assign(grid_, candidates, sigma_);
  std::vector<SupportPlane>& planes = tabletop_.planes;
  std::vector<uint16_t>& counts = tabletop_.objects.counts;
  size_t num_planes = 0;
  for (const size_t index : roles_.supports()) {
    const InversePlane& candidate = candidates.planes[index].plane;
    const PixelMask& region = RegionOf(candidate);
    const InversePlane support = Refine(candidate, region);
    const auto& hull_T = hull_.Find(half_, support, region, 1);
    if (hull_T.empty()) continue;
    if (num_planes == planes.size()) planes.emplace_back();
    planes[num_planes].plane = support.ToPlane();
    MoveToCamera(planes[num_planes].plane, hull_T, &planes[num_planes].hull);
    if (num_planes++ > 0) continue;
    const PixelMask& standing =
        object_pixels_.Find(image_, support, hull_T, roles_.walls(), sigma_);
    KeepObjects(image, outlier_filter_.Filter(image_, standing));
  }
  planes.resize(num_planes);
  if (planes.empty()) std::fill(counts.begin(), counts.end(), uint16_t{0});
}

const Tabletop& PlaneFilter::Filter(const DepthFrame& frame) & {
  tabletop_.header = frame.header;
  tabletop_.objects.camera = frame.image.camera;
  tabletop_.objects.depth_scale_m = frame.image.depth_scale_m;
  tabletop_.num_object_points = 0;
  if (!frame.header.error.empty() || frame.image.empty()) {
    tabletop_.objects.counts.clear();
    tabletop_.planes.clear();
    return tabletop_;
  }
  tabletop_.objects.counts.resize(frame.image.counts.size());
  FindTabletop(frame.image);
  return tabletop_;
}

}  // namespace declutter
