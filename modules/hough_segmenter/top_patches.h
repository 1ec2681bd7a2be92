#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <utility>
#include <vector>

#include "modules/geometry/image_components.h"
#include "modules/geometry/reused_list.h"
#include "modules/geometry/tabletop.h"
#include "modules/hough_segmenter/height_bands.h"
#include "modules/hough_segmenter/planar_points.h"
#include "modules/hough_segmenter/table_points.h"

namespace declutter {

// A connected horizontal surface seen from above: the top face of an object. All in T.
struct TopPatch {
  int component = 0;
  float height = 0;                        // [m] median above the support plane
  float sigma = 0;                         // [m] standard deviation of a measurement on it
  PlanarPoints points;                     // [m] of all its pixels
  std::vector<Eigen::Vector2f> hull;       // [m] convex, counter-clockwise
  std::vector<Eigen::Vector2f> free_edge;  // [m] of its outline where the face ends; where the
                                           // outline is that of something in front, it does not
};

using TopPatches = ReusedList<TopPatch>;

// Finds top patches frame by frame, with memory that is used again.
class TopPatchFinder {
 public:
  // Patches of at least min_points points, in row-major order of their first pixels. Neighbouring
  // pixels whose heights differ by more than max_step_m belong to different patches. points are
  // those of the tabletop, in row-major order; X_TC is the pose of the camera in T. The result is
  // valid until the next call.
  const TopPatches& Find(const std::vector<TablePoint>& points, const Tabletop& tabletop,
                         const Eigen::Isometry3d& X_TC, float max_step_m, int min_points);

 private:
  void DrawPoints(const std::vector<TablePoint>& points, int thinning);
  void ErasePoints();
  // Draws the components of at least min_pixels pixels into labels_ and height_inside_.
  void DrawComponents(int min_pixels);
  void GrowOverRims();
  bool IsAtRim(size_t pixel) const;
  // Sets patches_ to those in labels_, without free edges and hulls, some of them empty.
  void GatherPatches(const std::vector<TablePoint>& points);
  void SetHull(TopPatch* patch);

  int columns_ = 0;
  int rows_ = 0;
  // Images; outside pixels_ nothing is marked or labelled.
  std::vector<uint8_t> is_top_;
  std::vector<uint8_t> is_point_;
  std::vector<int32_t> labels_;
  std::vector<float> heights_;        // [m] of points
  std::vector<float> height_inside_;  // [m] of labelled pixels: that of the face inside the rim
  std::vector<float> max_rim_step_;   // [m] of points: in height from the face inside
  std::vector<size_t> pixels_;        // of the points
  ComponentRuns components_;
  HeightBands bands_;
  std::vector<size_t> candidates_;                // that may join a patch
  std::vector<std::pair<size_t, size_t>> grown_;  // pixel, neighbour whose patch it joins
  TopPatches patches_;
  ReusedList<std::vector<float>> patch_heights_;
  std::vector<Eigen::Vector2d> outer_points_, hull_;
};

// Direction of a side of the smallest rectangle around the hull, a unit vector of the xy plane of
// T.
Eigen::Vector2f MinimumAreaAxis(const TopPatch& patch);

}  // namespace declutter
