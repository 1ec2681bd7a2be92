#include "launcher/program_catalog.h"

#include <google/protobuf/io/tokenizer.h>

#include <stdexcept>
#include <utility>

#include "launcher/program_output.h"

namespace declutter::launcher {
namespace {

using google::protobuf::Descriptor;

constexpr double kDescribeLimit_s = 20.0;

ModuleDescription Ask(const std::string& path) {
  const ProgramOutput output = RunProgram({path, "--describe"}, kDescribeLimit_s);
  if (output.code != 0) {
    throw std::runtime_error(path + " --describe: " + output.how +
                             (output.err.empty() ? "" : ": " + output.err));
  }
  struct : google::protobuf::io::ErrorCollector {
    void AddError(int, google::protobuf::io::ColumnNumber, const std::string&) override {}
  } silence;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&silence);
  ModuleDescription description;
  if (!parser.ParseFromString(output.out, &description) || description.config_type().empty()) {
    throw std::runtime_error(path + " --describe: does not describe a module");
  }
  return description;
}

}  // namespace

const ModuleDescription& ProgramCatalog::Describe(const std::string& path) {
  const auto found = programs_.find(path);
  if (found != programs_.end()) return found->second.description;
  Program program{Ask(path), std::make_unique<google::protobuf::DescriptorPool>()};
  for (const auto& file : program.description.config_files().file()) {
    if (program.types->BuildFile(file) != nullptr) continue;
    throw std::runtime_error(path + " --describe: " + file.name() + " is not complete");
  }
  const std::string& type = program.description.config_type();
  if (program.types->FindMessageTypeByName(type) == nullptr) {
    throw std::runtime_error(path + " --describe: " + type + " is not declared");
  }
  return programs_.emplace(path, std::move(program)).first->second.description;
}

const Descriptor* ProgramCatalog::FindType(const std::string& full_name) const {
  for (const auto& [path, program] : programs_) {
    const Descriptor* type = program.types->FindMessageTypeByName(full_name);
    if (type != nullptr) return type;
  }
  return nullptr;
}

std::unique_ptr<google::protobuf::Message> ProgramCatalog::NewMessage(const Descriptor* type) {
  return std::unique_ptr<google::protobuf::Message>(factory_.GetPrototype(type)->New());
}

const Descriptor* ProgramCatalog::FindAnyType(const google::protobuf::Message&, const std::string&,
                                              const std::string& name) const {
  return FindType(name);
}

}  // namespace declutter::launcher
