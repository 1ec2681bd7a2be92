#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/accuracy/scored_frame.h"

namespace declutter::accuracy {

// Objects and models of one shape.
struct ShapeCount {
  int num_core = 0;        // core objects
  int num_found = 0;       // core objects with a match: the right models
  int num_false = 0;       // models that are false
  int num_soft = 0;        // soft objects
  int num_soft_found = 0;  // soft objects with a match

  double Recall() const;     // 1 when nothing was to be found
  double Precision() const;  // 1 when nothing was reported
  ShapeCount& operator+=(const ShapeCount& other);
};
using ShapeCounts = std::array<ShapeCount, 2>;  // by Shape

struct GroupCount {
  int num_frames = 0;
  int num_neutral = 0;  // models that count neither way
  ShapeCounts shapes;
};

// How errors spread; in the unit of the errors.
struct Spread {
  size_t num = 0;
  double median = 0;      // signed
  double mean = 0;        // signed
  double sd = 0;          // standard deviation
  double median_abs = 0;  // of the absolute errors
  double p90_abs = 0;
};
Spread SpreadOf(const std::vector<double>& errors);

// A named list of errors, in the order of printing. Names carry the unit.
using ErrorTable = std::vector<std::pair<std::string, std::vector<double>>>;

struct RecallBin {
  std::string name;
  std::array<int, 2> num_core{};  // by Shape
  std::array<int, 2> num_found{};
};

struct Summary {
  std::map<std::string, GroupCount> groups;
  GroupCount total;
  std::vector<std::string> without_result;  // frames
  ErrorTable errors;                        // of right models
  std::optional<double> median_iou;         // of right models, when any is labelled
  std::vector<RecallBin> by_distance;
  std::vector<RecallBin> by_visible_fraction;
  int num_exact = 0;         // core objects of exactly known pose and size
  int num_within_20_mm = 0;  // those with a match whose centre and extents are within 20 mm
  int num_estimates = 0;     // parameters of right models with a standard deviation and exact truth
  int num_in_interval = 0;   // those whose true value lies inside the 95 % interval
};
Summary Summarize(const std::vector<ScoredFrame>& frames);

}  // namespace declutter::accuracy
