#pragma once

// Compiles a function for newer processors too and picks at load time what this one has; plain
// loops over arrays become vectors. Files that use it are compiled with -ffp-contract=off: a fused
// product and sum rounds differently.
#define DECLUTTER_FOR_EACH_PROCESSOR \
  __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
