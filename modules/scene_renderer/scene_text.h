#pragma once

#include <string>

#include "modules/scene_renderer/scene.pb.h"

namespace declutter {

// A scene from protobuf text. `name` is the file's, for messages. Throws std::invalid_argument with
// every fault, one "name:line:column: what is wrong" each: syntax, unknown fields, values outside
// their range, then objects that cannot be put down as stated.
Scene ParseScene(const std::string& text, const std::string& name);

// The scene in a file, parsed as above; throws the same when it cannot be read.
Scene ReadScene(const std::string& path);

// The scene as text that ParseScene reads back equal.
std::string PrintScene(const Scene& scene);

}  // namespace declutter
