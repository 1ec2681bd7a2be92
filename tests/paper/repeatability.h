#pragma once

#include <map>
#include <vector>

#include "tests/paper/method.h"

namespace declutter::experiments {

// Mean absolute error and standard deviation over the runs, averaged over the objects [mm].
struct ErrorAndSpread {
  double mean_mm = 0;
  double sd_mm = 0;
};

// Repeated measurements of the core objects of one scene (Table 2).
class Repeatability {
 public:
  void Add(const PreparedFrame& frame, const Result& result);

  // Width is the horizontal extent of a box that lies more across the line of sight, depth the
  // other. The centre of a cylinder counts across its axis. Objects that are found once or never,
  // or less than half visible, do not count.
  ErrorAndSpread BoxWidth() const;
  ErrorAndSpread BoxDepth() const;
  ErrorAndSpread CylinderRadius() const;
  ErrorAndSpread CylinderCentre() const;

  int num_right = 0;   // models of core objects, over all runs
  int num_wanted = 0;  // core objects, over all runs
  int num_false = 0;   // false models, over all runs
  // [m] largest difference between two runs in any of these measures of an object.
  double LargestRangeM() const;

 private:
  using Errors = std::map<size_t, std::vector<Eigen::Vector3d>>;  // [m] of each object, by run
  static ErrorAndSpread Average(const Errors& errors);

  Errors width_;
  Errors depth_;
  Errors radius_;
  Errors centre_;
};

}  // namespace declutter::experiments
