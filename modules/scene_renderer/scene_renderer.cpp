#include "modules/scene_renderer/scene_renderer.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "modules/scene_renderer/clutter.h"
#include "modules/scene_renderer/layout.h"
#include "modules/scene_renderer/ray_caster.h"
#include "modules/scene_renderer/sensor_model.h"
#include "modules/scene_renderer/surface_color.h"

namespace declutter {
namespace {

// [m] edge and thickness of floor and walls.
constexpr double kRoomExtent_m = 40, kRoomThickness_m = 0.1;
constexpr int kIdsPerRound = 24;

struct Stage {
  std::vector<Solid> solids;  // the objects, then the table, then floor and walls
  std::vector<Paint> paints;
};

void AddSurface(const Eigen::Isometry3d& X_CO, const Eigen::Vector3d& size, const Paint& paint,
                Stage* stage) {
  stage->solids.push_back({Shape::kBox, X_CO, size});
  stage->paints.push_back(paint);
}

Stage SetStage(const Scene& scene, const std::vector<PlacedObject>& objects,
               const Eigen::Isometry3d& X_CW) {
  Stage stage;
  for (const PlacedObject& object : objects) {
    stage.solids.push_back(ToSolid(object, X_CW));
    stage.paints.push_back({object.color, Material::kPrinted});
  }
  const SceneTable& table = scene.table();
  const Eigen::Vector3d board(table.size_x_m(), table.size_y_m(), table.thickness_m());
  AddSurface(X_CW * Eigen::Translation3d(table.x_m(), table.y_m(), -0.5 * board.z()), board,
             {{0.80, 0.69, 0.56}, Material::kWood}, &stage);
  if (scene.room().has_floor_depth_m()) {
    const double z = -scene.room().floor_depth_m() - 0.5 * kRoomThickness_m;
    AddSurface(X_CW * Eigen::Translation3d(0, 0, z),
               {kRoomExtent_m, kRoomExtent_m, kRoomThickness_m},
               {{0.52, 0.40, 0.28}, Material::kWood}, &stage);
  }
  for (const SceneWall& wall : scene.room().wall()) {
    const Eigen::Isometry3d X_WO =
        Eigen::AngleAxisd(wall.heading_rad(), Eigen::Vector3d::UnitZ()) *
        Eigen::Isometry3d(Eigen::Translation3d(0, wall.distance_m() + 0.5 * kRoomThickness_m, 0));
    AddSurface(X_CW * X_WO, {kRoomExtent_m, kRoomThickness_m, kRoomExtent_m},
               {{0.82, 0.82, 0.80}, Material::kPlain}, &stage);
  }
  return stage;
}

Plane TablePlane(const Eigen::Isometry3d& X_WC) {
  return {X_WC.linear().transpose() * Eigen::Vector3d::UnitZ(), X_WC.translation().z()};
}

std::vector<uint8_t> Label(const IdealImage& ideal, const DepthImage& depth, int num_objects) {
  std::vector<uint8_t> labels(ideal.z.size(), 0);
  for (size_t i = 0; i < labels.size(); ++i) {
    const int solid = ideal.solid[i];
    if (depth.counts[i] == 0 || solid < 0 || solid > num_objects) continue;
    labels[i] = solid == num_objects ? kTableLabel : LabelOf(kFirstObjectId + solid);
  }
  return labels;
}

// Steps from every pixel to the nearest one with another label, along rows and columns.
std::vector<int> DistanceInside(const std::vector<uint8_t>& labels, int width) {
  const int size = static_cast<int>(labels.size());
  std::vector<int> distance(labels.size(), 0);
  const auto relax = [&](int pixel, int neighbour) {
    const size_t at = static_cast<size_t>(pixel), next = static_cast<size_t>(neighbour);
    return neighbour >= 0 && neighbour < size && labels[at] == labels[next] ? distance[next] + 1
                                                                            : 1;
  };
  for (int i = 0; i < size; ++i) {
    distance[static_cast<size_t>(i)] = std::min(relax(i, i - 1), relax(i, i - width));
  }
  for (int i = size - 1; i >= 0; --i) {
    int& d = distance[static_cast<size_t>(i)];
    d = std::min({d, relax(i, i + 1), relax(i, i + width)});
  }
  return distance;
}

void CountPixels(const IdealImage& ideal, const std::vector<uint8_t>& labels,
                 std::vector<TrueObject>* objects) {
  const int width = ideal.camera.width;
  const std::vector<int> inside = DistanceInside(labels, width);
  std::vector<int> deepest(objects->size(), 0);
  for (size_t i = 0; i < labels.size(); ++i) {
    if (ideal.solid[i] < 0 || static_cast<size_t>(ideal.solid[i]) >= objects->size()) continue;
    const size_t index = static_cast<size_t>(ideal.solid[i]);
    TrueObject& object = (*objects)[index];
    ++object.num_visible_px;
    if (labels[i] != object.label) continue;
    ++object.num_px;
    if (inside[i] <= deepest[index]) continue;
    deepest[index] = inside[i];
    object.seed_px = {static_cast<int>(i) % width, static_cast<int>(i) / width};
  }
}

std::vector<TrueObject> TrueObjects(const std::vector<PlacedObject>& placed, const Stage& stage,
                                    const IdealImage& ideal, const std::vector<uint8_t>& labels) {
  std::vector<TrueObject> objects(placed.size());
  for (size_t i = 0; i < placed.size(); ++i) {
    objects[i].id = kFirstObjectId + static_cast<int32_t>(i);
    objects[i].label = LabelOf(objects[i].id);
    objects[i].solid = stage.solids[i];
    objects[i].rests_on = placed[i].on < 0 ? 0 : kFirstObjectId + placed[i].on;
    objects[i].num_unoccluded_px = ideal.num_covered[i];
  }
  CountPixels(ideal, labels, &objects);
  return objects;
}

}  // namespace

uint8_t LabelOf(int32_t id) {
  const int index = id - kFirstObjectId;
  if (index < 0 || index >= kMaxObjects) {
    throw std::invalid_argument("no label for object " + std::to_string(id));
  }
  return static_cast<uint8_t>(10 * (kFirstObjectId + index % kIdsPerRound) + index / kIdsPerRound);
}

RenderedScene Render(const Scene& scene, uint64_t seed, uint64_t frame) {
  RenderedScene rendered;
  rendered.X_WC = CameraPose(scene.camera());
  std::vector<PlacedObject> placed = PlaceObjects(scene);
  if (scene.has_clutter()) {
    placed = AddClutter(scene, scene.clutter().has_seed() ? scene.clutter().seed() : seed, placed);
  }
  if (placed.size() > static_cast<size_t>(kMaxObjects)) {
    throw std::invalid_argument("more than " + std::to_string(kMaxObjects) + " objects");
  }
  const Stage stage = SetStage(scene, placed, rendered.X_WC.inverse());
  const IdealImage ideal = CastRays(CameraOf(scene.camera()), stage.solids);

  rendered.table = TablePlane(rendered.X_WC);
  rendered.depth = Sense(ideal, scene.noise(), scene.camera().depth_scale_m(), seed, frame);
  rendered.color = Photograph(ideal, stage.solids, stage.paints, rendered.table.normal);
  rendered.labels = Label(ideal, rendered.depth, static_cast<int>(placed.size()));
  rendered.objects = TrueObjects(placed, stage, ideal, rendered.labels);
  rendered.scene = scene;
  rendered.scene.clear_clutter();
  rendered.scene.clear_object();
  for (const PlacedObject& object : placed) *rendered.scene.add_object() = ToSceneObject(object);
  return rendered;
}

}  // namespace declutter
