#include "launcher/graph_text.h"

#include <google/protobuf/empty.pb.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <filesystem>
#include <sstream>
#include <utility>

#include "modules/runtime/parameter_check.h"
#include "modules/runtime/text_faults.h"

namespace declutter::launcher {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::TextFormat;
using runtime::ConfigFault;

// Takes every Any for a message without fields.
class AnyIsEmpty : public TextFormat::Finder {
 public:
  const Descriptor* FindAnyType(const google::protobuf::Message&, const std::string&,
                                const std::string&) const override {
    return google::protobuf::Empty::descriptor();
  }
};

const Descriptor* FindType(const std::string& full_name, const ProgramCatalog* catalog) {
  const auto* own = google::protobuf::DescriptorPool::generated_pool();
  const Descriptor* type = catalog == nullptr ? nullptr : catalog->FindType(full_name);
  return type != nullptr ? type : own->FindMessageTypeByName(full_name);
}

}  // namespace

GraphText::GraphText(std::string text, std::string file)
    : text_(std::move(text)), file_(std::move(file)) {}

std::string GraphText::PathFromHere(const std::string& path) const {
  return std::filesystem::absolute(file_).parent_path() / path;
}

std::string GraphText::WhereInclude(int index) const {
  const auto location =
      locations_->GetLocation(Graph::descriptor()->FindFieldByName("include"), index);
  return Where(location.line + 1, location.column + 1);
}

bool GraphText::ReadModules(std::vector<Fault>* faults) {
  std::istringstream lines(text_);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    const auto size = static_cast<int>(line.size());
    if (google::protobuf::internal::IsStructurallyValidUTF8(line.data(), size)) continue;
    faults->push_back({Where(number, 1), "not UTF-8 text"});
    return false;
  }
  return Read(AnyIsEmpty(), true, nullptr, faults);
}

bool GraphText::ReadAll(const ProgramCatalog& catalog, std::vector<Fault>* faults) {
  if (!Read(catalog, false, &catalog, faults)) return false;
  const auto found = runtime::CheckParameters(graph_, locations_.get());
  for (const ConfigFault& fault : found) {
    faults->push_back({Where(fault.line, fault.column), fault.text});
  }
  return found.empty();
}

bool GraphText::Read(const TextFormat::Finder& finder, bool skips_unknown,
                     const ProgramCatalog* catalog, std::vector<Fault>* faults) {
  runtime::FaultCollector collector;
  locations_ = std::make_unique<TextFormat::ParseInfoTree>();
  TextFormat::Parser parser;
  parser.SetFinder(&finder);
  parser.AllowUnknownField(skips_unknown);
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(locations_.get());
  google::protobuf::io::ArrayInputStream stream(text_.data(), static_cast<int>(text_.size()));
  const bool is_parsed = parser.Parse(&stream, &graph_);
  // What is unknown inside an Any is to be skipped, and nothing else.
  const std::string in_any = "\"" + google::protobuf::Empty::descriptor()->full_name() + "\"";
  for (const ConfigFault& warning : collector.warnings) {
    if (warning.text.find(in_any) == std::string::npos) collector.faults.push_back(warning);
  }
  if (is_parsed && collector.faults.empty()) return true;
  if (collector.faults.empty()) collector.faults.push_back({1, 1, "cannot be parsed"});
  for (ConfigFault& fault : collector.faults) {
    runtime::ExplainUnknownField(
        text_, [catalog](const std::string& name) { return FindType(name, catalog); }, &fault);
    faults->push_back({Where(fault.line, fault.column), fault.text});
  }
  return false;
}

std::string GraphText::Where(int line, int column) const {
  return file_ + ":" + std::to_string(line) + ":" + std::to_string(column);
}

std::string GraphText::Where(int module, const std::string& field) const {
  TextFormat::ParseLocation location;
  if (const auto* tree = Locations(module)) {
    const auto* descriptor = Module::descriptor()->FindFieldByName(field);
    const auto* fields = graph_.module(module).GetReflection();
    const bool is_list = descriptor != nullptr && descriptor->is_repeated();
    if (!is_list || fields->FieldSize(graph_.module(module), descriptor) > 0) {
      location = tree->GetLocation(descriptor, is_list ? 0 : -1);
    }
  }
  if (location.line < 0) {
    location = locations_->GetLocation(Graph::descriptor()->FindFieldByName("module"), module);
  }
  return Where(location.line + 1, location.column + 1);
}

void GraphText::CheckConfig(int module, const google::protobuf::Message& config,
                            std::vector<Fault>* faults) const {
  const auto* field = Module::descriptor()->FindFieldByName("config");
  const auto* tree = Locations(module);
  for (const ConfigFault& fault : runtime::CheckParameters(
           config, tree == nullptr ? nullptr : tree->GetTreeForNested(field, -1))) {
    faults->push_back(
        {fault.line == 0 ? Where(module, "config") : Where(fault.line, fault.column), fault.text});
  }
}

const TextFormat::ParseInfoTree* GraphText::Locations(int module) const {
  return locations_->GetTreeForNested(Graph::descriptor()->FindFieldByName("module"), module);
}

}  // namespace declutter::launcher
