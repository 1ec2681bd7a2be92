#include <gmock/gmock.h>
#include <google/protobuf/stubs/logging.h>
#include <gtest/gtest.h>

#include <random>

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
  const std::string good = ReadFile(
      FakeGraph(folder, "restart: \"always\" env: \"A=1\" cpu: 0 " + SourceConfig("num_frames: 7"),
                "remap { from: \"OBJECTS\" to: \"OBJECTS\" } grace_period_s: 2.5 " +
                    FilterConfig("mishap: \"crashes\"\n at_frame: 3")));
  google::protobuf::SetLogHandler(KeepPrinted);
  launcher::ProgramCatalog catalog;
  std::mt19937 random(1);
  int num_refused = 0;
  for (int i = 0; i < 10'000; ++i) {
    const std::string text = Mutated(good, &random);
    const std::string path = folder.Write("mutated.textproto", text);
    std::vector<Fault> faults;
    const auto graph = launcher::LoadGraph(path, {}, {}, &catalog, &faults);
    ASSERT_NE(graph.has_value(), !faults.empty()) << text;
    num_refused += graph ? 0 : 1;
    for (const Fault& fault : faults) {
      ASSERT_THAT(fault.where, MatchesRegex(".*mutated.textproto:[0-9]+:[0-9]+")) << text;
      ASSERT_FALSE(fault.what.empty()) << text;
    }
  }
  google::protobuf::SetLogHandler(nullptr);
  EXPECT_THAT(printed, IsEmpty());
  EXPECT_GT(num_refused, 5'000);
}

}  // namespace
}  // namespace declutter
