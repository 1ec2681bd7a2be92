#pragma once

#include <string>
#include <vector>

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include "modules/runtime/config_error.h"

namespace declutter::runtime {

// A value that is not allowed, or text that does not parse.
struct ConfigFault {
  int line = 0;  // from 1; 0: not from a file
  int column = 0;
  std::string text;
};

// Checks the fields that are set against their option (parameter): numbers outside their range,
// strings that are not one of those allowed, NaN. locations may be nullptr.
std::vector<ConfigFault> CheckParameters(
    const google::protobuf::Message& config,
    const google::protobuf::TextFormat::ParseInfoTree* locations);

// Throws ConfigError naming the first field that is required and not set.
void CheckComplete(const google::protobuf::Message& config);

// The allowed values of a number with their unit, "[0.001, 0.1] m"; empty: all.
std::string RangeText(const google::protobuf::FieldDescriptor& field);

}  // namespace declutter::runtime
