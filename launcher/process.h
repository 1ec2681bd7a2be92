#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "launcher/child_process.h"
#include "launcher/wire.h"

namespace declutter::launcher {

// Something that a run starts and stops. All but Start may be called before it and after the end.
class Process {
 public:
  virtual ~Process() = default;

  // Throws std::runtime_error when it cannot be started. May be called again after its end.
  virtual void Start() = 0;

  // Asks it to finish what is on its way and to end.
  virtual void Terminate() = 0;

  virtual void Kill() = 0;

  // Every message that the launcher hears.
  virtual void OnMessage(const Message&) {}

  // One turn of the launcher's loop has passed; now_s is monotonic.
  virtual void OnTurn(double) {}

  // True from the time when it loses no message that is sent to it.
  virtual bool is_ready() const = 0;

  // May be started and stopped while the rest of the graph runs.
  virtual bool obeys_users() const { return true; }

  // What it said last of itself, once; nothing where nothing new has come.
  virtual std::optional<module_status_t> TakeStatus() { return std::nullopt; }

  // [us] of the last frame that it has handled; nothing when its end has not told.
  virtual std::optional<int64_t> last_utime() const { return std::nullopt; }

  // How it ended, once for each start.
  virtual std::optional<Ending> Reap() = 0;

  // Of its process; -1 while there is none.
  virtual pid_t pid() const { return -1; }

  // Readable when OnTurn has something to do; -1: nothing is to be read.
  virtual int fd() const { return -1; }
};

}  // namespace declutter::launcher
