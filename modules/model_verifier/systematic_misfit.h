#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "modules/geometry/solid.h"
#include "modules/model_verifier/ray_casting.h"

namespace declutter {

// [m] rms of the mean distances of points from the side of a solid, strip by upright strip: noise
// averages out in them, what is left tells a flat side from a round one. Of a box, the side with
// the most points. 0 where too few points lie on it. points_O are measured points on the surface in
// its frame.
double SystematicMisfit(const Solid& solid, const std::vector<Eigen::Vector3d>& points_O);

// [m] the same of a cylinder, layer by layer: a body with a waist or a shoulder is none.
double LayerMisfit(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O);

// [m] along z of O: where the radius of a cylinder's side changes most, between its ends. Nothing
// when too few points lie on either part.
std::optional<double> StepOf(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O);

// Share of what speaks for a solid that a misfit of so many sigma of the sensor's noise takes.
double MisfitShare(double misfit_sigmas);

// The same of the systematic misfit of what a solid explains; where too little of its side is seen
// to tell, of its outline. points_O is a buffer.
double MisfitShareOf(const Solid& solid, const RayEvidence& evidence,
                     const Observation& observation, std::vector<Eigen::Vector3d>* points_O);

// Growth of the radius of a cylinder's side with height.
struct Taper {
  double slope = 0;
  double sd = 0;  // standard deviation of the slope
};

// Of the points on the side, each with noise sigma [m] that it shares with its neighbours; 0 where
// they cover too little of its height to tell.
Taper TaperOf(const Solid& cylinder, const std::vector<Eigen::Vector3d>& points_O, double sigma);

}  // namespace declutter
