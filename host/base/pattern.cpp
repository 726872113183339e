#include "base/pattern.h"

#include <utility>

namespace prelight {

bool matchesPattern(const std::string& text, const std::string& pattern) {
  // Greedy matching with one position for backtracking: the last *, and how much it has matched.
  std::size_t t = 0, p = 0, star = std::string::npos, swallowed = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      swallowed = t;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == text[t])) {
      ++t;
      ++p;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++swallowed;
    } else {
      return false;
    }
  }
  return pattern.find_first_not_of('*', p) == std::string::npos;
}

std::vector<std::string> splitPatterns(const std::string& text) {
  std::vector<std::string> patterns;
  std::string pattern;
  for (const char c : text + ",") {
    if (c != ',') {
      pattern += c;
    } else if (!pattern.empty()) {
      patterns.push_back(std::exchange(pattern, {}));
    }
  }
  return patterns;
}

}  // namespace prelight
