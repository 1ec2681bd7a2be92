#include "modules/runtime/parameter_check.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "modules/runtime/parameter.pb.h"
#include "modules/runtime/suggestion.h"

namespace declutter::runtime {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::Reflection;
using google::protobuf::TextFormat;

std::string Text(const Message& message, const FieldDescriptor& field, int index) {
  std::string text;
  TextFormat::PrintFieldValueToString(message, &field, index, &text);
  return text;
}

// index: of a repeated field's element, -1 for a singular field. nullopt: not a number.
std::optional<double> Number(const Message& message, const FieldDescriptor& field, int index) {
  const Reflection& r = *message.GetReflection();
  const bool one = index < 0;
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return one ? r.GetInt32(message, &field) : r.GetRepeatedInt32(message, &field, index);
    case FieldDescriptor::CPPTYPE_UINT32:
      return one ? r.GetUInt32(message, &field) : r.GetRepeatedUInt32(message, &field, index);
    case FieldDescriptor::CPPTYPE_INT64:
      return static_cast<double>(one ? r.GetInt64(message, &field)
                                     : r.GetRepeatedInt64(message, &field, index));
    case FieldDescriptor::CPPTYPE_UINT64:
      return static_cast<double>(one ? r.GetUInt64(message, &field)
                                     : r.GetRepeatedUInt64(message, &field, index));
    case FieldDescriptor::CPPTYPE_FLOAT:
      return one ? r.GetFloat(message, &field) : r.GetRepeatedFloat(message, &field, index);
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return one ? r.GetDouble(message, &field) : r.GetRepeatedDouble(message, &field, index);
    default:
      return std::nullopt;
  }
}

std::string CheckNumber(double value, const FieldDescriptor& field) {
  const Parameter& parameter = field.options().GetExtension(declutter::parameter);
  if (std::isnan(value)) return " is not a number";
  const bool inside = (!parameter.has_min() || value >= parameter.min()) &&
                      (!parameter.has_max() || value <= parameter.max());
  if (!inside) return " outside " + RangeText(field);
  return std::isinf(value) ? " is not finite" : "";
}

std::string CheckString(const std::string& value, const FieldDescriptor& field) {
  const auto& allowed = field.options().GetExtension(declutter::parameter).one_of();
  if (allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end()) {
    return "";
  }
  std::string list;
  for (const std::string& one : allowed) list += (list.empty() ? "\"" : ", \"") + one + '"';
  return " is not one of " + list + Suggestion(value, {allowed.begin(), allowed.end()});
}

// What is wrong with one value, to follow its name and text; empty: nothing.
std::string CheckValue(const Message& message, const FieldDescriptor& field, int index) {
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    const Reflection& reflection = *message.GetReflection();
    return CheckString(index < 0 ? reflection.GetString(message, &field)
                                 : reflection.GetRepeatedString(message, &field, index),
                       field);
  }
  const std::optional<double> number = Number(message, field, index);
  return number ? CheckNumber(*number, field) : "";
}

void Check(const Message& message, const TextFormat::ParseInfoTree* locations,
           const std::string& path, std::vector<ConfigFault>* faults) {
  const Reflection& reflection = *message.GetReflection();
  std::vector<const FieldDescriptor*> fields;
  reflection.ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    const int count = field->is_repeated() ? reflection.FieldSize(message, field) : 1;
    for (int i = 0; i < count; ++i) {
      const int index = field->is_repeated() ? i : -1;
      if (field->message_type() != nullptr) {
        const Message& nested = index < 0 ? reflection.GetMessage(message, field)
                                          : reflection.GetRepeatedMessage(message, field, index);
        const auto* tree = locations ? locations->GetTreeForNested(field, index) : nullptr;
        Check(nested, tree, path + field->name() + '.', faults);
        continue;
      }
      const std::string fault = CheckValue(message, *field, index);
      if (fault.empty()) continue;
      const auto where =
          locations ? locations->GetLocation(field, index) : TextFormat::ParseLocation();
      faults->push_back({where.line + 1, where.column + 1,
                         path + field->name() + " = " + Text(message, *field, index) + fault});
    }
  }
}

bool IsSet(const Message& message, const FieldDescriptor& field) {
  const Reflection& reflection = *message.GetReflection();
  if (field.is_repeated()) return reflection.FieldSize(message, &field) > 0;
  if (!reflection.HasField(message, &field)) return false;
  return field.cpp_type() != FieldDescriptor::CPPTYPE_STRING ||
         !reflection.GetString(message, &field).empty();
}

}  // namespace

std::vector<ConfigFault> CheckParameters(const Message& config,
                                         const TextFormat::ParseInfoTree* locations) {
  std::vector<ConfigFault> faults;
  Check(config, locations, "", &faults);
  return faults;
}

void CheckComplete(const Message& config) {
  const google::protobuf::Descriptor& type = *config.GetDescriptor();
  for (int i = 0; i < type.field_count(); ++i) {
    const FieldDescriptor& field = *type.field(i);
    const Parameter& parameter = field.options().GetExtension(declutter::parameter);
    if (!parameter.required() || IsSet(config, field)) continue;
    throw ConfigError(field.name() + " must be set (" + parameter.doc() + ')');
  }
}

std::string RangeText(const FieldDescriptor& field) {
  const Parameter& parameter = field.options().GetExtension(declutter::parameter);
  if (!parameter.has_min() && !parameter.has_max()) return "";
  const auto bound = [&parameter](const char* name) {
    return Text(parameter, *Parameter::descriptor()->FindFieldByName(name), -1);
  };
  const std::string low = parameter.has_min() ? '[' + bound("min") : "(-inf";
  const std::string high = parameter.has_max() ? bound("max") + ']' : "inf)";
  return low + ", " + high + (parameter.unit().empty() ? "" : ' ' + parameter.unit());
}

}  // namespace declutter::runtime
