#include "launcher/log_tool/decoded_frames.h"

#include <iterator>
#include <map>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "modules/codec/codec.h"
#include "modules/runtime/message_layout.h"

namespace declutter::log_tool {
namespace {

template <typename Message>
std::pair<const std::string, std::string> Entry(const Channel<Message>& channel) {
  return {channel.name, Message::getTypeName()};
}

// Of the channels of a part.
std::map<std::string, std::string> TypesOf(const launcher::Excerpt& part) {
  std::map<std::string, std::string> types = {Entry(kDepthFrame), Entry(kColorFrame),
                                              Entry(kTabletop),   Entry(kFeatures),
                                              Entry(kHypotheses), Entry(kObjects)};
  for (auto type = types.begin(); type != types.end();) {
    const bool is_wanted = part.channels.empty() || part.channels.count(type->first) > 0;
    type = is_wanted ? std::next(type) : types.erase(type);
  }
  return types;
}

// A frame belongs to a part of the log with its first message, whatever channel that is on.
launcher::Excerpt TimesOf(const launcher::Excerpt& part) { return {part.start_s, part.end_s, {}}; }

// The header of the first part there is.
FrameHeader HeaderOf(const DecodedFrame& frame) {
  if (frame.depth) return frame.depth->header;
  if (frame.objects) return frame.objects->header;
  if (frame.tabletop) return frame.tabletop->header;
  if (frame.hypotheses) return frame.hypotheses->header;
  if (frame.features) return frame.features->header;
  return {};
}

}  // namespace

DecodedFrames::DecodedFrames(const std::string& log, const launcher::Excerpt& part)
    : log_(log), frames_(log, TypesOf(part), {}, TimesOf(part)) {}

std::optional<DecodedFrame> DecodedFrames::Next() {
  const auto logged = frames_.Next();
  if (!logged) return std::nullopt;
  DecodedFrame frame;
  for (const launcher::Message& message : logged->messages) {
    if (message.channel == kDepthFrame.name) Decode<depth_frame_t>(message, &frame.depth);
    if (message.channel == kColorFrame.name) Decode<color_frame_t>(message, &frame.color);
    if (message.channel == kTabletop.name) Decode<tabletop_t>(message, &frame.tabletop);
    if (message.channel == kFeatures.name) Decode<feature_cloud_t>(message, &frame.features);
    if (message.channel == kHypotheses.name) Decode<hypothesis_list_t>(message, &frame.hypotheses);
    if (message.channel == kObjects.name) Decode<object_list_t>(message, &frame.objects);
  }
  frame.header = HeaderOf(frame);
  frame.header.utime = logged->utime;
  return frame;
}

template <typename Message, typename Part>
void DecodedFrames::Decode(const launcher::Message& logged, std::optional<Part>* part) {
  const auto size = logged.bytes.size();
  try {
    runtime::LayoutOf(Message::getTypeName()).Locate(logged.bytes.data(), size);
    Message message;
    message.decode(logged.bytes.data(), 0, static_cast<int>(size));
    *part = codec::Decode(message);
  } catch (const std::runtime_error& error) {
    faults_.push_back(log_ + ": " + logged.channel + " of frame " +
                      std::to_string(runtime::UtimeOf(logged.bytes.data())) +
                      " us: " + error.what());
  }
}

std::vector<std::string> DecodedFrames::Faults() const {
  std::vector<std::string> faults = faults_;
  if (!frames_.damage().empty()) faults.push_back(frames_.damage());
  return faults;
}

}  // namespace declutter::log_tool
