#include "tests/accuracy/run_comparison.h"

#include <functional>

#include "tests/accuracy/summary.h"

namespace declutter::accuracy {
namespace {

using ShareOf = std::function<FrameShare(const Summary&)>;

std::vector<FrameShare> SharesOf(const std::vector<Summary>& frames, const ShareOf& share_of) {
  std::vector<FrameShare> shares;
  for (const Summary& frame : frames) shares.push_back(share_of(frame));
  return shares;
}

std::vector<Summary> SummarizeEach(const std::vector<ScoredFrame>& frames) {
  std::vector<Summary> summaries;
  for (const ScoredFrame& frame : frames) summaries.push_back(Summarize({frame}));
  return summaries;
}

FrameShare ErrorsOf(const Summary& frame, const std::string& name) {
  for (const auto& [known, errors] : frame.errors) {
    if (known == name) return {0, 0, errors};
  }
  return {};
}

}  // namespace

std::vector<ComparedQuantity> CompareWithTruth(const std::vector<ScoredFrame>& baseline,
                                               const std::vector<ScoredFrame>& candidate) {
  const std::vector<Summary> one = SummarizeEach(baseline);
  const std::vector<Summary> other = SummarizeEach(candidate);
  std::vector<ComparedQuantity> table;
  const auto add = [&](const std::string& name, QuantityKind kind, const ShareOf& share_of) {
    table.push_back(
        {name, kind, EstimatePair(kind, SharesOf(one, share_of), SharesOf(other, share_of))});
  };
  for (const Shape shape : {Shape::kBox, Shape::kCylinder}) {
    const auto count = [shape](const Summary& frame) -> const ShapeCount& {
      return frame.total.shapes[static_cast<size_t>(shape)];
    };
    const std::string name = ShapeName(shape);
    add(name + " recall %", QuantityKind::kShare, [&](const Summary& frame) {
      return FrameShare{1.0 * count(frame).num_found, 1.0 * count(frame).num_core, {}};
    });
    add(name + " precision %", QuantityKind::kShare, [&](const Summary& frame) {
      const int num_models = count(frame).num_found + count(frame).num_false;
      return FrameShare{1.0 * count(frame).num_found, 1.0 * num_models, {}};
    });
    add(name + " false models", QuantityKind::kCount, [&](const Summary& frame) {
      return FrameShare{1.0 * count(frame).num_false, 0, {}};
    });
  }
  add("within 20 mm %", QuantityKind::kShare, [](const Summary& frame) {
    return FrameShare{1.0 * frame.num_within_20_mm, 1.0 * frame.num_exact, {}};
  });
  for (const char* const name :
       {"box centre mm", "box extents mm", "box extents observed mm", "cylinder centre mm",
        "cylinder radius mm", "cylinder height mm"}) {
    add(name, QuantityKind::kMedianAbsoluteError,
        [&](const Summary& frame) { return ErrorsOf(frame, name); });
  }
  return table;
}

std::vector<ComparedQuantity> CompareWithEachOther(const std::vector<FrameAgreement>& frames) {
  std::vector<ComparedQuantity> table;
  for (const Shape shape : {Shape::kBox, Shape::kCylinder}) {
    const auto i = static_cast<size_t>(shape);
    std::vector<FrameShare> one, other;
    for (const FrameAgreement& frame : frames) {
      const double num_same = frame.num_same[i];
      one.push_back({num_same, 1.0 * frame.num_baseline[i], {}});
      other.push_back({num_same, 1.0 * frame.num_candidate[i], {}});
    }
    const QuantityKind kind = QuantityKind::kShare;
    const std::string name = ShapeName(shape);
    table.push_back({name + " also in other %", kind, EstimatePair(kind, one, other)});
    for (FrameShare& share : one) share.part = share.whole;
    for (FrameShare& share : other) share.part = share.whole;
    table.push_back(
        {name + " models", QuantityKind::kCount, EstimatePair(QuantityKind::kCount, one, other)});
  }
  return table;
}

}  // namespace declutter::accuracy
