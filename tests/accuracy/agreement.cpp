#include "tests/accuracy/agreement.h"

#include <algorithm>
#include <set>
#include <tuple>

#include "tests/accuracy/solid_comparison.h"

namespace declutter::accuracy {
namespace {

constexpr double kMaxDifferenceM = 0.020;

std::array<int, 2> CountByShape(const ObjectList& list) {
  std::array<int, 2> counts{};
  for (const ObjectModel& model : list.objects) ++counts[static_cast<size_t>(model.solid.shape)];
  return counts;
}

std::array<int, 2> CountPairs(const ObjectList& baseline, const ObjectList& candidate) {
  std::vector<std::tuple<double, size_t, size_t>> pairs;  // distance of centres [m], indices
  for (size_t i = 0; i < baseline.objects.size(); ++i) {
    for (size_t k = 0; k < candidate.objects.size(); ++k) {
      const Solid& one = baseline.objects[i].solid;
      const Solid& other = candidate.objects[k].solid;
      const double distance_m = (one.X_CO.translation() - other.X_CO.translation()).norm();
      if (one.shape != other.shape || distance_m > kMaxDifferenceM) continue;
      if (IsWithin(CompareSolids(other, one), kMaxDifferenceM)) pairs.push_back({distance_m, i, k});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::array<int, 2> num_pairs{};
  std::set<size_t> used_baseline, used_candidate;
  for (const auto& [distance_m, i, k] : pairs) {
    if (used_baseline.count(i) > 0 || used_candidate.count(k) > 0) continue;
    used_baseline.insert(i);
    used_candidate.insert(k);
    ++num_pairs[static_cast<size_t>(baseline.objects[i].solid.shape)];
  }
  return num_pairs;
}

}  // namespace

bool FrameAgreement::IsSame() const {
  return has_baseline == has_candidate && num_same == num_baseline && num_same == num_candidate;
}

std::vector<FrameAgreement> CompareRuns(const std::map<std::string, ObjectList>& baseline,
                                        const std::map<std::string, ObjectList>& candidate) {
  std::set<std::string> names;
  for (const auto& [name, list] : baseline) names.insert(name);
  for (const auto& [name, list] : candidate) names.insert(name);
  std::vector<FrameAgreement> frames;
  for (const std::string& name : names) {
    const auto find = [&](const std::map<std::string, ObjectList>& run) {
      const auto found = run.find(name);
      return found != run.end() && found->second.header.error.empty() ? &found->second : nullptr;
    };
    const ObjectList* const one = find(baseline);
    const ObjectList* const other = find(candidate);
    FrameAgreement frame;
    frame.frame = name;
    frame.has_baseline = one != nullptr;
    frame.has_candidate = other != nullptr;
    if (one) frame.num_baseline = CountByShape(*one);
    if (other) frame.num_candidate = CountByShape(*other);
    if (one && other) frame.num_same = CountPairs(*one, *other);
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace declutter::accuracy
