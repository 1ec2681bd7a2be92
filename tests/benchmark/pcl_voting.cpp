#include "tests/benchmark/pcl_voting.h"

#include <pcl/point_types.h>
#include <pcl/sample_consensus/ransac.h>
#include <pcl/sample_consensus/sac_model_circle.h>
#include <pcl/sample_consensus/sac_model_line.h>
#include <pcl/search/kdtree.h>
#include <pcl/segmentation/extract_clusters.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "modules/hough_segmenter/table_points.h"

namespace declutter::benchmark {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using pcl::Indices;

constexpr size_t kMinInliers = 100;             // N
constexpr double kInlierDistance = 0.005;       // [m]
constexpr float kMaxNormalAngle = 0.44F;        // [rad]
constexpr float kMaxCurvature = 0.010F;         // of a flat surface
constexpr float kMaxRadiusDifference = 0.020F;  // [m]
constexpr double kMaxGap = 0.015;               // [m] within a cluster of inliers
constexpr double kPeakSize = 0.010;             // [m] within a cluster of votes
constexpr float kMinRadius = 0.015F;            // [m]
constexpr float kMaxRadius = 0.120F;            // [m]

// The unused coordinates of a vote are 0. Line: angle (scaled to lengths at 0.1 m), rho. Circle:
// centre, radius.
struct Fit {
  bool is_circle = false;
  Eigen::VectorXf model;
  Indices inliers;  // of the RANSAC model
  Indices kept;     // by the filters
};

std::vector<pcl::PointIndices> Clusters(const Cloud::Ptr& cloud, const Indices& indices,
                                        double distance) {
  std::vector<pcl::PointIndices> clusters;
  if (indices.empty()) return clusters;
  auto shared = std::make_shared<Indices>(indices);
  auto tree = std::make_shared<pcl::search::KdTree<pcl::PointXYZ>>();
  tree->setInputCloud(cloud, shared);
  pcl::EuclideanClusterExtraction<pcl::PointXYZ> extraction;
  extraction.setClusterTolerance(distance);
  extraction.setMinClusterSize(1);
  extraction.setSearchMethod(tree);
  extraction.setInputCloud(cloud);
  extraction.setIndices(shared);
  extraction.extract(clusters);
  return clusters;
}

class Voting {
 public:
  explicit Voting(const std::vector<SidePoint>& points)
      : points_(points), upright_(std::make_shared<Cloud>()), flat_(std::make_shared<Cloud>()) {
    for (const SidePoint& point : points) {
      upright_->push_back({point.p_T.x(), point.p_T.y(), point.p_T.z()});
      flat_->push_back({point.p_T.x(), point.p_T.y(), 0});
    }
  }

  size_t CountModels(int num_iterations) {
    Indices rest;
    for (size_t i = 0; i < points_.size(); ++i) rest.push_back(static_cast<int>(i));
    size_t num_models = 0;
    size_t num_found = 0;
    do {
      votes_ = {};
      for (int i = 0; i < num_iterations; ++i) CastVotes(rest);
      num_found = TakePeaks(&rest);
      num_models += num_found;
    } while (num_found > 0 && rest.size() > kMinInliers);
    return num_models;
  }

 private:
  template <typename Model>
  Fit BestFit(const std::shared_ptr<Model>& model, bool is_circle) {
    Fit fit;
    fit.is_circle = is_circle;
    pcl::RandomSampleConsensus<pcl::PointXYZ> ransac(model, kInlierDistance);
    if (!ransac.computeModel()) return fit;
    ransac.getInliers(fit.inliers);
    ransac.getModelCoefficients(fit.model);
    fit.kept = Filtered(fit);
    return fit;
  }

  Fit FitLine(const Indices& rest) {
    return BestFit(std::make_shared<pcl::SampleConsensusModelLine<pcl::PointXYZ>>(flat_, rest),
                   false);
  }

  Fit FitCircle(const Indices& rest) {
    auto model = std::make_shared<pcl::SampleConsensusModelCircle2D<pcl::PointXYZ>>(flat_, rest);
    model->setRadiusLimits(kMinRadius, kMaxRadius);
    return BestFit(model, true);
  }

  Eigen::Vector2f NormalAt(const Fit& fit, int i) const {
    const auto& p = (*flat_)[static_cast<size_t>(i)];
    if (!fit.is_circle) return Eigen::Vector2f(-fit.model[4], fit.model[3]).normalized();
    return Eigen::Vector2f(p.x - fit.model[0], p.y - fit.model[1]).normalized();
  }

  // Section 5: normals, curvature, radius, then the clusters.
  Indices Filtered(const Fit& fit) const {
    Indices kept;
    for (int i : fit.inliers) {
      const SidePoint& point = points_[static_cast<size_t>(i)];
      if (std::abs(NormalAt(fit, i).dot(point.n)) < std::cos(kMaxNormalAngle)) continue;
      if (fit.is_circle != (point.curvature > kMaxCurvature)) continue;
      if (fit.is_circle && std::abs(point.r_min - fit.model[2]) > kMaxRadiusDifference) continue;
      kept.push_back(i);
    }
    const size_t max_clusters = fit.is_circle ? 2 : 1;
    if (Clusters(upright_, kept, kMaxGap).size() > max_clusters) kept.clear();
    return kept;
  }

