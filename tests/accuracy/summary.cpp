#include "tests/accuracy/summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "tests/accuracy/solid_comparison.h"

namespace declutter::accuracy {
namespace {

constexpr double kMaxErrorM = 0.020;
constexpr double kMmPerM = 1000;
constexpr double kDegreesPerRad = 180 / M_PI;

// Value below which the given share of the sorted values lies, interpolated.
double Quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<size_t>(place);
  const size_t high = std::min(low + 1, sorted.size() - 1);
  const double rest = place - static_cast<double>(low);
  return (1 - rest) * sorted[low] + rest * sorted[high];
}

void Add(ErrorTable* table, const std::string& name, double error) {
  for (auto& [known, errors] : *table) {
    if (known == name) {
      errors.push_back(error);
      return;
    }
  }
  table->push_back({name, {error}});
}

bool IsObserved(const ObjectModel& model, int axis) {
  return model.evidence[static_cast<size_t>(axis)] == Evidence::kObserved;
}

// For each axis of the model's box the true extent beside it, longest first 0, 1, 2: the axes that
// a size belongs to are not known, so it is the pairing of least total error, of observed extents
// before all others.
std::array<size_t, 3> PairExtents(const ObjectModel& model,
                                  const std::array<double, 3>& true_size) {
  constexpr double kWeightOfObserved = 1000;
  std::array<size_t, 3> order{0, 1, 2};
  std::array<size_t, 3> best = order;
  double best_sum = std::numeric_limits<double>::max();
  do {
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double error = model.solid.size[axis] - true_size[order[static_cast<size_t>(axis)]];
      sum += std::abs(error) * (IsObserved(model, axis) ? kWeightOfObserved : 1);
    }
    if (sum < best_sum) {
      best_sum = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

void AddExtent(ErrorTable* table, const std::string& name, double error_m, bool observed) {
  Add(table, name + " mm", kMmPerM * error_m);
  if (observed) Add(table, name + " observed mm", kMmPerM * error_m);
}

// Stands for 140 of the 170 degrees of a cylinder's side that face a camera, seen by enough pixels:
// this share of all its pixels. Only known of rendered ones.
bool IsWellSeen(const TrueObject& object) {
  constexpr int kMinPx = 1500;
  constexpr double kMinFraction = 140.0 / 170;
  return object.num_px.value_or(0) >= kMinPx && object.visible_fraction.value_or(0) >= kMinFraction;
}

void AddSizeErrors(const ObjectModel& model, const TrueObject& object, ErrorTable* table) {
  constexpr double kWellKnown = 0.004;  // [m] tolerance of a product's size
  const Eigen::Vector3d& size = model.solid.size;
  const Eigen::Vector3d& true_size = *object.size;
  if (model.solid.shape == Shape::kCylinder) {
    const double error_mm = kMmPerM * 0.5 * (size.x() - true_size.x());
    Add(table, "cylinder radius mm", error_mm);
    if (IsWellSeen(object)) {
      Add(table, "cylinder radius well seen mm", error_mm);
    } else if (object.radius_bound_m) {
      Add(table, "cylinder radius partly seen, bounds",
          error_mm / (kMmPerM * *object.radius_bound_m));
    }
    if (object.size_tolerance_m && *object.size_tolerance_m <= kWellKnown) {
      Add(table, "cylinder radius well known mm", error_mm);
    }
    AddExtent(table, "cylinder height", size.z() - true_size.z(), IsObserved(model, 2));
    return;
  }
  static const char* const kNames[] = {"box long", "box middle", "box short"};
  std::array<double, 3> sorted = {true_size.x(), true_size.y(), true_size.z()};
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const std::array<size_t, 3> pairing = PairExtents(model, sorted);
  for (int axis = 0; axis < 3; ++axis) {
    const size_t beside = pairing[static_cast<size_t>(axis)];
    const double error = size[axis] - sorted[beside];
    AddExtent(table, kNames[beside], error, IsObserved(model, axis));
    AddExtent(table, "box extents", error, IsObserved(model, axis));
    if (axis == 2 && !object.solid) {
      AddExtent(table, "box height", error, IsObserved(model, axis));
    }
  }
}

void AddPoseErrors(const ObjectModel& model, const SolidError& error, ErrorTable* table) {
  const std::string shape = ShapeName(model.solid.shape);
  Add(table, shape + " centre mm", kMmPerM * error.center_C.norm());
  Add(table, shape + " axis deg", kDegreesPerRad * error.axis_rad);
  Add(table, shape + " volume, 1 - IoU", 1 - error.volume_iou);
  if (model.solid.shape != Shape::kBox) return;
  Add(table, "box yaw deg", kDegreesPerRad * error.yaw_rad);
  static const char* const kNames[] = {"box width", "box depth", "box height"};
  for (size_t i = 0; i < 3; ++i) {
    AddExtent(table, kNames[i], error.extent[static_cast<Eigen::Index>(i)],
              IsObserved(model, error.axis[i]));
  }
}

std::vector<RecallBin> Bins(const std::vector<std::string>& names) {
  std::vector<RecallBin> bins;
  for (const std::string& name : names) bins.push_back({name, {}, {}});
  return bins;
}

// Bin of a value by the upper limits of all bins but the last two: beyond, and unknown.
size_t BinOf(const std::optional<double>& value, const std::vector<double>& limits) {
  if (!value) return limits.size() + 1;
  return static_cast<size_t>(std::upper_bound(limits.begin(), limits.end(), *value) -
                             limits.begin());
}

class Summarizer {
 public:
  Summarizer() {
    summary_.by_distance =
        Bins({"< 0.7 m", "0.7-0.9 m", "0.9-1.1 m", "1.1-1.4 m", ">= 1.4 m", "unknown distance"});
    summary_.by_visible_fraction =
        Bins({"< 25 % visible", "25-50 %", "50-75 %", ">= 75 %", "unknown fraction"});
  }

  void AddFrame(const ScoredFrame& frame) {
    if (!frame.has_result) summary_.without_result.push_back(frame.truth.frame);
    GroupCount& group = summary_.groups[frame.truth.group];
    ++group.num_frames;
    for (size_t t = 0; t < frame.truth.objects.size(); ++t) AddObject(frame, t, &group);
    for (size_t m = 0; m < frame.found.objects.size(); ++m) {
      const ModelScore& score = frame.score.models[m];
      const auto shape = static_cast<size_t>(frame.found.objects[m].solid.shape);
      if (score.verdict == Verdict::kFalse) ++group.shapes[shape].num_false;
      if (score.verdict == Verdict::kNeutral) ++group.num_neutral;
    }
  }

  Summary Finish() {
    for (const auto& [name, group] : summary_.groups) {
      summary_.total.num_frames += group.num_frames;
      summary_.total.num_neutral += group.num_neutral;
      for (size_t i = 0; i < 2; ++i) summary_.total.shapes[i] += group.shapes[i];
    }
    if (!ious_.empty()) summary_.median_iou = SpreadOf(ious_).median;
    std::stable_sort(summary_.errors.begin(), summary_.errors.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    return summary_;
  }

 private:
  void AddObject(const ScoredFrame& frame, size_t t, GroupCount* group) {
    const TrueObject& object = frame.truth.objects[t];
    const ObjectScore& score = frame.score.objects[t];
    if (!object.shape) return;
    const auto shape = static_cast<size_t>(*object.shape);
    ShapeCount& count = group->shapes[shape];
    const int found = score.model ? 1 : 0;
    if (object.scope == Scope::kSoft) {
      ++count.num_soft;
      count.num_soft_found += found;
    }
    if (object.scope != Scope::kCore) return;
    ++count.num_core;
    count.num_found += found;
    if (object.solid) ++summary_.num_exact;
    static const std::vector<double> kDistances{0.7, 0.9, 1.1, 1.4};
    static const std::vector<double> kFractions{0.25, 0.5, 0.75};
    for (RecallBin* bin :
         {&summary_.by_distance[BinOf(object.distance_m, kDistances)],
          &summary_.by_visible_fraction[BinOf(object.visible_fraction, kFractions)]}) {
      ++bin->num_core[shape];
      bin->num_found[shape] += found;
    }
    if (score.model) AddMatch(object, frame.found.objects[*score.model], score.iou);
  }

  void AddMatch(const TrueObject& object, const ObjectModel& model, double iou) {
    if (iou > 0) ious_.push_back(iou);
    if (object.size) AddSizeErrors(model, object, &summary_.errors);
    if (!object.solid) return;
    const SolidError error = CompareSolids(model.solid, *object.solid);
    AddPoseErrors(model, error, &summary_.errors);
    summary_.num_within_20_mm += IsWithin(error, kMaxErrorM) ? 1 : 0;
    AddIntervals(model, error);
  }

  void AddIntervals(const ObjectModel& model, const SolidError& error) {
    const Eigen::Vector3d center_O = model.solid.X_CO.linear().transpose() * error.center_C;
    for (int i = 0; i < 3; ++i) AddInterval(model, i, center_O[i]);
    if (model.solid.shape == Shape::kCylinder) {
      AddInterval(model, 3, 2 * error.extent[0]);
      AddInterval(model, 5, error.extent[2]);
      return;
    }
    for (size_t i = 0; i < 3; ++i) {
      AddInterval(model, 3 + error.axis[i], error.extent[static_cast<Eigen::Index>(i)]);
    }
    AddInterval(model, 6, error.yaw_rad);
  }

  void AddInterval(const ObjectModel& model, int parameter, double error) {
    constexpr double kSdOfInterval = 1.96;
    const double variance = model.covariance(parameter, parameter);
    if (variance <= 0) return;
    ++summary_.num_estimates;
    summary_.num_in_interval += std::abs(error) < kSdOfInterval * std::sqrt(variance) ? 1 : 0;
  }

  Summary summary_;
  std::vector<double> ious_;
};

}  // namespace

double ShapeCount::Recall() const {
  return num_core == 0 ? 1.0 : static_cast<double>(num_found) / num_core;
}

double ShapeCount::Precision() const {
  const int num_models = num_found + num_false;
  return num_models == 0 ? 1.0 : static_cast<double>(num_found) / num_models;
}

ShapeCount& ShapeCount::operator+=(const ShapeCount& other) {
  num_core += other.num_core;
  num_found += other.num_found;
  num_false += other.num_false;
  num_soft += other.num_soft;
  num_soft_found += other.num_soft_found;
  return *this;
}

Spread SpreadOf(const std::vector<double>& errors) {
  if (errors.empty()) return {};
  std::vector<double> sorted = errors;
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> absolute;
  for (const double error : errors) absolute.push_back(std::abs(error));
  std::sort(absolute.begin(), absolute.end());
  Spread spread;
  spread.num = errors.size();
  const auto num = static_cast<double>(errors.size());
  spread.median = Quantile(sorted, 0.5);
  spread.mean = std::accumulate(errors.begin(), errors.end(), 0.0) / num;
  for (const double error : errors) spread.sd += (error - spread.mean) * (error - spread.mean);
  spread.sd = std::sqrt(spread.sd / std::max(1.0, num - 1));
  spread.median_abs = Quantile(absolute, 0.5);
  spread.p90_abs = Quantile(absolute, 0.9);
  return spread;
}

Summary Summarize(const std::vector<ScoredFrame>& frames) {
  Summarizer summarizer;
  for (const ScoredFrame& frame : frames) summarizer.AddFrame(frame);
  return summarizer.Finish();
}

}  // namespace declutter::accuracy
