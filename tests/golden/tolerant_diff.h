#pragma once

#include <map>
#include <string>

namespace declutter::golden {

// How far the numbers behind a word of a text may be from those expected: by absolute, or by
// relative times the one expected, whichever is more.
struct Tolerance {
  double absolute = 0.0;
  double relative = 0.0;
};

// By word. Numbers behind a word that has none must be equal.
using Tolerances = std::map<std::string, Tolerance>;

// A line for each: WORD ABSOLUTE RELATIVE; what follows # is a comment. Throws std::runtime_error
// that names the line.
Tolerances ParseTolerances(const std::string& text);

// What differs between two texts beyond the tolerances, for people: "- " before a line that was
// expected and is not there, "+ " before one that is there instead, which tells the first number
// that is too far off; each with the last line before it that begins with "== ". Empty when nothing
// differs.
std::string TolerantDiff(const std::string& expected, const std::string& actual,
                         const Tolerances& tolerances);

}  // namespace declutter::golden
