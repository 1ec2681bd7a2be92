#pragma once

#include <string>

#include "tests/process/launched.h"

namespace declutter {

inline std::string Fake(const std::string& program) {
  return std::string(FAKE_FOLDER) + "/" + program;
}

// Process numbers of a fake program that runs as a module; one that only describes itself does not
// count.
inline std::vector<pid_t> ModulesOf(const std::string& program) {
  const std::string next_word(1, '\0');
  return ProcessesWith(Fake(program) + next_word + "--name");
}

// A module's block of a graph, with these further fields.
inline std::string Block(const std::string& name, const std::string& program,
                         const std::string& fields) {
  return "module { name: \"" + name + "\" program: \"" + Fake(program) + "\"\n" + fields + "\n}\n";
}

// source -> filter, lossless, with these fields added to the block of each.
inline std::string FakeGraph(const TemporaryFolder& folder, const std::string& source_fields,
                             const std::string& filter_fields) {
  return folder.Write("graph.textproto", "lossless: true\n" +
                                             Block("source", "fake_source", source_fields) +
                                             Block("filter", "fake_filter", filter_fields));
}

// Parameters of the two as a module's config.
inline std::string SourceConfig(const std::string& fields) {
  return "config { [type.googleapis.com/declutter.FakeSourceConfig] { " + fields + " } }";
}
inline std::string FilterConfig(const std::string& fields) {
  return "config { [type.googleapis.com/declutter.FakeFilterConfig] { " + fields + " } }";
}

// A camera of 50 Hz -> filter.
inline std::string LiveGraph(const TemporaryFolder& folder, const std::string& source_fields,
                             const std::string& filter_fields) {
  const std::string camera = SourceConfig("num_frames: 100000 period_s: 0.02");
  return folder.Write("graph.textproto", Block("source", "fake_source", camera + source_fields) +
                                             Block("filter", "fake_filter", filter_fields));
}

}  // namespace declutter
