#include "launcher/timed_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace declutter::launcher {
namespace {

using testing::ElementsAre;

class TimedLogTest : public testing::Test {
 protected:
  ~TimedLogTest() override { std::filesystem::remove(path_); }

  // When the events of a log are read that were recorded at these times.
  std::vector<double> TimesOf(const std::vector<int64_t>& utimes) {
    std::filesystem::remove(path_);
    {
      runtime::EventLogWriter writer(path_);
      for (const int64_t utime : utimes) writer.Write({utime, "OBJECTS", {}});
    }
    std::vector<double> times_s;
    TimedLog log(path_);
    while (const auto timed = log.Next()) times_s.push_back(timed->at_s);
    return times_s;
  }

  const std::string path_ = testing::TempDir() + "timed_log_test_" + std::to_string(getpid());
};

constexpr int64_t kStart = 1'700'000'000'000'000;
constexpr int64_t kTenth = 100'000;

TEST_F(TimedLogTest, CountsFromTheFirstEvent) {
  EXPECT_THAT(TimesOf({kStart, kStart + kTenth, kStart + 3 * kTenth}), ElementsAre(0.0, 0.1, 0.3));
}

TEST_F(TimedLogTest, DoesNotBelieveASingleTimeThatIsFarOff) {
  for (size_t i = 0; i < 4; ++i) {
    for (int byte = 0; byte < 8; ++byte) {
      std::vector<int64_t> utimes;
      for (int64_t k = 0; k < 4; ++k) utimes.push_back(kStart + k * kTenth);
      utimes[i] ^= static_cast<int64_t>(uint64_t{0xFF} << (8 * byte));
      const std::vector<double> times_s = TimesOf(utimes);
      EXPECT_TRUE(std::is_sorted(times_s.begin(), times_s.end()));
      EXPECT_LE(times_s.back(), 20.0) << "byte " << byte << " of event " << i;
    }
  }
}

TEST_F(TimedLogTest, GoesOnWhereTheClockWasSetBack) {
  std::vector<int64_t> utimes;
  for (int64_t k = 0; k < 10; ++k) utimes.push_back((k < 5 ? kStart : 0) + k * kTenth);
  const std::vector<double> times_s = TimesOf(utimes);
  EXPECT_TRUE(std::is_sorted(times_s.begin(), times_s.end()));
  EXPECT_NEAR(times_s.back() - times_s[6], 0.3, 1e-9);
  EXPECT_LE(times_s.back(), 0.9);
}

TEST_F(TimedLogTest, DoesNotBelieveATimeBesideADamageEither) {
  for (const int64_t wrong : {int64_t{0}, 2 * kStart}) {
    TimesOf({kStart, kStart + kTenth, wrong, kStart + 3 * kTenth, kStart + 4 * kTenth,
             kStart + 5 * kTenth});
    const auto event_bytes = static_cast<std::streamoff>(std::filesystem::file_size(path_) / 6);
    std::fstream(path_, std::ios::binary | std::ios::in | std::ios::out)
        .seekp(3 * event_bytes)
        .put('x');
    TimedLog log(path_);
    for (int i = 0; i < 3; ++i) ASSERT_TRUE(log.Next());
    EXPECT_THROW(log.Next(), std::runtime_error);
    ASSERT_TRUE(log.SkipDamage());
    ASSERT_TRUE(log.Next());
    EXPECT_LE(log.Next()->at_s, 20.0);
  }
}

TEST_F(TimedLogTest, GivesWhatIsBeforeADamageAndBehindIt) {
  TimesOf({kStart, kStart + kTenth, kStart + 2 * kTenth});
  const auto event_bytes = static_cast<std::streamoff>(std::filesystem::file_size(path_) / 3);
  std::fstream(path_, std::ios::binary | std::ios::in | std::ios::out).seekp(event_bytes).put('x');
  TimedLog log(path_);
  EXPECT_EQ(log.Next()->at_s, 0.0);
  EXPECT_THROW(log.Next(), std::runtime_error);
  ASSERT_TRUE(log.SkipDamage());
  EXPECT_NEAR(log.Next()->at_s, 0.2, 1e-9);
  EXPECT_FALSE(log.Next());
}

}  // namespace
}  // namespace declutter::launcher
