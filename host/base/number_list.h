#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace prelight {

/// The numbers of "1,2.5,-3", none of a magnitude beyond `most`. Nothing where one is not such a number.
std::optional<std::vector<double>> numbersIn(std::string_view text, double most);

}  // namespace prelight
