#include "benchmarks/run/options.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>

#include "prelight/error.h"

namespace prelight::benchmarks {

RunOptions RunOptions::quickRun() {
  RunOptions options;
  options.quick = true;
  options.runs = 1;
  options.suiteSeconds = 60.0;
  return options;
}

nlohmann::ordered_json RunOptions::toJson() const {
  std::vector<std::string> names;
  for (const std::filesystem::path& sky : skies) names.push_back(sky.filename().string());
  return {{"quick", quick},
          {"runs", runs},
          {"onlyCase", onlyCase},
          {"suiteSeconds", suiteSeconds},
          {"skies", names}};
}

namespace option_values {

double numberOf(const std::string& text, bool whole, const Limits& limits) {
  double number = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc() || end != text.data() + text.size()) throw std::invalid_argument("no number");
  if (!(number >= limits.least && number <= limits.most)) throw std::invalid_argument("out of range");
  if (!whole) return number;
  if (number != std::floor(number)) throw std::invalid_argument("not whole");
  const auto count = static_cast<std::uint64_t>(number);
  if (count % limits.multipleOf != 0) throw std::invalid_argument("no multiple");
  if (limits.powerOfTwo && !std::has_single_bit(count)) throw std::invalid_argument("no power of two");
  return number;
}

std::pair<std::string, std::string> halvesOf(const std::string& text, char separator) {
  const std::size_t middle = text.find(separator);
  if (middle == std::string::npos) throw std::invalid_argument("no separator");
  return {text.substr(0, middle), text.substr(middle + 1)};
}

std::vector<std::string> elementsOf(const std::string& text) {
  std::vector<std::string> elements;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    elements.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return elements;
}

std::string numbersText(bool whole, bool list, const Limits& limits) {
  const char* kind = whole ? "whole number" : "number";
  std::string text = list ? fmt::format("{}s", kind) : fmt::format("a {}", kind);
  text += fmt::format(" from {:.15g}", limits.least);
  if (limits.most < Limits{}.most) text += fmt::format(" to {:.15g}", limits.most);
  if (limits.powerOfTwo) text += list ? ", powers of two" : ", a power of two";
  if (limits.multipleOf > 1)
    text += fmt::format(", {} of {}", list ? "multiples" : "a multiple", limits.multipleOf);
  if (list) text += limits.ascending ? ", ascending, with commas between them" : ", with commas between them";
  return text;
}

void refuse(const SetOption& given, const std::string& values) {
  throw UsageError("--set " + given.name, fmt::format("got '{}', expected {}", given.value, values),
                   "prelight bench SUITE --list shows what each option takes");
}

}  // namespace option_values

}  // namespace prelight::benchmarks
