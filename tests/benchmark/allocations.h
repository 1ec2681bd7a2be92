#pragma once

#include <cstdint>

namespace declutter::benchmark {

// Calls of malloc and its kin by the whole program so far.
int64_t NumAllocations();

}  // namespace declutter::benchmark
