#pragma once

#include <string>
#include <vector>

namespace declutter::runtime {

// "; did you mean 'seed'?" for the candidate that word was most likely meant to be, else empty.
std::string Suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace declutter::runtime
