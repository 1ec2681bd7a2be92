#include "tests/accuracy/paired_estimate.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/accuracy/summary.h"

namespace declutter::accuracy {
namespace {

constexpr int kNumDraws = 2000;
constexpr unsigned kSeed = 1;
constexpr double kSdOfInterval = 1.96;

using Draw = std::vector<size_t>;  // indices of frames, some more than once

std::optional<double> ValueOf(QuantityKind kind, const std::vector<FrameShare>& frames,
                              const Draw& draw) {
  double part = 0;
  double whole = 0;
  std::vector<double> errors;
  for (const size_t i : draw) {
    part += frames[i].part;
    whole += frames[i].whole;
    errors.insert(errors.end(), frames[i].errors.begin(), frames[i].errors.end());
  }
  if (kind == QuantityKind::kCount) return part;
  if (kind == QuantityKind::kShare) return whole > 0 ? std::optional(part / whole) : std::nullopt;
  return errors.empty() ? std::nullopt : std::optional(SpreadOf(errors).median_abs);
}

// The middle 95 % of what the draws gave; draws with nothing to measure are left out.
void SetPercentiles(std::vector<double> values, Estimate* estimate) {
  if (values.empty()) return;
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  estimate->low = values[static_cast<size_t>(std::floor(0.025 * last))];
  estimate->high = values[static_cast<size_t>(std::ceil(0.975 * last))];
}

std::optional<Estimate> Start(const std::optional<double>& value) {
  return value ? std::optional(Estimate{*value, *value, *value}) : std::nullopt;
}

void SetWilson(const std::vector<FrameShare>& frames, std::optional<Estimate>* estimate) {
  double part = 0;
  double whole = 0;
  for (const FrameShare& frame : frames) {
    part += frame.part;
    whole += frame.whole;
  }
  if (whole > 0) *estimate = WilsonInterval(part, whole);
}

}  // namespace

Estimate WilsonInterval(double part, double whole) {
  if (whole <= 0 || part < 0 || part > whole) throw std::logic_error("no share");
  const double share = part / whole;
  const double z2 = kSdOfInterval * kSdOfInterval;
  const double center = (share + z2 / (2 * whole)) / (1 + z2 / whole);
  const double half = kSdOfInterval / (1 + z2 / whole) *
                      std::sqrt(share * (1 - share) / whole + z2 / (4 * whole * whole));
  return {share, std::max(0.0, center - half), std::min(1.0, center + half)};
}

PairedEstimate EstimatePair(QuantityKind kind, const std::vector<FrameShare>& baseline,
                            const std::vector<FrameShare>& candidate) {
  const size_t num_frames = baseline.size();
  if (candidate.size() != num_frames) throw std::logic_error("frames without a partner");
  Draw draw(num_frames);
  for (size_t i = 0; i < num_frames; ++i) draw[i] = i;
  PairedEstimate pair{Start(ValueOf(kind, baseline, draw)), Start(ValueOf(kind, candidate, draw)),
                      std::nullopt};
  if (pair.baseline && pair.candidate) {
    pair.difference = Start(pair.candidate->value - pair.baseline->value);
  }
  if (num_frames == 0) return pair;

  std::vector<double> of_baseline, of_candidate, of_difference;
  std::mt19937 random(kSeed);
  std::uniform_int_distribution<size_t> any_frame(0, num_frames - 1);
  for (int i = 0; i < kNumDraws; ++i) {
    for (size_t& frame : draw) frame = any_frame(random);
    const std::optional<double> one = ValueOf(kind, baseline, draw);
    const std::optional<double> other = ValueOf(kind, candidate, draw);
    if (one) of_baseline.push_back(*one);
    if (other) of_candidate.push_back(*other);
    if (one && other) of_difference.push_back(*other - *one);
  }
  if (pair.baseline) SetPercentiles(of_baseline, &*pair.baseline);
  if (pair.candidate) SetPercentiles(of_candidate, &*pair.candidate);
  if (pair.difference) SetPercentiles(of_difference, &*pair.difference);
  if (kind == QuantityKind::kShare) {
    SetWilson(baseline, &pair.baseline);
    SetWilson(candidate, &pair.candidate);
  }
  return pair;
}

}  // namespace declutter::accuracy
