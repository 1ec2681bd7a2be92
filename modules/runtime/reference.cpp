#include "modules/runtime/reference.h"

#include <google/protobuf/text_format.h>

#include <memory>
#include <set>

#include "modules/runtime/command_line.h"
#include "modules/runtime/parameter.pb.h"
#include "modules/runtime/parameter_check.h"

namespace declutter::runtime {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

// Sets what is not set to its default. A type that holds itself is filled once.
void FillDefaults(Message* message, std::set<const Descriptor*> outer) {
  outer.insert(message->GetDescriptor());
  const auto& reflection = *message->GetReflection();
  for (int i = 0; i < message->GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor* field = message->GetDescriptor()->field(i);
    if (field->is_repeated() || field->containing_oneof() != nullptr) continue;
    if (field->message_type() != nullptr) {
      const bool is_set = reflection.HasField(*message, field);
      if (!is_set && outer.count(field->message_type()) > 0) continue;
      FillDefaults(reflection.MutableMessage(message, field), outer);
    } else if (!reflection.HasField(*message, field)) {
      std::string value;
      TextFormat::PrintFieldValueToString(*message, field, -1, &value);
      TextFormat::ParseFieldValueFromString(value, field, message);
    }
  }
}

std::string TypeText(const FieldDescriptor& field) {
  std::string text = field.is_repeated() ? "repeated " : "";
  if (field.enum_type() == nullptr) return text + field.type_name();
  for (int i = 0; i < field.enum_type()->value_count(); ++i) {
    text += (i == 0 ? "" : "|") + field.enum_type()->value(i)->name();
  }
  return text;
}

std::string DefaultText(const FieldDescriptor& field, const Message& defaults) {
  if (field.is_repeated()) return "";
  std::string value;
  TextFormat::PrintFieldValueToString(defaults, &field, -1, &value);
  return ", default " + value;
}

std::string AllowedText(const FieldDescriptor& field) {
  const Parameter& parameter = field.options().GetExtension(declutter::parameter);
  const std::string range = RangeText(field);
  std::string text = !range.empty()             ? ", in " + range
                     : parameter.unit().empty() ? ""
                                                : ", in " + parameter.unit();
  for (int i = 0; i < parameter.one_of_size(); ++i) {
    text += (i == 0 ? ", one of \"" : ", \"") + parameter.one_of(i) + '"';
  }
  return text + (parameter.required() ? ", must be set" : "");
}

void AppendHelp(const Message& defaults, const std::string& path, int depth, std::string* text) {
  constexpr int kMaxDepth = 4;
  for (int i = 0; i < defaults.GetDescriptor()->field_count(); ++i) {
    const FieldDescriptor& field = *defaults.GetDescriptor()->field(i);
    const Parameter& parameter = field.options().GetExtension(declutter::parameter);
    const bool is_message = field.message_type() != nullptr;
    *text += "  " + path + field.name() + "  (" +
             (is_message ? (field.is_repeated() ? "repeated " : "") + field.message_type()->name()
                         : TypeText(field) + DefaultText(field, defaults) + AllowedText(field)) +
             ")\n";
    if (!parameter.doc().empty()) *text += "      " + parameter.doc() + '\n';
    if (is_message && !field.is_repeated() && depth < kMaxDepth) {
      AppendHelp(defaults.GetReflection()->GetMessage(defaults, &field), path + field.name() + '.',
                 depth + 1, text);
    }
  }
}

// A file after those that it imports.
void AppendFiles(const FileDescriptor& file, std::set<const FileDescriptor*>* done,
                 google::protobuf::FileDescriptorSet* files) {
  if (!done->insert(&file).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) AppendFiles(*file.dependency(i), done, files);
  file.CopyTo(files->add_file());
}

template <typename Ports>
std::string PortsText(const std::string& title, const Ports& ports) {
  std::string text;
  for (const auto& port : ports) text += "  " + port.channel() + " (" + port.type() + ")\n";
  return text.empty() ? "" : title + text + '\n';
}

void AppendPorts(const std::vector<Port>& from,
                 google::protobuf::RepeatedPtrField<ModuleDescription::Port>* to) {
  for (const Port& port : from) {
    ModuleDescription::Port* added = to->Add();
    added->set_channel(port.channel);
    added->set_type(port.type);
  }
}

}  // namespace

std::string ConfigText(const Message& config) {
  const std::unique_ptr<Message> full(config.New());
  full->CopyFrom(config);
  FillDefaults(full.get(), {});
  std::string text;
  TextFormat::PrintToString(*full, &text);
  return text;
}

ModuleDescription Describe(const Shell& shell, const Descriptor& config_type) {
  ModuleDescription description;
  description.set_name(shell.identity().program);
  description.set_version(DECLUTTER_VERSION);
  AppendPorts(shell.inputs(), description.mutable_input());
  AppendPorts(shell.outputs(), description.mutable_output());
  description.set_config_type(config_type.full_name());
  std::set<const FileDescriptor*> done;
  AppendFiles(*config_type.file(), &done, description.mutable_config_files());
  return description;
}

std::string Help(const ModuleDescription& description, const Message& defaults) {
  std::string parameters;
  AppendHelp(defaults, "", 0, &parameters);
  return description.name() + ' ' + description.version() + "\n\nOptions:\n" + OptionsHelp() +
         '\n' + PortsText("Inputs:\n", description.input()) +
         PortsText("Outputs:\n", description.output()) + "Parameters (" +
         description.config_type() + "):\n" + parameters;
}

}  // namespace declutter::runtime
