#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/process/graph_run.h"
#include "tests/process/launched.h"

namespace declutter {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(GoldenReplay, ShowsWhatDiffersUntilTheReferenceIsRewritten) {
  const TemporaryFolder folder;
  const std::string golden = folder.Path("golden"), text = golden + "/tabletop.txt";
  fs::copy(std::string(CONFIG_FOLDER) + "/../tests/data/golden", golden);
  const auto replay = [&](const std::vector<std::string>& options) {
    std::vector<std::string> words = {Program("golden_replay"), golden};
    words.insert(words.end(), options.begin(), options.end());
    return Launched(words, folder).Wait();
  };
  std::string other = ReadFile(text);
  const std::string height = "height 619.0";
  ASSERT_NE(other.find(height), std::string::npos);
  folder.Write("golden/tabletop.txt",
               other.replace(other.find(height), height.size(), "height 600.0"));
  const Outcome differs = replay({});
  EXPECT_EQ(differs.code, 1) << differs.err;
  EXPECT_THAT(differs.out, HasSubstr("== 1_apart\n- plane normal"));
  EXPECT_THAT(differs.out, HasSubstr("(height 600.0 -> 619.0, may differ by 0.5)\n"));
  EXPECT_EQ(replay({"--rewrite"}).code, 0);
  EXPECT_EQ(replay({}).code, 0);
  EXPECT_THAT(ReadFile(text), HasSubstr(height));
  EXPECT_EQ(replay({"--rewirte"}).code, 2);
}

}  // namespace
}  // namespace declutter
