#include "modules/scene_renderer/scene_text.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "modules/scene_renderer/layout.h"

namespace declutter {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::TextFormat;

// Faults by place, one line each.
class Faults : public google::protobuf::io::ErrorCollector {
 public:
  explicit Faults(const std::string& name) : name_(name) {}

  // Lines and columns count from 0, -1 is an unknown place.
  void AddError(int line, int column, const std::string& message) override {
    if (!text_.empty()) text_ += "\n";
    text_ += name_ + ":" + std::to_string(std::max(0, line) + 1) + ":" +
             std::to_string(std::max(0, column) + 1) + ": " + message;
  }
  const std::string& text() const { return text_; }

 private:
  std::string name_;
  std::string text_;
};

std::string Text(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

// Value of a number that may have a range; 0 for other kinds of field.
double NumberOf(const Message& message, const FieldDescriptor& field) {
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return reflection.GetInt32(message, &field);
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return reflection.GetDouble(message, &field);
    default:
      return 0;
  }
}

std::string FaultOfValue(const Message& message, const FieldDescriptor& field) {
  const Parameter& parameter = field.options().GetExtension(declutter::parameter);
  if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
    const std::string value = message.GetReflection()->GetString(message, &field);
    const auto& allowed = parameter.one_of();
    if (allowed.empty() || std::find(allowed.begin(), allowed.end(), value) != allowed.end()) {
      return "";
    }
    std::string fault = field.name() + " = \"" + value + "\" is none of";
    for (const std::string& choice : allowed) fault += " \"" + choice + "\"";
    return fault;
  }
  const double value = NumberOf(message, field);
  const double infinity = std::numeric_limits<double>::infinity();
  const double min = parameter.has_min() ? parameter.min() : -infinity;
  const double max = parameter.has_max() ? parameter.max() : infinity;
  if (value >= min && value <= max) return "";  // false for a value that is not a number
  return field.name() + " = " + Text(value) + " outside [" + Text(min) + ", " + Text(max) + "]" +
         (parameter.has_unit() ? " " + parameter.unit() : "");
}

void CheckValues(const Message& message, const TextFormat::ParseInfoTree& places, Faults* faults) {
  std::vector<const FieldDescriptor*> fields;
  message.GetReflection()->ListFields(message, &fields);
  for (const FieldDescriptor* field : fields) {
    if (field->cpp_type() != FieldDescriptor::CPPTYPE_MESSAGE) {
      const std::string fault = FaultOfValue(message, *field);
      const TextFormat::ParseLocation place = places.GetLocation(field, -1);
      if (!fault.empty()) faults->AddError(place.line, place.column, fault);
      continue;
    }
    const google::protobuf::Reflection& reflection = *message.GetReflection();
    if (!field->is_repeated()) {
      CheckValues(reflection.GetMessage(message, field), *places.GetTreeForNested(field, -1),
                  faults);
      continue;
    }
    for (int i = 0; i < reflection.FieldSize(message, field); ++i) {
      CheckValues(reflection.GetRepeatedMessage(message, field, i),
                  *places.GetTreeForNested(field, i), faults);
    }
  }
}

// Faults of the scene's meaning: at the camera or at the first object that cannot be put down.
void CheckMeaning(const Scene& scene, const TextFormat::ParseInfoTree& places, Faults* faults) {
  const google::protobuf::Descriptor& fields = *Scene::descriptor();
  try {
    CameraPose(scene.camera());
  } catch (const std::invalid_argument& fault) {
    const auto place = places.GetLocation(fields.FindFieldByNumber(Scene::kCameraFieldNumber), -1);
    faults->AddError(place.line, place.column, fault.what());
  }
  try {
    PlaceObjects(scene);
  } catch (const ObjectFault& fault) {
    const auto place =
        places.GetLocation(fields.FindFieldByNumber(Scene::kObjectFieldNumber), fault.object());
    faults->AddError(place.line, place.column, fault.what());
  }
}

}  // namespace

Scene ParseScene(const std::string& text, const std::string& name) {
  Scene scene;
  Faults faults(name);
  TextFormat::ParseInfoTree places;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&faults);
  parser.WriteLocationsTo(&places);
  const bool parsed = parser.ParseFromString(text, &scene);
  if (parsed) CheckValues(scene, places, &faults);
  if (faults.text().empty()) CheckMeaning(scene, places, &faults);
  if (!faults.text().empty()) throw std::invalid_argument(faults.text());
  return scene;
}

Scene ReadScene(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw std::invalid_argument(path + ": cannot be read");
  return ParseScene(text.str(), path);
}

std::string PrintScene(const Scene& scene) {
  std::string text;
  TextFormat::PrintToString(scene, &text);
  return text;
}

}  // namespace declutter
