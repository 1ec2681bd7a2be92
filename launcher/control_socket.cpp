#include "launcher/control_socket.h"

#include <fcntl.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace declutter::launcher {
namespace {

constexpr const char* kName = "control";
constexpr size_t kMaxRequest = 16 << 20;  // [byte]

int OpenSocket(int flags) {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | flags, 0);
  if (fd < 0) throw std::runtime_error(std::string("socket: ") + strerror(errno));
  return fd;
}

// The path of a socket has room for 107 characters; the folder's number is always short enough.
class Address {
 public:
  explicit Address(const std::string& folder)
      : folder_fd_(open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC)) {
    if (folder_fd_ < 0) throw std::runtime_error(folder + ": " + strerror(errno));
    address_.sun_family = AF_UNIX;
    const std::string path = "/proc/self/fd/" + std::to_string(folder_fd_) + "/" + kName;
    strncpy(address_.sun_path, path.c_str(), sizeof(address_.sun_path) - 1);
  }
  ~Address() { close(folder_fd_); }
  Address(const Address&) = delete;
  Address& operator=(const Address&) = delete;

  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&address_); }
  socklen_t size() const { return sizeof(address_); }

 private:
  int folder_fd_;
  sockaddr_un address_ = {};
};

// False when the other side is gone.
bool SendAll(int fd, const std::string& text) {
  for (size_t done = 0; done < text.size();) {
    const ssize_t sent = send(fd, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    done += static_cast<size_t>(sent);
  }
  return true;
}

}  // namespace

ControlSocket::ControlSocket(const std::string& folder) : fd_(OpenSocket(SOCK_NONBLOCK)) {
  const Address address(folder);
  if (bind(fd_, address.get(), address.size()) != 0 || listen(fd_, 16) != 0) {
    const std::string why = strerror(errno);
    close(fd_);
    throw std::runtime_error(folder + "/" + kName + ": " + why);
  }
}

ControlSocket::~ControlSocket() {
  for (const auto& [connection, text] : incoming_) close(connection);
  close(fd_);
}

std::vector<std::pair<ControlSocket::Id, ControlRequest>> ControlSocket::Receive() {
  for (;;) {
    const int connection = accept4(fd_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (connection < 0) break;
    incoming_[connection];
  }
  std::vector<std::pair<Id, ControlRequest>> requests;
  for (auto entry = incoming_.begin(); entry != incoming_.end();) {
    if (!ReadAll(entry->first, &entry->second)) {
      ++entry;
      continue;
    }
    ControlRequest request;  // what cannot be parsed is answered as an unknown verb
    if (!request.ParseFromString(entry->second)) request.Clear();
    requests.emplace_back(entry->first, std::move(request));
    entry = incoming_.erase(entry);
  }
  return requests;
}

bool ControlSocket::ReadAll(int connection, std::string* text) const {
  char buffer[4096];
  for (;;) {
    const ssize_t num_read = read(connection, buffer, sizeof(buffer));
    if (num_read < 0 && errno == EINTR) continue;
    if (num_read < 0) return errno != EAGAIN;
    if (num_read == 0 || text->size() > kMaxRequest) return true;
    text->append(buffer, static_cast<size_t>(num_read));
  }
}

void ControlSocket::Answer(Id id, const ControlReply& reply) {
  SendAll(id, reply.SerializeAsString());  // whoever asked may have left
  close(id);
}

ControlReply AskLauncher(const std::string& folder, const ControlRequest& request) {
  const Address address(folder);
  const int fd = OpenSocket(0);
  std::string text;
  const bool is_asked = connect(fd, address.get(), address.size()) == 0 &&
                        SendAll(fd, request.SerializeAsString()) && shutdown(fd, SHUT_WR) == 0;
  char buffer[4096];
  ssize_t num_read = is_asked ? 1 : 0;
  while (num_read > 0 || (num_read < 0 && errno == EINTR)) {
    num_read = read(fd, buffer, sizeof(buffer));
    if (num_read > 0) text.append(buffer, static_cast<size_t>(num_read));
  }
  close(fd);
  ControlReply reply;
  if (!is_asked) throw std::runtime_error(folder + ": no graph runs there");
  if (text.empty() || !reply.ParseFromString(text)) {
    throw std::runtime_error(folder + ": the graph ended before it answered");
  }
  return reply;
}

}  // namespace declutter::launcher
