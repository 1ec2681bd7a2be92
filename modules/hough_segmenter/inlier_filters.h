#pragma once

#include <vector>

#include "modules/hough_segmenter/ransac_fits.h"

namespace declutter {

// The filters of section 5. Each keeps or clears the inliers of a fit; indices are into `cells`.

// Line: inliers form one cluster along the line without a gap over max_gap_m. In paper mode a fit
// of several clusters is rejected, else the one with the most points is kept.
void KeepOneRun(const std::vector<SideCell>& cells, float max_gap_m, FeatureMode mode,
                LineFit* fit);

// Circle: inliers are at the same height; those of another height are dropped.
void KeepOneHeight(const std::vector<SideCell>& cells, float max_gap_m, CircleFit* fit);

// Circle: at most `max_arcs` clusters of inliers, two in the paper; the heaviest stay. Sets the
// model's arc.
void KeepArcs(const std::vector<SideCell>& cells, float max_gap_m, size_t max_arcs, CircleFit* fit);

// Circle: a cylinder on a wider one has inliers at another distance from the axis above some
// height. Where the mean distances below and above differ by more than max_step_m, the part with
// more points stays.
void KeepOneRadius(const std::vector<SideCell>& cells, float max_step_m, CircleFit* fit);

// Paper mode: keeps inliers whose curvature is that of a flat (line) or round (circle) surface, and
// for circles those whose minimum radius is within max_radius_difference_m of the circle's.
void KeepFlat(const std::vector<SideCell>& cells, float max_curvature, LineFit* fit);
void KeepRound(const std::vector<SideCell>& cells, float max_curvature,
               float max_radius_difference_m, CircleFit* fit);

// [1/m] weighted median of the horizontal curvature of the inliers.
float MedianKappa(const std::vector<SideCell>& cells, const std::vector<int>& inliers);

// Sum of the weights of the inliers [px].
float NumPoints(const std::vector<SideCell>& cells, const std::vector<int>& inliers);

}  // namespace declutter
