#include "modules/runtime/text_faults.h"

#include <sstream>

#include "modules/runtime/config.h"
#include "modules/runtime/suggestion.h"

namespace declutter::runtime {

void ExplainUnknownField(
    const std::string& text,
    const std::function<const google::protobuf::Descriptor*(const std::string&)>& find_type,
    ConfigFault* fault) {
  if (fault->text.find("\" has no field named \"") == std::string::npos) return;
  std::istringstream words(fault->text);
  std::string skipped, type_name, name;
  std::getline(words, skipped, '"');
  std::getline(words, type_name, '"');
  std::getline(words, skipped, '"');
  std::getline(words, name, '"');
  const google::protobuf::Descriptor* type = find_type(type_name);
  fault->text = "no field named '" + name + "' in " + type_name +
                (type != nullptr ? Suggestion(name, FieldNames(*type)) : "");
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < fault->line; ++i) std::getline(lines, line);
  const std::size_t start = line.rfind(name, static_cast<std::size_t>(fault->column));
  if (start != std::string::npos) fault->column = static_cast<int>(start) + 1;
}

}  // namespace declutter::runtime
