#pragma once

#include <string>
#include <vector>

#include <google/protobuf/message.h>
#include <google/protobuf/text_format.h>

#include "modules/runtime/parameter_check.h"

// Configuration as protobuf text, checked against what option (parameter) says of each field. Works
// for every message, also a DynamicMessage of a program that is not linked.
namespace declutter::runtime {

// Merges text into config. Throws ConfigFileError with `file:line:column: message`, a line for each
// fault.
void ParseConfig(const std::string& text, const std::string& file,
                 google::protobuf::Message* config);

// assignment is `field=value`, fields of nested messages as `a.b=value`, strings without quotes;
// repeated fields append. Throws ConfigError, also for a value that is not allowed.
void SetField(const std::string& assignment, google::protobuf::Message* config);

// The fields' names: what a misspelt one is compared with.
std::vector<std::string> FieldNames(const google::protobuf::Descriptor& type);

}  // namespace declutter::runtime
