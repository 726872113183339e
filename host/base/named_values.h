#pragma once

#include <cstddef>
#include <string_view>

namespace prelight {

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

}  // namespace prelight
