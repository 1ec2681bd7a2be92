#include "launcher/resolved_graph.h"

#include <sstream>

namespace declutter::launcher {
namespace {

std::string Indented(const std::string& text, size_t num_spaces) {
  std::istringstream lines(text);
  std::string indented;
  for (std::string line; std::getline(lines, line);) {
    indented += std::string(num_spaces, ' ') + line + "\n";
  }
  return indented;
}

std::string Text(const ResolvedModule& resolved) {
  Module module = resolved.module;
  const std::string type = module.config().type_url();
  module.clear_config();
  return "module {\n" + Indented(module.DebugString(), 2) + "  config {\n    [" + type + "] {\n" +
         Indented(resolved.config_text, 6) + "    }\n  }\n}\n";
}

}  // namespace

std::string ResolvedGraph::Text() const {
  std::string text = lossless ? "lossless: true\n" : "lossless: false\n";
  for (const std::string& channel : external) text += "external: \"" + channel + "\"\n";
  if (logger) text += "logger {\n" + Indented(logger->DebugString(), 2) + "}\n";
  for (const ResolvedModule& resolved : modules) text += launcher::Text(resolved);
  return text;
}

std::string ResolvedGraph::Versions() const {
  std::string text;
  for (const ResolvedModule& resolved : modules) {
    text += resolved.module.program() + " " + resolved.version + "\n";
  }
  return text;
}

}  // namespace declutter::launcher
