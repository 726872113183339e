#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace prelight {

/// Returns the name that a mistyped word most likely meant: the one with the fewest inserted, dropped,
/// changed or swapped letters, at most a third of the word's length (one for short words). Returns none when
/// no name is that near.
std::optional<std::string> suggestName(std::string_view word, std::span<const std::string> names);

/// Returns the end of messages about a word that is none of `names`: "did you mean NAME? ", or nothing when
/// none is near.
std::string didYouMean(std::string_view word, std::span<const std::string> names);

}  // namespace prelight
