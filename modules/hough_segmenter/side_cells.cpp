#include "modules/hough_segmenter/side_cells.h"

#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace declutter {
namespace {

// Coordinates within +-1 km at 1 mm fit 21 bits each.
uint64_t CellKey(const Eigen::Vector3f& p_T, float side_m, float height_m) {
  const auto index = [](float x, float step) {
    return static_cast<uint64_t>(static_cast<int64_t>(std::floor(x / step)) + (1 << 20)) & 0x1FFFFF;
  };
  return index(p_T.x(), side_m) << 42 | index(p_T.y(), side_m) << 21 | index(p_T.z(), height_m);
}

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

void Finish(SideCell* cell) {
  cell->p /= cell->weight;
  cell->n.normalize();
  cell->z /= cell->weight;
  cell->kappa /= cell->weight;
  cell->curvature /= cell->weight;
  cell->r_min /= cell->weight;
  cell->sigma /= cell->weight;
}

}  // namespace

std::vector<std::vector<SideCell>> SideCells(const std::vector<TablePoint>& points,
                                             int num_components, float side_m, float height_m) {
  std::vector<std::vector<SideCell>> cells(static_cast<size_t>(num_components));
  std::vector<std::unordered_map<uint64_t, size_t>> index(cells.size());
  for (const TablePoint& point : points) {
    if (!point.is_side()) continue;
    const auto c = static_cast<size_t>(point.component);
    const auto [it, is_new] =
        index[c].try_emplace(CellKey(point.p_T, side_m, height_m), cells[c].size());
    if (is_new) cells[c].emplace_back();
    Accumulate(point, &cells[c][it->second]);
  }
  for (auto& component : cells) {
    for (SideCell& cell : component) Finish(&cell);
  }
  return cells;
}

}  // namespace declutter
