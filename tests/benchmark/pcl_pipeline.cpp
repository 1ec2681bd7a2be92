#include "tests/benchmark/pcl_pipeline.h"

#include <pcl/features/normal_3d_omp.h>
#include <pcl/features/rsd.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/statistical_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/extract_polygonal_prism_data.h>
#include <pcl/segmentation/sac_segmentation.h>
#include <pcl/surface/convex_hull.h>

#include "tests/benchmark/pcl_voting.h"

namespace declutter::benchmark {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;

constexpr double kRadius = 0.020;         // [m] of normals and RSD
constexpr double kPlaneDistance = 0.010;  // [m] of plane inliers
constexpr double kMaxHeight = 0.5;        // [m] of objects over the plane
constexpr double kClusterDistance = 0.010;
constexpr int kMinClusterPoints = 50;
constexpr int kMaxClusterPoints = 1000000;
constexpr int kOutlierNeighbors = 50;
constexpr double kRsdPlaneRadius = 0.2;

Cloud::Ptr CloudOf(const DepthImage& image) {
  auto cloud = std::make_shared<Cloud>();
  for (int v = 0; v < image.camera.height; ++v) {
    for (int u = 0; u < image.camera.width; ++u) {
      if (image.CountAt(u, v) == 0) continue;
      const Eigen::Vector3f p = image.PointAt(u, v).cast<float>();
      cloud->push_back({p.x(), p.y(), p.z()});
    }
  }
  return cloud;
}

Cloud::Ptr Thinned(const Cloud::Ptr& cloud, double leaf_m) {
  if (leaf_m <= 0) return cloud;
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  const auto leaf = static_cast<float>(leaf_m);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(cloud);
  auto thinned = std::make_shared<Cloud>();
  grid.filter(*thinned);
  return thinned;
}

size_t NumClusters(const Cloud::Ptr& cloud) {
  auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(kClusterDistance);
  extraction.setMinClusterSize(kMinClusterPoints);
  extraction.setMaxClusterSize(kMaxClusterPoints);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  std::vector<pcl::PointIndices> clusters;
  extraction.extract(clusters);
  return clusters.size();
}

}  // namespace

struct PclFrame::Clouds {
  Cloud::Ptr scene;
  Cloud::Ptr objects;
  std::vector<std::vector<SidePoint>> sides;  // by component
  double leaf_m = 0;
};

PclFrame::PclFrame(const DepthFrame& frame, const Tabletop& tabletop,
                   const FeatureCloud& paper_features, double leaf_m)
    : clouds_(std::make_unique<Clouds>()) {
  clouds_->scene = CloudOf(frame.image);
  clouds_->objects = CloudOf(tabletop.objects);
  clouds_->sides = SidePoints(tabletop, paper_features, leaf_m);
  clouds_->leaf_m = leaf_m;
}

PclFrame::~PclFrame() = default;
PclFrame::PclFrame(PclFrame&&) noexcept = default;

size_t PclFrame::num_object_points() const { return clouds_->objects->size(); }

size_t PclFrame::FilterPlane() const {
  const Cloud::Ptr scene = Thinned(clouds_->scene, clouds_->leaf_m);
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setModelType(pcl::SACMODEL_PLANE);
  segmentation.setMethodType(pcl::SAC_RANSAC);
  segmentation.setOptimizeCoefficients(true);
  segmentation.setDistanceThreshold(kPlaneDistance);
  segmentation.setInputCloud(scene);
  auto inliers = std::make_shared<pcl::PointIndices>();
  pcl::ModelCoefficients plane;
  segmentation.segment(*inliers, plane);

  pcl::ExtractIndices<pcl::PointXYZ> extraction;
  extraction.setInputCloud(scene);
  extraction.setIndices(inliers);
  auto support = std::make_shared<Cloud>();
  extraction.filter(*support);
  pcl::ConvexHull<pcl::PointXYZ> convex_hull;
  convex_hull.setDimension(2);
  convex_hull.setInputCloud(support);
  auto hull = std::make_shared<Cloud>();
  convex_hull.reconstruct(*hull);

  pcl::ExtractPolygonalPrismData<pcl::PointXYZ> prism;
  prism.setInputCloud(scene);
  prism.setInputPlanarHull(hull);
  prism.setHeightLimits(kPlaneDistance, kMaxHeight);
  auto above = std::make_shared<pcl::PointIndices>();
  prism.segment(*above);
  extraction.setIndices(above);
  auto objects = std::make_shared<Cloud>();
  extraction.filter(*objects);

  pcl::StatisticalOutlierRemoval<pcl::PointXYZ> removal;
  removal.setMeanK(kOutlierNeighbors);
  removal.setStddevMulThresh(1.0);
  removal.setInputCloud(objects);
  Cloud kept;
  removal.filter(kept);
  return kept.size();
}

size_t PclFrame::EstimateFeatures(int num_threads) const {
  const Cloud::Ptr objects = Thinned(clouds_->objects, clouds_->leaf_m);
  auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  auto normals = std::make_shared<Normals>();
  const auto estimate_normals = [&](auto* estimation) {
    estimation->setInputCloud(objects);
    estimation->setSearchMethod(tree);
    estimation->setRadiusSearch(kRadius);
    estimation->compute(*normals);
  };
  if (num_threads > 1) {
    pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(
        static_cast<unsigned>(num_threads));
    estimate_normals(&estimation);
  } else {
    pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> estimation;
    estimate_normals(&estimation);
  }
  pcl::RSDEstimation<pcl::PointXYZ, pcl::Normal, pcl::PrincipalRadiiRSD> rsd;
  rsd.setInputCloud(objects);
  rsd.setInputNormals(normals);
  rsd.setSearchMethod(tree);
  rsd.setRadiusSearch(kRadius);
  rsd.setPlaneRadius(kRsdPlaneRadius);
  rsd.setSaveHistograms(false);
  pcl::PointCloud<pcl::PrincipalRadiiRSD> radii;
  rsd.compute(radii);
  return radii.size() + NumClusters(objects);
}

size_t PclFrame::Segment(int num_iterations) const {
  size_t num_models = 0;
  for (const std::vector<SidePoint>& sides : clouds_->sides) {
    num_models += CountVotedModels(sides, num_iterations);
  }
  return num_models;
}

}  // namespace declutter::benchmark
