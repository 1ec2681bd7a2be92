#include "modules/runtime/config.h"

#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include "modules/runtime/parameter_check.h"
#include "modules/runtime/suggestion.h"
#include "modules/runtime/text_faults.h"

namespace declutter::runtime {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

const Descriptor* FindType(const Descriptor& root, const std::string& full_name, int depth = 0) {
  constexpr int kMaxDepth = 8;
  if (root.full_name() == full_name) return &root;
  if (depth == kMaxDepth) return nullptr;
  for (int i = 0; i < root.field_count(); ++i) {
    const Descriptor* type = root.field(i)->message_type();
    const Descriptor* found = type != nullptr ? FindType(*type, full_name, depth + 1) : nullptr;
    if (found != nullptr) return found;
  }
  return nullptr;
}

std::string Located(const std::string& file, const ConfigFault& fault) {
  return file + ':' + std::to_string(fault.line) + ':' + std::to_string(fault.column) + ": " +
         fault.text;
}

void ThrowIfAny(const std::string& file, const std::vector<ConfigFault>& faults) {
  if (faults.empty()) return;
  std::string lines;
  for (const ConfigFault& fault : faults) {
    lines += (lines.empty() ? "" : "\n") + Located(file, fault);
  }
  throw ConfigFileError(lines);
}

std::vector<std::string> Split(const std::string& path) {
  std::vector<std::string> names;
  std::size_t start = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', start)) {
    names.push_back(path.substr(start, dot - start));
    start = dot + 1;
  }
  names.push_back(path.substr(start));
  return names;
}

const FieldDescriptor& FindField(const Descriptor& type, const std::string& name) {
  const FieldDescriptor* field = type.FindFieldByName(name);
  if (field == nullptr) {
    throw ConfigError("no field named '" + name + "' in " + type.full_name() +
                      Suggestion(name, FieldNames(type)));
  }
  return *field;
}

void ParseValue(const FieldDescriptor& field, const std::string& value, Message* message) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    const auto* reflection = message->GetReflection();
    if (field.is_repeated()) {
      reflection->AddString(message, &field, value);
    } else {
      reflection->SetString(message, &field, value);
    }
    return;
  }
  FaultCollector collector;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE) {
    throw ConfigError("a message cannot be set whole; set its fields");
  }
  if (!parser.ParseFieldValueFromString(value, &field, message)) {
    throw ConfigError(collector.faults.empty() ? "not a value of its type"
                                               : collector.faults[0].text);
  }
}

void SetFieldAt(const std::string& path, const std::string& value, Message* message) {
  const std::vector<std::string> names = Split(path);
  for (std::size_t i = 0; i + 1 < names.size(); ++i) {
    const FieldDescriptor& field = FindField(*message->GetDescriptor(), names[i]);
    if (field.message_type() == nullptr || field.is_repeated()) {
      throw ConfigError("'" + names[i] + "' has no fields that can be set");
    }
    message = message->GetReflection()->MutableMessage(message, &field);
  }
  ParseValue(FindField(*message->GetDescriptor(), names.back()), value, message);
}

}  // namespace

void ParseConfig(const std::string& text, const std::string& file, Message* config) {
  FaultCollector collector;
  TextFormat::ParseInfoTree locations;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(&locations);
  google::protobuf::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
  if (!parser.Merge(&stream, config)) {
    for (ConfigFault& fault : collector.faults) {
      ExplainUnknownField(
          text,
          [config](const std::string& name) { return FindType(*config->GetDescriptor(), name); },
          &fault);
    }
    if (collector.faults.empty()) collector.faults.push_back({1, 1, "cannot be parsed"});
    ThrowIfAny(file, collector.faults);
  }
  ThrowIfAny(file, CheckParameters(*config, &locations));
}

void SetField(const std::string& assignment, Message* config) {
  const std::size_t equals = assignment.find('=');
  try {
    if (equals == std::string::npos) throw ConfigError("not of the form field=value");
    SetFieldAt(assignment.substr(0, equals), assignment.substr(equals + 1), config);
    const std::vector<ConfigFault> faults = CheckParameters(*config, nullptr);
    if (!faults.empty()) throw ConfigError(faults[0].text);
  } catch (const ConfigError& error) {
    throw ConfigError("--set " + assignment + ": " + error.what());
  }
}

std::vector<std::string> FieldNames(const Descriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.field_count(); ++i) names.push_back(type.field(i)->name());
  return names;
}

}  // namespace declutter::runtime
