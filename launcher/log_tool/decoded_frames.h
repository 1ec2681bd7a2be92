#pragma once

#include <optional>
#include <string>
#include <vector>

#include "launcher/logged_frames.h"
#include "modules/geometry/feature_cloud.h"
#include "modules/geometry/solid.h"
#include "modules/geometry/tabletop.h"

namespace declutter::log_tool {

// What a log holds of a frame.
struct DecodedFrame {
  FrameHeader header;
  std::optional<DepthFrame> depth;
  std::optional<ColorImage> color;
  std::optional<Tabletop> tabletop;
  std::optional<FeatureCloud> features;
  std::optional<HypothesisList> hypotheses;
  std::optional<ObjectList> objects;
};

// Reads a log frame by frame. What cannot be decoded is as if it were not there.
class DecodedFrames {
 public:
  // Throws as LoggedFrames does.
  DecodedFrames(const std::string& log, const launcher::Excerpt& part);

  std::optional<DecodedFrame> Next();

  // What could not be read so far, each with its place.
  std::vector<std::string> Faults() const;

 private:
  template <typename Message, typename Part>
  void Decode(const launcher::Message& message, std::optional<Part>* part);

  std::string log_;
  launcher::LoggedFrames frames_;
  std::vector<std::string> faults_;
};

}  // namespace declutter::log_tool
