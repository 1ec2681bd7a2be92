#pragma once

#include <string>

#include <google/protobuf/message.h>

#include "modules/runtime/description.pb.h"
#include "modules/runtime/shell.h"

// What a module program says of itself.
namespace declutter::runtime {

// All parameters as protobuf text, those with their default values too.
std::string ConfigText(const google::protobuf::Message& config);

// Channels of a shell whose module was constructed, and the declaration of its parameters.
ModuleDescription Describe(const Shell& shell, const google::protobuf::Descriptor& config_type);

// The text of --help: options, channels, and name, type, default, range and meaning of each
// parameter.
std::string Help(const ModuleDescription& description, const google::protobuf::Message& defaults);

}  // namespace declutter::runtime
