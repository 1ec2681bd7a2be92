#include "modules/runtime/suggestion.h"

#include <algorithm>
#include <numeric>

namespace declutter::runtime {
namespace {

// Insertions, deletions and replacements that turn a into b (Levenshtein).
std::size_t EditDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string Suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  std::size_t closest = std::max<std::size_t>(2, word.size() / 3) + 1;
  std::string best;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(word, candidate);
    if (distance >= closest) continue;
    closest = distance;
    best = candidate;
  }
  return best.empty() ? "" : "; did you mean '" + best + "'?";
}

}  // namespace declutter::runtime
