#pragma once

#include <stdexcept>

#include "lcmtypes/channels.h"
#include "modules/geometry/depth_image.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"

// Messages to core types and back: the only place that knows both.
namespace declutter::codec {

// A message whose content cannot be meant: counts that disagree, numbers that are not finite or out
// of range, data that does not decompress. what() names the field and its value.
class BadMessage : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// No message on the wire is larger [byte].
inline constexpr int kMaxMessageBytes = 190'000;

// Content that does not fit in kMaxMessageBytes however it is coded. what() names the message type
// and its size.
class MessageTooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Every Encode throws std::logic_error when given what no Decode would accept and our own code must
// not make: an image of another size than its camera's, an image beside an error or neither, ids
// that are not 1 .. number of objects or exceed 255, values that cannot be quantised.
// Every Decode throws BadMessage. An image is empty exactly when header.error is set, and so are
// the lists.

// Lossless when the image fits. Of one that does not, counts finer than 0.5 mm are rounded to that
// or somewhat less; if this is not enough it is decimated by 2, 3 or 4, and the message says so.
// Throws MessageTooLarge when even that does not fit.
depth_frame_t Encode(const DepthFrame& frame);
DepthFrame Decode(const depth_frame_t& message);

// Thins the object points regularly until the message fits, and says so in it.
tabletop_t Encode(const Tabletop& tabletop);
Tabletop Decode(const tabletop_t& message);

// Thins the points regularly until the message fits, and says so in it. Normals come back within
// 1.0 degrees; kappa, curvature and r_min in the steps of feature_planes.h, saturated.
feature_cloud_t Encode(const FeatureCloud& features);
FeatureCloud Decode(const feature_cloud_t& message);

hypothesis_list_t Encode(const HypothesisList& list);
HypothesisList Decode(const hypothesis_list_t& message);

object_list_t Encode(const ObjectList& list);
ObjectList Decode(const object_list_t& message);

// Lowers the JPEG quality until the message fits.
color_frame_t Encode(const FrameHeader& header, const ColorImage& image);
ColorImage Decode(const color_frame_t& message);

}  // namespace declutter::codec
