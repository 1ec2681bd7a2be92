#include <algorithm>
#include <cmath>
#include <set>

#include "modules/codec/solid_parts.h"

namespace declutter::codec {
namespace {

constexpr int32_t kMaxObjects = 255;  // ids are bytes in the label image

// Ids are 1 .. number of objects, in any order, and all labels are ids or 0.
void DemandConsistent(const ObjectList& list) {
  DemandImageSize(list.camera.width, list.camera.height, list.header.error);
  const auto num_objects = static_cast<int32_t>(list.objects.size());
  Demand(num_objects <= kMaxObjects, std::to_string(num_objects) + " objects, at most 255");
  std::set<int32_t> ids;
  for (const ObjectModel& object : list.objects) {
    Demand(object.id >= 1 && object.id <= num_objects && ids.insert(object.id).second,
           "object id " + std::to_string(object.id) + " of " + std::to_string(num_objects));
  }
  const size_t num_pixels = static_cast<size_t>(list.camera.num_pixels());
  Demand(list.labels.size() == num_pixels, "label image and camera differ in size");
  const auto max_label = std::max_element(list.labels.begin(), list.labels.end());
  Demand(max_label == list.labels.end() || *max_label <= num_objects, "a label is no object's id");
}

void WriteLabels(const std::vector<uint8_t>& labels, object_list_t* message) {
  for (auto run = labels.begin(); run != labels.end();) {
    const uint8_t label = *run;
    const auto end = std::find_if(run, labels.end(), [&](uint8_t other) { return other != label; });
    message->run_length.push_back(static_cast<int32_t>(end - run));
    message->run_label.push_back(label);
    run = end;
  }
  message->num_runs = static_cast<int32_t>(message->run_length.size());
}

std::vector<uint8_t> ReadLabels(const object_list_t& message, size_t num_pixels) {
  CheckLength("run_length", message.run_length, "num_runs", message.num_runs);
  CheckLength("run_label", message.run_label, "num_runs", message.num_runs);
  std::vector<uint8_t> labels;
  labels.reserve(num_pixels);
  for (size_t i = 0; i < message.run_length.size(); ++i) {
    const int32_t length = message.run_length[i];
    Check(length > 0 && static_cast<size_t>(length) <= num_pixels - labels.size(),
          {"run_length", i}, length, "must be positive and end within the label image");
    Check(message.run_label[i] <= message.num_objects, {"run_label", i},
          static_cast<int>(message.run_label[i]), "is no object's id");
    labels.insert(labels.end(), static_cast<size_t>(length), message.run_label[i]);
  }
  Check(labels.size() == num_pixels, "num_runs", message.num_runs,
        "runs do not fill the label image");
  return labels;
}

constexpr int32_t kCovariances = 28;  // in the upper triangle of 7 x 7

void AppendCovariance(const SolidCovariance& covariance, object_list_t* message) {
  for (int row = 0; row < 7; ++row) {
    for (int column = row; column < 7; ++column) {
      message->covariance.push_back(static_cast<float>(covariance(row, column)));
    }
  }
  message->num_covariances = static_cast<int32_t>(message->covariance.size());
}

SolidCovariance ReadCovariance(const object_list_t& message, size_t object) {
  SolidCovariance covariance;
  size_t i = kCovariances * object;
  for (int row = 0; row < 7; ++row) {
    for (int column = row; column < 7; ++column, ++i) {
      const auto value = static_cast<double>(message.covariance[i]);
      Check(std::isfinite(value) && (row != column || value >= 0), {"covariance", i}, value,
            "must be finite, and a variance not negative");
      covariance(row, column) = covariance(column, row) = value;
    }
  }
  return covariance;
}

void CheckObjectLengths(const object_list_t& message) {
  const int32_t num = message.num_objects;
  Check(num <= kMaxObjects, "num_objects", num, "must be at most 255");
  CheckLength("id", message.id, "num_objects", num);
  CheckSolidLengths(message, "num_objects", num);
  CheckLength("confidence", message.confidence, "num_objects", num);
  CheckLength("supported_by", message.supported_by, "num_objects", num);
  CheckLength("num_votes", message.num_votes, "num_objects", num);
  CheckLength("num_explained", message.num_explained, "num_objects", num);
  CheckLength("num_occluded", message.num_occluded, "num_objects", num);
  CheckLength("num_violating", message.num_violating, "num_objects", num);
  Check(message.num_covariances == kCovariances * num, "num_covariances", message.num_covariances,
        "must be 28 for each object");
  CheckLength("covariance", message.covariance, "num_covariances", message.num_covariances);
}

ObjectModel ReadObject(const object_list_t& message, size_t i) {
  ObjectModel object;
  object.id = message.id[i];
  Check(object.id >= 1 && object.id <= message.num_objects, {"id", i}, object.id,
        "must be in 1 .. num_objects");
  Check(std::count(message.id.begin(), message.id.end(), object.id) == 1, {"id", i}, object.id,
        "is another object's id too");
  object.solid = ReadSolid(message, i);
  object.evidence = ReadEvidence(message, i);
  object.confidence = Fraction({"confidence", i}, message.confidence[i]);
  object.supported_by = NotNegative({"supported_by", i}, message.supported_by[i]);
  Check(object.supported_by <= message.num_objects && object.supported_by != object.id,
        {"supported_by", i}, object.supported_by, "must be 0 or another object's id");
  object.num_votes = NotNegative({"num_votes", i}, message.num_votes[i]);
  object.num_explained = NotNegative({"num_explained", i}, message.num_explained[i]);
  object.num_occluded = NotNegative({"num_occluded", i}, message.num_occluded[i]);
  object.num_violating = NotNegative({"num_violating", i}, message.num_violating[i]);
  object.covariance = ReadCovariance(message, i);
  return object;
}

}  // namespace

object_list_t Encode(const ObjectList& list) {
  DemandConsistent(list);
  object_list_t message{};
  WriteHeader(list.header, &message);
  message.mode = static_cast<int8_t>(list.mode);
  WriteCamera(list.camera, &message);
  WriteCameraPose(list.X_WC, &message);
  for (const Plane& plane : list.planes) AppendPlane(plane, &message);
  message.num_objects = static_cast<int32_t>(list.objects.size());
  for (const ObjectModel& object : list.objects) {
    message.id.push_back(object.id);
    AppendSolid(object.solid, object.evidence, &message);
    message.confidence.push_back(object.confidence);
    message.supported_by.push_back(object.supported_by);
    message.num_votes.push_back(object.num_votes);
    message.num_explained.push_back(object.num_explained);
    message.num_occluded.push_back(object.num_occluded);
    message.num_violating.push_back(object.num_violating);
    AppendCovariance(object.covariance, &message);
  }
  WriteLabels(list.labels, &message);
  return Fitting(std::move(message));
}

ObjectList Decode(const object_list_t& message) {
  ObjectList list;
  list.header = ReadHeader(message);
  list.mode = Enumerator("mode", message.mode, FeatureMode::kPaper);
  list.camera = ReadCamera(message);
  list.X_WC = ReadCameraPose(message);
  list.planes = ReadPlanes(message);
  CheckObjectLengths(message);
  for (size_t i = 0; i < message.id.size(); ++i) list.objects.push_back(ReadObject(message, i));
  list.labels = ReadLabels(message, static_cast<size_t>(list.camera.num_pixels()));
  return list;
}

}  // namespace declutter::codec
