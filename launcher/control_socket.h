#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "launcher/control.pb.h"

namespace declutter::launcher {

// Where a running launcher hears what its user wants. A request is all that is sent, a reply all
// that comes back.
class ControlSocket {
 public:
  using Id = int;  // of a request

  // In a run's folder. Throws std::runtime_error.
  explicit ControlSocket(const std::string& folder);
  ~ControlSocket();
  ControlSocket(const ControlSocket&) = delete;
  ControlSocket& operator=(const ControlSocket&) = delete;

  // Readable when somebody comes.
  int fd() const { return fd_; }

  // The requests that are complete. Never waits.
  std::vector<std::pair<Id, ControlRequest>> Receive();

  void Answer(Id id, const ControlReply& reply);

 private:
  // False while more may come.
  bool ReadAll(int connection, std::string* text) const;

  int fd_;
  std::map<int, std::string> incoming_;  // by connection
};

// Asks the launcher that runs a run's folder and waits for the reply. Throws std::runtime_error
// when there is none.
ControlReply AskLauncher(const std::string& folder, const ControlRequest& request);

}  // namespace declutter::launcher