  void CastVotes(Indices rest) {
    while (rest.size() > kMinInliers) {
      const Fit line = FitLine(rest);
      const Fit circle = FitCircle(rest);
      const Fit& fit = line.kept.size() >= circle.kept.size() ? line : circle;
      const Indices& taken =
          fit.kept.size() > kMinInliers
              ? fit.kept
              : (line.inliers.size() >= circle.inliers.size() ? line : circle).inliers;
      if (taken.empty()) return;
      if (fit.kept.size() > kMinInliers) Vote(fit);
      rest = Without(rest, taken);
    }
  }

  void Vote(const Fit& fit) {
    const Eigen::VectorXf& m = fit.model;
    if (fit.is_circle) {
      Add({m[0], m[1], m[2]}, fit, &votes_.circles, &votes_.circle_fits);
      return;
    }
    Eigen::Vector2f n = NormalAt(fit, fit.kept[0]);
    float rho = n.dot(Eigen::Vector2f(m[0], m[1]));
    if (rho < 0) {
      n = -n;
      rho = -rho;
    }
    Add({0.1F * std::atan2(n.y(), n.x()), rho, 0}, fit, &votes_.lines, &votes_.line_fits);
  }

  static void Add(const pcl::PointXYZ& vote, const Fit& fit, Cloud::Ptr* space,
                  std::vector<Fit>* fits) {
    (*space)->push_back(vote);
    fits->push_back(fit);
  }

  // Clusters of votes, largest first; each is recomputed on the points that are left and removed.
  size_t TakePeaks(Indices* rest) {
    struct Peak {
      const std::vector<Fit>* fits;
      Indices votes;
    };
    std::vector<Peak> peaks;
    const auto add = [&peaks](const Cloud::Ptr& space, const std::vector<Fit>& fits) {
      Indices all;
      for (size_t i = 0; i < fits.size(); ++i) all.push_back(static_cast<int>(i));
      for (const auto& cluster : Clusters(space, all, kPeakSize)) {
        peaks.push_back({&fits, cluster.indices});
      }
    };
    add(votes_.lines, votes_.line_fits);
    add(votes_.circles, votes_.circle_fits);
    std::stable_sort(peaks.begin(), peaks.end(),
                     [](const Peak& a, const Peak& b) { return a.votes.size() > b.votes.size(); });
    size_t num_models = 0;
    for (const Peak& peak : peaks) num_models += TakePeak(*peak.fits, peak.votes, rest);
    return num_models;
  }

  bool TakePeak(const std::vector<Fit>& fits, const Indices& votes, Indices* rest) {
    Fit mean = fits[static_cast<size_t>(votes[0])];
    if (mean.is_circle) {
      mean.model.setZero();
      for (int i : votes) {
        mean.model += fits[static_cast<size_t>(i)].model / static_cast<float>(votes.size());
      }
    }
    if (mean.is_circle) {
      pcl::SampleConsensusModelCircle2D<pcl::PointXYZ> model(flat_, *rest);
      model.selectWithinDistance(mean.model, kInlierDistance, mean.inliers);
    } else {
      pcl::SampleConsensusModelLine<pcl::PointXYZ> model(flat_, *rest);
      model.selectWithinDistance(mean.model, kInlierDistance, mean.inliers);
    }
    mean.kept = Filtered(mean);
    if (mean.kept.size() <= kMinInliers) return false;
    *rest = Without(*rest, mean.kept);
    return true;
  }

  Indices Without(const Indices& from, const Indices& taken) const {
    std::vector<char> is_taken(points_.size(), 0);
    for (int i : taken) is_taken[static_cast<size_t>(i)] = 1;
    Indices rest;
    for (int i : from) {
      if (!is_taken[static_cast<size_t>(i)]) rest.push_back(i);
    }
    return rest;
  }

  struct Votes {
    Cloud::Ptr lines = std::make_shared<Cloud>();
    Cloud::Ptr circles = std::make_shared<Cloud>();
    std::vector<Fit> line_fits;
    std::vector<Fit> circle_fits;
  };

  const std::vector<SidePoint>& points_;
  Cloud::Ptr upright_;
  Cloud::Ptr flat_;  // seen from above
  Votes votes_;
};

}  // namespace

std::vector<std::vector<SidePoint>> SidePoints(const Tabletop& tabletop,
                                               const FeatureCloud& paper_features, double leaf_m) {
  std::vector<std::vector<SidePoint>> sides(static_cast<size_t>(paper_features.num_components));
  if (tabletop.planes.empty()) return sides;
  std::set<std::tuple<int, int, int>> voxels;
  std::vector<TablePoint> points;
  FindTablePoints(tabletop, paper_features, TableFrame(tabletop.planes[0].plane), &points);
  for (const TablePoint& point : points) {
    if (!point.is_side()) continue;
    if (leaf_m > 0) {
      const Eigen::Vector3i voxel = (point.p_T / static_cast<float>(leaf_m)).cast<int>();
      if (!voxels.emplace(voxel.x(), voxel.y(), voxel.z()).second) continue;
    }
    sides[static_cast<size_t>(point.component)].push_back(
        {point.p_T, point.n_T.head<2>().normalized(), point.curvature, point.r_min});
  }
  return sides;
}

size_t CountVotedModels(const std::vector<SidePoint>& points, int num_iterations) {
  return Voting(points).CountModels(num_iterations);
}

}  // namespace declutter::benchmark
