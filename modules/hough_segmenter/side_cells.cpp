#include "modules/hough_segmenter/side_cells.h"

#include <cmath>
#include <utility>

namespace declutter {
namespace {

// Which cell a point is in. Coordinates within +-1 km at 1 mm fit 21 bits each.
class CellPlace {
 public:
  CellPlace(float side_m, float height_m) : per_step_(1 / side_m, 1 / side_m, 1 / height_m) {}

  uint64_t operator()(const Eigen::Vector3f& p_T) const {
    const Eigen::Vector3f steps = p_T.cwiseProduct(per_step_);
    return Index(steps.x()) << 42 | Index(steps.y()) << 21 | Index(steps.z());
  }

 private:
  static uint64_t Index(float steps) {
    constexpr float kHalf = 1 << 20;  // so that what is cut off is no sign
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(steps) + kHalf)) & 0x1FFFFF;
  }

  Eigen::Vector3f per_step_;
};

void Accumulate(const TablePoint& point, SideCell* cell) {
  cell->p += point.p_T.head<2>();
  cell->n += point.n_T.head<2>().normalized();
  cell->z += point.p_T.z();
  cell->kappa += point.kappa;
  cell->curvature += point.curvature;
  cell->r_min += point.r_min;
  cell->sigma += point.sigma;
  cell->weight += 1;
}

void Finish(float num_pixels, SideCell* cell) {
  cell->p /= cell->weight;
  cell->n.normalize();
  cell->z /= cell->weight;
  cell->kappa /= cell->weight;
  cell->curvature /= cell->weight;
  cell->r_min /= cell->weight;
  cell->sigma /= cell->weight;
  cell->weight *= num_pixels;
}

}  // namespace

SideCells::Slot* SideCells::FindSlot(uint64_t place, int32_t component) {
  const size_t mask = slots_.size() - 1;
  const uint64_t key = (place ^ static_cast<uint64_t>(component) << 53) * 0x9E3779B97F4A7C15ull;
  for (size_t i = static_cast<size_t>(key >> 32);; ++i) {
    Slot& slot = slots_[i & mask];
    if (slot.component < 0 || (slot.place == place && slot.component == component)) return &slot;
  }
}

void SideCells::Grow() {
  const std::vector<Slot> before = std::move(slots_);
  slots_.assign(2 * before.size(), Slot());
  used_.clear();
  for (const Slot& slot : before) {
    if (slot.component >= 0) Use(FindSlot(slot.place, slot.component), slot);
  }
}

void SideCells::Use(Slot* slot, const Slot& value) {
  *slot = value;
  used_.push_back(static_cast<uint32_t>(slot - slots_.data()));
}

const ReusedList<std::vector<SideCell>>& SideCells::Gather(const std::vector<TablePoint>& points,
                                                           int num_components, float side_m,
                                                           float height_m, int num_pixels) {
  cells_.Clear();
  for (int c = 0; c < num_components; ++c) cells_.Add().clear();
  for (const uint32_t slot : used_) slots_[slot] = Slot();
  used_.clear();
  const CellPlace place_of(side_m, height_m);
  for (const TablePoint& point : points) {
    if (!point.is_side()) continue;
    const uint64_t place = place_of(point.p_T);
    Slot* slot = FindSlot(place, point.component);
    auto& component = cells_[static_cast<size_t>(point.component)];
    if (slot->component < 0) {
      Use(slot, {place, point.component, static_cast<uint32_t>(component.size())});
      component.emplace_back();
      Accumulate(point, &component.back());
      if (2 * used_.size() > slots_.size()) Grow();
    } else {
      Accumulate(point, &component[slot->cell]);
    }
  }
  for (auto& component : cells_) {
    for (SideCell& cell : component) Finish(static_cast<float>(num_pixels), &cell);
  }
  return cells_;
}

}  // namespace declutter
