#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "modules/codec/codec.h"

// Small frames with something in every field, and what a decoder says of a message.
namespace declutter::codec {

// Why Decode refuses message, "field = value: rule"; "accepted" when it does not.
template <typename Message>
std::string Refusal(const Message& message) {
  try {
    Decode(message);
  } catch (const BadMessage& bad) {
    return bad.what();
  }
  return "accepted";
}

inline FrameHeader TestHeader() { return {1'700'000'000'123'456, "kitchen_03", ""}; }
inline FrameHeader ErrorHeader() { return {1'700'000'000'123'456, "kitchen_04", "no depth.png"}; }

inline Eigen::Isometry3d TestPose() {
  return Eigen::Translation3d(0.1, -0.2, 0.9) *
         Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -2) / 3);
}

// 8 x 6 pixels, a ramp with holes.
inline DepthImage TestDepthImage() {
  DepthImage image;
  image.camera = {8, 6, 525.5, 526.5, 3.25, 2.75};
  image.depth_scale_m = 0.0001;
  for (int pixel = 0; pixel < image.camera.num_pixels(); ++pixel) {
    image.counts.push_back(static_cast<uint16_t>(pixel % 5 == 0 ? 0 : 8000 + 7 * pixel));
  }
  return image;
}

inline DepthFrame TestDepthFrame() { return {TestHeader(), TestDepthImage(), TestPose()}; }

inline std::vector<Plane> TestPlanes() {
  return {{Eigen::Vector3d(0, -0.8, -0.6), 0.75}, {Eigen::Vector3d(0, -0.6, -0.8), 0.5}};
}

inline Tabletop TestTabletop() {
  Tabletop tabletop;
  tabletop.header = TestHeader();
  tabletop.planes = {{TestPlanes()[0], {{0, 0, 1}, {1, 0, 1}, {0, 0.5f, 1}}},
                     {TestPlanes()[1], {{0, 0, 1}, {2, 0, 1}, {2, 0.5f, 1}, {0, 0.5f, 1}}}};
  tabletop.objects = TestDepthImage();
  tabletop.num_object_points = 38;
  return tabletop;
}

inline FeatureCloud TestFeatures(FeatureMode mode) {
  FeatureCloud features;
  features.header = TestHeader();
  features.mode = mode;
  features.width = 8;
  features.height = 6;
  features.num_components = 300;
  const bool paper = mode == FeatureMode::kPaper;
  features.points = {{3, {0, 0, -1}, paper ? 0 : 12.5f, 0.0105f, paper ? 0.042f : 0, 0},
                     {4, {0.6f, 0, -0.8f}, paper ? 0 : -3.0f, 0, 0, 299},
                     {47, {0, 0, 0}, 0, 0.1f, paper ? 0.2f : 0, -1}};
  return features;
}

inline Solid TestBox() { return {Shape::kBox, TestPose(), {0.2, 0.1, 0.3}}; }
inline Solid TestCylinder() { return {Shape::kCylinder, TestPose().inverse(), {0.08, 0.08, 0.12}}; }

inline HypothesisList TestHypotheses() {
  using E = Evidence;
  return {TestHeader(),
          FeatureMode::kPaper,
          TestPlanes(),
          {{TestBox(), {E::kObserved, E::kFreeSpace, E::kAssumed}, 4, 120, 900, 0.75f},
           {TestCylinder(), {E::kAssumed, E::kAssumed, E::kObserved}, 0, 80, 400, 0.5f}}};
}

inline ObjectList TestObjects() {
  using E = Evidence;
  ObjectList list;
  list.header = TestHeader();
  list.mode = FeatureMode::kPaper;
  list.camera = TestDepthImage().camera;
  list.X_WC = TestPose();
  list.planes = TestPlanes();
  list.objects = {
      {2, TestBox(), {E::kObserved, E::kFreeSpace, E::kAssumed}, 0.9f, 0, 120, 800, 90, 7},
      {1, TestCylinder(), {E::kAssumed, E::kAssumed, E::kObserved}, 0.4f, 2, 60, 300, 20, 1}};
  for (int i = 0; i < 7; ++i) {
    for (int j = 0; j < 7; ++j) {
      list.objects[0].covariance(i, j) = i == j ? 1e-6 * (i + 1) : 1e-7 * (i + j);
    }
  }
  list.labels.assign(48, 0);
  for (size_t pixel = 10; pixel < 30; ++pixel) list.labels[pixel] = pixel < 20 ? 1 : 2;
  return list;
}

// 16 x 12 pixels, smooth enough for JPEG.
inline ColorImage TestColorImage() {
  ColorImage image{16, 12, {}};
  for (int pixel = 0; pixel < 16 * 12; ++pixel) {
    for (const int value : {4 * (pixel % 16), 100, 200 - pixel}) {
      image.rgb.push_back(static_cast<uint8_t>(value));
    }
  }
  return image;
}

}  // namespace declutter::codec
