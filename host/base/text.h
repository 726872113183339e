#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace prelight {

/// Returns true when `text` matches `pattern`: * is any run of characters, ? any single one.
bool matchesPattern(const std::string& text, const std::string& pattern);

/// Returns the parts of "a,b,c" without empty ones.
std::vector<std::string> splitPatterns(const std::string& text);

/// The numbers of "1,2.5,-3", none of a magnitude beyond `most`. Nothing where one is not such a number.
std::optional<std::vector<double>> numbersIn(std::string_view text, double most);

/// Returns the name that a mistyped word most likely meant: the one with the fewest inserted, dropped,
/// changed or swapped letters, at most a third of the word's length (one for short words). Returns none when
/// no name is that near.
std::optional<std::string> suggestName(std::string_view word, std::span<const std::string> names);

/// Returns the end of messages about a word that is none of `names`: "did you mean NAME? ", or nothing when
/// none is near.
std::string didYouMean(std::string_view word, std::span<const std::string> names);

/// Returns a text as HTML and SVG have it between tags: with & and < escaped.
std::string escapedText(std::string_view text);

/// Number of values of an enumeration that counts from 0, from the function that names them: a switch without
/// a default, so that the compiler tells of a value without a name, which returns an empty name for others.
template <typename Enum>
constexpr std::size_t countNamed(std::string_view (*nameOf)(Enum)) {
  std::size_t count = 0;
  while (!nameOf(static_cast<Enum>(count)).empty()) ++count;
  return count;
}

/// Whether row i of a table, from 0 on, is that of value i of an enumeration; `key` is its member of rows.
template <typename Rows, typename Row, typename Enum>
constexpr bool followsOrder(const Rows& rows, Enum Row::*key) {
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows[i].*key != static_cast<Enum>(i)) return false;
  return true;
}

/// Returns the quoted path of an include line of OpenCL C or GLSL, `#include "PATH"`; empty for any other
/// line.
inline std::string includedPath(std::string_view line) {
  constexpr std::string_view directive = "#include";
  const auto start = line.find_first_not_of(" \t");
  if (start == std::string_view::npos || !line.substr(start).starts_with(directive)) return {};
  const auto open = line.find('"', start + directive.size());
  const auto close = open == std::string_view::npos ? open : line.find('"', open + 1);
  return close == std::string_view::npos ? std::string()
                                         : std::string(line.substr(open + 1, close - open - 1));
}

}  // namespace prelight
