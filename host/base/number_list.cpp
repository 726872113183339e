#include "base/number_list.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace prelight {

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

}  // namespace prelight
