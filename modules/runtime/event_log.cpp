#include "modules/runtime/event_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "modules/runtime/config_error.h"
#include "modules/runtime/message_layout.h"

namespace declutter::runtime {
namespace {

// Sync word, event number, time, length of the channel, length of the message; big-endian.
constexpr std::size_t kHeaderBytes = 4 + 8 + 8 + 4 + 4;
constexpr std::uint32_t kSync = 0xEDA1DA01;

void Append(std::uint64_t value, int size, Bytes* bytes) {
  for (int shift = 8 * (size - 1); shift >= 0; shift -= 8) {
    bytes->push_back(static_cast<std::uint8_t>((value >> shift) & 0xFF));
  }
}

std::string ErrorText() { return std::system_category().message(errno); }

}  // namespace

EventLogReader::EventLogReader(const std::string& path) : path_(path) {
  std::error_code error;
  size_ = std::filesystem::file_size(path, error);
  if (error) throw std::runtime_error(path + ": cannot be read (" + error.message() + ')');
  if (size_ == 0) throw std::runtime_error(path + ": holds no events (0 byte)");
  file_.open(path, std::ios::binary);
  if (!file_) throw std::runtime_error(path + ": cannot be opened (" + ErrorText() + ')');
}

std::runtime_error EventLogReader::Broken(const std::string& what) const {
  return std::runtime_error(path_ + ": " + what + " after " + std::to_string(num_events_) +
                            " events (byte " + std::to_string(offset_) + ')');
}

std::optional<LogEvent> EventLogReader::Next() {
  if (offset_ >= size_) return std::nullopt;
  std::array<std::uint8_t, kHeaderBytes> header;
  if (size_ - offset_ < kHeaderBytes) throw Broken("cut off");
  file_.read(reinterpret_cast<char*>(header.data()), kHeaderBytes);
  if (!file_) throw Broken("cannot be read");
  if (static_cast<std::uint32_t>(ReadInteger(header.data(), 4)) != kSync) {
    throw Broken("is not an LCM log");
  }
  const std::int64_t channel_bytes = ReadInteger(header.data() + 20, 4);
  const std::int64_t message_bytes = ReadInteger(header.data() + 24, 4);
  if (channel_bytes < 1 || message_bytes < 0) throw Broken("has a damaged event");
  const std::uint64_t end = offset_ + kHeaderBytes + static_cast<std::uint64_t>(channel_bytes) +
                            static_cast<std::uint64_t>(message_bytes);
  if (end > size_) throw Broken("cut off");
  LogEvent event{ReadInteger(header.data() + 12, 8),
                 std::string(static_cast<std::size_t>(channel_bytes), '\0'),
                 Bytes(static_cast<std::size_t>(message_bytes))};
  file_.read(event.channel.data(), channel_bytes);
  file_.read(reinterpret_cast<char*>(event.message.data()), message_bytes);
  if (!file_) throw Broken("cannot be read");
  last_ = offset_;
  offset_ = end;
  ++num_events_;
  return event;
}

bool EventLogReader::SkipDamage() {
  constexpr std::uint64_t kBlock = 1 << 16;
  constexpr std::uint64_t kSyncBytes = 4;
  file_.clear();
  std::uint64_t begin = std::max(last_, floor_) + 1;
  for (; begin + kHeaderBytes <= size_; begin += kBlock - kSyncBytes + 1) {
    Bytes block(std::min(kBlock, size_ - begin));
    file_.seekg(static_cast<std::streamoff>(begin));
    file_.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size()));
    if (!file_) return false;
    for (std::uint64_t i = 0; i + kSyncBytes <= block.size(); ++i) {
      if (begin + i == offset_) continue;
      if (static_cast<std::uint32_t>(ReadInteger(block.data() + i, kSyncBytes)) != kSync) continue;
      offset_ = floor_ = begin + i;
      file_.seekg(static_cast<std::streamoff>(offset_));
      return true;
    }
  }
  return false;
}

EventLogWriter::EventLogWriter(const std::string& path)
    : path_(path), fd_(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)) {
  if (fd_ >= 0) return;
  if (errno == EEXIST) throw ConfigError(path + ": exists already and is not overwritten");
  throw std::runtime_error(path + ": cannot be made (" + ErrorText() + ')');
}

EventLogWriter::~EventLogWriter() { close(fd_); }

void EventLogWriter::Write(const LogEvent& event) {
  Bytes bytes;
  bytes.reserve(kHeaderBytes + event.channel.size() + event.message.size());
  Append(kSync, 4, &bytes);
  Append(static_cast<std::uint64_t>(num_events_++), 8, &bytes);
  Append(static_cast<std::uint64_t>(event.utime), 8, &bytes);
  Append(event.channel.size(), 4, &bytes);
  Append(event.message.size(), 4, &bytes);
  bytes.insert(bytes.end(), event.channel.begin(), event.channel.end());
  bytes.insert(bytes.end(), event.message.begin(), event.message.end());
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = write(fd_, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw std::runtime_error(path_ + ": cannot be written (" + ErrorText() + ')');
    done += static_cast<std::size_t>(written);
  }
}

}  // namespace declutter::runtime
