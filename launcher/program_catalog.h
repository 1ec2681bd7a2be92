#pragma once

#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>

#include <map>
#include <memory>
#include <string>

#include "modules/runtime/description.pb.h"

namespace declutter::launcher {

// What the programs of a graph say of themselves, and the types of their parameters, so that these
// can be read without linking the program.
class ProgramCatalog : public google::protobuf::TextFormat::Finder {
 public:
  // Runs the program with --describe, once. Throws std::runtime_error with what is wrong with its
  // answer.
  const ModuleDescription& Describe(const std::string& path);

  // The message type of that full name, of the programs described so far; null for none.
  const google::protobuf::Descriptor* FindType(const std::string& full_name) const;

  // An empty message of a type found above. Lives no longer than the catalog.
  std::unique_ptr<google::protobuf::Message> NewMessage(const google::protobuf::Descriptor* type);

  const google::protobuf::Descriptor* FindAnyType(const google::protobuf::Message& message,
                                                  const std::string& prefix,
                                                  const std::string& name) const override;

 private:
  struct Program {
    ModuleDescription description;
    std::unique_ptr<google::protobuf::DescriptorPool> types;
  };

  std::map<std::string, Program> programs_;  // by path
  google::protobuf::DynamicMessageFactory factory_;
};

}  // namespace declutter::launcher
