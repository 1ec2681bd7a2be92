#pragma once

#include <string>

#include "tests/process/launched.h"

namespace declutter {

inline std::string Fake(const std::string& program) {
  return std::string(FAKE_FOLDER) + "/" + program;
}

// source -> filter, lossless, with these fields added to the block of each.
inline std::string FakeGraph(const TemporaryFolder& folder, const std::string& source_fields,
                             const std::string& filter_fields) {
  return folder.Write("graph.textproto",
                      "lossless: true\n"
                      "module { name: \"source\" program: \"" +
                          Fake("fake_source") + "\"\n" + source_fields + "\n}\n" +
                          "module { name: \"filter\" program: \"" + Fake("fake_filter") + "\"\n" +
                          filter_fields + "\n}\n");
}

// Parameters of the two as a module's config.
inline std::string SourceConfig(const std::string& fields) {
  return "config { [type.googleapis.com/declutter.FakeSourceConfig] { " + fields + " } }";
}
inline std::string FilterConfig(const std::string& fields) {
  return "config { [type.googleapis.com/declutter.FakeFilterConfig] { " + fields + " } }";
}

}  // namespace declutter
