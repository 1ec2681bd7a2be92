#pragma once

#include <functional>
#include <string>

namespace declutter::launcher {

// What a child prints, by whole lines.
class OutputPipe {
 public:
  // Throws std::runtime_error when no descriptor is left.
  OutputPipe();
  ~OutputPipe();
  OutputPipe(const OutputPipe&) = delete;
  OutputPipe& operator=(const OutputPipe&) = delete;

  // For the child; CloseChildEnd when it has it.
  int child_end() const { return child_end_; }
  void CloseChildEnd();

  // Readable when there is something to forward; -1 after the end.
  int fd() const { return fd_; }

  // Hands over the lines that have come, of a child that prints without end no more than a pipe
  // holds.
  void Forward(const std::function<void(const std::string& lines)>& take);

 private:
  int fd_ = -1;
  int child_end_ = -1;
  std::string line_;  // the last one, until it is complete
};

}  // namespace declutter::launcher
