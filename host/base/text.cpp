#include "base/text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>
#include <vector>

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

std::optional<std::vector<double>> numbersIn(std::string_view text, double most) {
  std::vector<double> numbers;
  for (;;) {
    const std::size_t end = std::min(text.find(','), text.size());
    double number = 0.0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc{} || stop != text.data() + end || !(std::abs(number) <= most)) return std::nullopt;
    numbers.push_back(number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

namespace {

/// Returns the Damerau-Levenshtein distance in which no letter takes part in two swaps (optimal string
/// alignment).
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> beforeLast(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(beforeLast, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::optional<std::string> suggestName(std::string_view word, std::span<const std::string> names) {
  constexpr std::size_t longest = 64;  // longer words are no typing errors
  if (word.empty() || word.size() > longest) return std::nullopt;
  std::optional<std::string> nearest;
  std::size_t least = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& name : names) {
    const std::size_t distance = editDistance(word, name);
    if (distance >= least) continue;
    least = distance;
    nearest = name;
  }
  return nearest;
}

std::string didYouMean(std::string_view word, std::span<const std::string> names) {
  const std::optional<std::string> name = suggestName(word, names);
  return name ? "did you mean " + *name + "? " : "";
}

std::string escapedText(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '&')
      escaped += "&amp;";
    else if (c == '<')
      escaped += "&lt;";
    else
      escaped += c;
  }
  return escaped;
}

}  // namespace prelight
