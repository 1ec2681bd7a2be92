#pragma once

#include <Eigen/Core>
#include <vector>

#include "modules/geometry/depth_image.h"

// The image behind a point cloud. Points are in camera frame C [m]; what is not finite or not in
// front of the camera is no measurement. All functions throw std::runtime_error that says what is
// wrong.
namespace declutter {

// The camera that sees point i of an organised cloud in pixel (i % width, i / width): least squares
// of u against x / z and of v against y / z. Refuses clouds that no pinhole camera fits to within
// half a pixel rms.
PinholeCamera FitPinholeCamera(int width, int height, const std::vector<Eigen::Vector3f>& points);

// The pixel of each point of an organised cloud; -1 for those without a measurement.
std::vector<int> GridPixels(const std::vector<Eigen::Vector3f>& points);

// The pixel in which `camera` sees each point; -1 for those without a measurement, outside the
// image, or behind another point of the same pixel.
std::vector<int> ProjectedPixels(const PinholeCamera& camera,
                                 const std::vector<Eigen::Vector3f>& points);

// Depth of the points at their pixels (-1: none). Counts are whole millimetres when that is how the
// cloud was measured, or when it reaches beyond 6.5 m, else 0.1 mm.
DepthImage DepthOf(const PinholeCamera& camera, const std::vector<Eigen::Vector3f>& points,
                   const std::vector<int>& pixels);

}  // namespace declutter
