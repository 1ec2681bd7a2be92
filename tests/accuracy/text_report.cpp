#include "tests/accuracy/text_report.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <ostream>

#include "tests/accuracy/solid_comparison.h"

namespace declutter::accuracy {
namespace {

__attribute__((format(printf, 1, 2))) std::string Format(const char* format, ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string IdAndName(const TrueObject& object) {
  return object.name.empty() ? std::to_string(object.id)
                             : std::to_string(object.id) + " " + object.name;
}

std::string ObjectText(const TrueObject& object) {
  std::string text = IdAndName(object) + " " + object.shape_name;
  if (object.size) text += " " + SizeText(*object.shape, *object.size);
  if (object.distance_m) text += Format(", %.2f m away", *object.distance_m);
  if (object.visible_fraction) text += Format(", %.0f %% visible", 100 * *object.visible_fraction);
  return text;
}

std::string ModelText(const ObjectModel& model) {
  return Format("model %d %s %s", model.id, ShapeName(model.solid.shape).c_str(),
                SizeText(model.solid.shape, model.solid.size).c_str());
}

std::string PositionText(const Eigen::Vector3d& p_C) {
  return Format("(%6.3f %6.3f %6.3f)", p_C.x(), p_C.y(), p_C.z());
}

// The model's extents in the order of the true box's axes.
std::string SizeBeside(const ObjectModel& model, const std::optional<SolidError>& error) {
  Eigen::Vector3d size = model.solid.size;
  for (size_t i = 0; error && i < 3; ++i) {
    size[static_cast<Eigen::Index>(i)] = model.solid.size[error->axis[i]];
  }
  return SizeText(model.solid.shape, size);
}

std::string ComparisonLine(const TrueObject& object, const ScoredFrame& frame,
                           const ObjectScore& score, int name_width) {
  std::string line =
      Format("  %-*s %-8s %-4s  %-20s %-22s | ", name_width, IdAndName(object).c_str(),
             object.shape_name.c_str(), ScopeName(object.scope).c_str(),
             object.size ? SizeText(*object.shape, *object.size).c_str() : "-",
             object.solid ? PositionText(object.solid->X_CO.translation()).c_str() : "-");
  if (!score.model) return line + "missed: " + score.why;
  const ObjectModel& model = frame.found.objects[*score.model];
  std::optional<SolidError> error;
  if (object.solid) error = CompareSolids(model.solid, *object.solid);
  line += Format("%3d %-20s %s", model.id, SizeBeside(model, error).c_str(),
                 PositionText(model.solid.X_CO.translation()).c_str());
  if (!error) return line;
  return line + Format("  centre %4.1f mm, size %+5.1f %+5.1f %+5.1f mm",
                       1000 * error->center_C.norm(), 1000 * error->extent.x(),
                       1000 * error->extent.y(), 1000 * error->extent.z());
}

void WriteGroup(const std::string& name, const GroupCount& group, std::ostream& out) {
  for (const Shape shape : {Shape::kBox, Shape::kCylinder}) {
    const ShapeCount& count = group.shapes[static_cast<size_t>(shape)];
    out << Format(
        "%-16s %-8s %4d of %4d  recall %.3f   %3d false  precision %.3f   soft %d of %d\n",
        name.c_str(), ShapeName(shape).c_str(), count.num_found, count.num_core, count.Recall(),
        count.num_false, count.Precision(), count.num_soft_found, count.num_soft);
  }
}

void WriteBins(const char* title, const std::vector<RecallBin>& bins, std::ostream& out) {
  out << Format("\n%-20s %14s %14s\n", title, "boxes", "cylinders");
  for (const RecallBin& bin : bins) {
    if (bin.num_core[0] + bin.num_core[1] == 0) continue;
    out << Format("%-20s %6d of %4d %6d of %4d\n", bin.name.c_str(), bin.num_found[0],
                  bin.num_core[0], bin.num_found[1], bin.num_core[1]);
  }
}

void WriteErrors(const ErrorTable& errors, std::ostream& out) {
  out << Format("\n%-36s %6s %9s %9s %9s %9s %9s\n", "error of right models", "number", "median",
                "|median|", "|p90|", "mean", "sd");
  for (const auto& [name, values] : errors) {
    const Spread spread = SpreadOf(values);
    out << Format("%-36s %6zu %+9.2f %9.2f %9.2f %+9.2f %9.2f\n", name.c_str(), spread.num,
                  spread.median, spread.median_abs, spread.p90_abs, spread.mean, spread.sd);
  }
}

}  // namespace

std::string SizeText(Shape shape, const Eigen::Vector3d& size) {
  const Eigen::Vector3d mm = 1000 * size;
  if (shape == Shape::kCylinder) return Format("r %.0f h %.0f mm", 0.5 * mm.x(), mm.z());
  return Format("%.0f x %.0f x %.0f mm", mm.x(), mm.y(), mm.z());
}

std::vector<Remark> RemarksOn(const ScoredFrame& frame) {
  std::vector<Remark> remarks;
  for (size_t t = 0; t < frame.truth.objects.size(); ++t) {
    const TrueObject& object = frame.truth.objects[t];
    const ObjectScore& score = frame.score.objects[t];
    if (score.model || object.scope != Scope::kCore) continue;
    remarks.push_back({Remark::Kind::kMiss, ObjectText(object) + ": " + score.why});
  }
  for (size_t m = 0; m < frame.found.objects.size(); ++m) {
    const ModelScore& score = frame.score.models[m];
    if (score.verdict == Verdict::kRight) continue;
    const auto kind =
        score.verdict == Verdict::kFalse ? Remark::Kind::kFalse : Remark::Kind::kNeutral;
    remarks.push_back({kind, ModelText(frame.found.objects[m]) + ": " + score.why});
  }
  return remarks;
}

void WriteRemarks(const std::vector<ScoredFrame>& frames, std::ostream& out) {
  static const char* const kKinds[] = {"miss", "false", "neutral"};
  for (const ScoredFrame& frame : frames) {
    const char* name = frame.truth.frame.c_str();
    if (!frame.has_result) out << Format("error   %-28s no line in objects.jsonl\n", name);
    if (!frame.found.header.error.empty()) {
      out << Format("error   %-28s %s\n", name, frame.found.header.error.c_str());
    }
    for (const Remark& remark : RemarksOn(frame)) {
      out << Format("%-7s %-28s %s\n", kKinds[static_cast<size_t>(remark.kind)], name,
                    remark.text.c_str());
    }
  }
}

void WriteComparison(const std::vector<ScoredFrame>& frames, std::ostream& out) {
  for (const ScoredFrame& frame : frames) {
    size_t name_width = 2;
    for (const TrueObject& object : frame.truth.objects) {
      name_width = std::max(name_width, IdAndName(object).size());
    }
    out << Format("%s: truth | found\n", frame.truth.frame.c_str());
    for (size_t t = 0; t < frame.truth.objects.size(); ++t) {
      const TrueObject& object = frame.truth.objects[t];
      if (!object.shape || object.scope == Scope::kUnscored) continue;
      out << ComparisonLine(object, frame, frame.score.objects[t], static_cast<int>(name_width))
          << '\n';
    }
  }
}

void WriteTotals(const Summary& summary, std::ostream& out) {
  out << '\n';
  for (const auto& [name, group] : summary.groups) WriteGroup(name, group, out);
  if (summary.groups.size() > 1) WriteGroup("all", summary.total, out);
  ShapeCount both = summary.total.shapes[0];
  both += summary.total.shapes[1];
  out << Format(
      "%d frames, %d without result, %d of %d core objects found, %d false models (%.2f a frame), "
      "%d neutral\n",
      summary.total.num_frames, static_cast<int>(summary.without_result.size()), both.num_found,
      both.num_core, both.num_false,
      static_cast<double>(both.num_false) / std::max(1, summary.total.num_frames),
      summary.total.num_neutral);
  if (summary.median_iou) {
    out << Format("median IoU of right models %.3f\n", *summary.median_iou);
  }
  if (summary.num_exact > 0) {
    out << Format("right shape, centre and every dimension within 20 mm: %d of %d\n",
                  summary.num_within_20_mm, summary.num_exact);
    if (summary.num_estimates > 0) {
      out << Format("true values inside the 95 %% interval: %d of %d (%.1f %%)\n",
                    summary.num_in_interval, summary.num_estimates,
                    100.0 * summary.num_in_interval / summary.num_estimates);
    }
  }
  WriteBins("core objects found", summary.by_distance, out);
  WriteBins("", summary.by_visible_fraction, out);
  WriteErrors(summary.errors, out);
}

}  // namespace declutter::accuracy
