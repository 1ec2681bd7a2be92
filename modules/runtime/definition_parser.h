#pragma once

#include <string>
#include <vector>

namespace declutter::runtime {

// The declarations of one .lcm file, as written.
struct Definition {
  struct Member {
    std::string type;
    std::string name;
    std::vector<std::string> dimensions;  // literals or names of earlier members
  };

  std::string name;
  std::vector<Member> members;
};

// Throws std::logic_error for text that does not hold exactly one struct of plain members.
Definition ParseDefinition(const std::string& text);

}  // namespace declutter::runtime
