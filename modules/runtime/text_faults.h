#pragma once

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>

#include <functional>
#include <string>
#include <vector>

#include "modules/runtime/parameter_check.h"

// What the parser of protobuf text finds wrong, in words a user can act on.
namespace declutter::runtime {

// Collects the parser's complaints, lines and columns counted from 1.
class FaultCollector : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, google::protobuf::io::ColumnNumber column,
                const std::string& text) override {
    faults.push_back({line + 1, column + 1, text});
  }

  void AddWarning(int line, google::protobuf::io::ColumnNumber column,
                  const std::string& text) override {
    warnings.push_back({line + 1, column + 1, text});
  }

  std::vector<ConfigFault> faults;
  std::vector<ConfigFault> warnings;  // what was skipped because it was allowed to be unknown
};

// The parser's own message, `Message type "T" has no field named "f".`, does not say which field
// was meant, and points behind its name: makes both good, and leaves other faults alone. text is
// what was parsed; find_type gives a message type by its full name, null when it is not known.
void ExplainUnknownField(
    const std::string& text,
    const std::function<const google::protobuf::Descriptor*(const std::string&)>& find_type,
    ConfigFault* fault);

}  // namespace declutter::runtime
