#include <gmock/gmock.h>
#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "launcher/load_graph.h"
#include "tests/process/fake_graph.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

using launcher::Fault;
using testing::IsEmpty;
using testing::MatchesRegex;

std::vector<std::string> printed;  // by protobuf, to stderr of a user

void KeepPrinted(google::protobuf::LogLevel, const char*, int, const std::string& text) {
  printed.push_back(text);
}

// Does to the text what typing errors, merges and broken editors do.
std::string Mutated(std::string text, std::mt19937* random) {
  const auto any = [random](size_t end) { return static_cast<size_t>((*random)()) % end; };
  const std::string marks = "{}[]<>:;,#\"'\\/\n\t -.0123456789eE\x01\x7f\xff";
  const size_t num_edits = 1 + any(3);
  for (size_t edit = 0; edit < num_edits && !text.empty(); ++edit) {
    const size_t begin = any(text.size());
    const size_t length = 1 + any(std::min<size_t>(30, text.size() - begin));
    switch (any(5)) {
      case 0:
        text.erase(begin, length);
        break;
      case 1:
        text[begin] = marks[any(marks.size())];
        break;
      case 2:
        text.insert(begin, 1, marks[any(marks.size())]);
        break;
      case 3:
        text.insert(any(text.size()), text.substr(begin, length));
        break;
      case 4:
        std::swap(text[begin], text[any(text.size())]);
        break;
    }
  }
  return text;
}

TEST(MutatedGraphTest, TenThousandBrokenGraphsGiveOnlyPlacesAndReasons) {
  const TemporaryFolder folder;
  // A graph with all that one can say, the graph that it includes, and parameters in a file.
  const std::vector<std::pair<std::string, std::string>> files = {
      {"graph.textproto",
       "include: \"included.textproto\"\nlossless: true\n" +
           Block(
               "filter", "fake_filter",
               "remap { from: \"OBJECTS\" to: \"OBJECTS\" } grace_period_s: 2.5 after: \"last\" " +
                   FilterConfig("mishap: \"crashes\"\n at_frame: 3")) +
           "logger { name: \"run\" split_mb: 10 }\nmodule { name: \"source\" nice: 3 }\n"},
      {"included.textproto",
       Block("source", "fake_source",
             "restart: \"always\" env: \"A=1\" cpu: 0 config_file: \"source.textproto\" " +
                 SourceConfig("num_frames: 7")) +
           Block("other", "fake_filter",
                 "group: \"last\" remap { from: \"OBJECTS\" to: \"MORE\" }")},
      {"source.textproto", "num_frames: 9\nperiod_s: 0.5\nfails: true\n"}};
  for (const auto& [name, text] : files) folder.Write(name, text);
  google::protobuf::SetLogHandler(KeepPrinted);
  launcher::ProgramCatalog catalog;
  const auto load = [&](std::vector<Fault>* faults) {
    return launcher::LoadGraph(folder.Path("graph.textproto"), {}, {}, &catalog, faults)
        .has_value();
  };
  std::vector<Fault> none;
  ASSERT_TRUE(load(&none)) << none.at(0).what;
  std::mt19937 random(1);
  int num_refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    const auto& [name, good] = files[random() % files.size()];
    const std::string text = Mutated(good, &random);
    folder.Write(name, text);
    std::vector<Fault> faults;
    const bool is_good = load(&faults);
    ASSERT_EQ(is_good, faults.empty()) << text;
    num_refused += is_good ? 0 : 1;
    for (const Fault& fault : faults) {
      ASSERT_THAT(fault.where + (fault.where.empty() ? "" : ": ") + fault.what,
                  MatchesRegex(".*/[a-z]+.textproto:[0-9]+:[0-9]+: .+"))
          << text;
    }
    folder.Write(name, good);
  }
  google::protobuf::SetLogHandler(nullptr);
  EXPECT_THAT(printed, IsEmpty());
  EXPECT_GT(num_refused, 5'000);
}

}  // namespace
}  // namespace declutter
