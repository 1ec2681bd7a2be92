#include "launcher/rotating_log.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace declutter::launcher {
namespace {

class RotatingLogTest : public testing::Test {
 protected:
  RotatingLogTest() {
    std::string name = std::filesystem::temp_directory_path() / "rotating_log_XXXXXX";
    folder_ = mkdtemp(name.data());
    path_ = folder_ + "/log";
  }
  ~RotatingLogTest() override { std::filesystem::remove_all(folder_); }

  static std::string Read(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string folder_;
  std::string path_;
};

TEST_F(RotatingLogTest, AppendsToWhatIsThere) {
  for (const char* text : {"one\n", "two\n"}) RotatingLog(path_, 100).Write(text);
  EXPECT_EQ(Read(path_), "one\ntwo\n");
}

TEST_F(RotatingLogTest, KeepsTheLastFullFileAndTheNewOne) {
  RotatingLog log(path_, 10);
  for (int i = 0; i < 100; ++i) log.Write("line " + std::to_string(i) + "\n");
  EXPECT_EQ(Read(path_), "line 99\n");
  EXPECT_EQ(Read(path_ + ".1"), "line 98\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 2);
}

TEST_F(RotatingLogTest, WritesALineThatIsLongerThanAFile) {
  RotatingLog log(path_, 3);
  log.Write("a long line\n");
  log.Write("b\n");
  EXPECT_EQ(Read(path_), "b\n");
  EXPECT_EQ(Read(path_ + ".1"), "a long line\n");
}

TEST_F(RotatingLogTest, TellsThatTheDiskIsFullAndKeepsWhatWasWrittenBefore) {
  RotatingLog log("/dev/full", 10);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(log.Write("a line\n"), ENOSPC);
  EXPECT_FALSE(std::filesystem::exists("/dev/full.1"));
}

TEST_F(RotatingLogTest, NamesAFileThatCannotBeOpened) {
  EXPECT_THROW(RotatingLog(folder_ + "/none/log", 3), std::runtime_error);
}

}  // namespace
}  // namespace declutter::launcher
