#include "cli/options/values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "base/text.h"

namespace prelight::cli {
namespace {

constexpr std::uint64_t maxPictureSide = 16384;

[[noreturn]] void refuse(const std::string& option, const std::string& got, const std::string& expected) {
  throw CLI::ValidationError(option, fmt::format("got '{}', expected {}", got, expected));
}

/// Returns the number that the whole text spells, or nothing.
template <typename T>
std::optional<T> parse(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <typename T>
bool contains(const Range<T>& range, T value) {
  return value >= range.min && value <= range.max;  // false for NaN
}

std::optional<std::uint64_t> parseBytes(std::string_view text) {
  int shift = 0;
  if (!text.empty()) {
    switch (text.back()) {
      case 'k':
      case 'K':
        shift = 10;
        break;
      case 'm':
      case 'M':
        shift = 20;
        break;
      case 'g':
      case 'G':
        shift = 30;
        break;
      default:
        break;
    }
  }
  if (shift != 0) text.remove_suffix(1);
  const auto number = parse<std::uint64_t>(text);
  if (!number || *number > (~std::uint64_t{0} >> shift)) return std::nullopt;
  return *number << shift;
}

std::optional<int> parseSide(std::string_view text) {
  const auto side = parse<std::uint64_t>(text);
  if (!side || *side < 1 || *side > maxPictureSide) return std::nullopt;
  return static_cast<int>(*side);
}

std::optional<PictureSize> parseSize(std::string_view text) {
  const std::size_t cross = text.find('x');
  const auto height = parseSide(cross == std::string_view::npos ? text : text.substr(cross + 1));
  if (!height) return std::nullopt;
  if (cross == std::string_view::npos) return PictureSize{std::nullopt, *height};
  const auto width = parseSide(text.substr(0, cross));
  if (!width) return std::nullopt;
  return PictureSize{width, *height};
}

}  // namespace

void refuseName(const std::string& option, const std::string& name, const std::vector<std::string>& known) {
  throw UsageError(option, fmt::format("got '{}'", name),
                   fmt::format("{}expected {}", didYouMean(name, known), fmt::join(known, " or ")));
}

double parseNumber(const std::string& option, const std::string& text, const NumberRange& range,
                   bool takesZero) {
  std::optional<double> value;
  if (range.kind == NumberKind::Real) {
    value = parse<double>(text);
  } else if (const auto whole =
                 range.kind == NumberKind::Bytes ? parseBytes(text) : parse<std::uint64_t>(text)) {
    value = static_cast<double>(*whole);
  }
  if (!value || !(takesZero ? range.allows(*value) : range.contains(*value)))
    refuse(option, text,
           (takesZero ? range.textWithZero() : range.text()) +
               (range.kind == NumberKind::Bytes ? ", with an optional K, M or G as in 512M" : ""));
  return *value;
}

CLI::Option* addWholeNumber(CLI::App& app, const std::string& name, Range<std::uint64_t> range,
                            const std::function<void(std::uint64_t)>& store, const std::string& help) {
  const auto read = [=](const std::string& text) {
    const auto value = parse<std::uint64_t>(text);
    if (!value || !contains(range, *value))
      refuse(name, text, fmt::format("a whole number from {} to {}", range.min, range.max));
    store(*value);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("N");
}

double parseRealNumber(const std::string& option, const std::string& text, Range<double> range,
                       const char* otherwise) {
  const auto value = parse<double>(text);
  if (!value || !contains(range, *value))
    refuse(option, text, fmt::format("a number from {:g} to {:g}{}", range.min, range.max, otherwise));
  return *value;
}

CLI::Option* addRealNumber(CLI::App& app, const std::string& name, Range<double> range,
                           const std::function<void(double)>& store, const std::string& help) {
  const auto read = [=](const std::string& text) { store(parseRealNumber(name, text, range)); };
  return app.add_option_function<std::string>(name, read, help)->type_name("X");
}

CLI::Option* addPictureSize(CLI::App& app, const std::string& name,
                            const std::function<void(PictureSize)>& store, const std::string& help) {
  const auto read = [=](const std::string& text) {
    const auto size = parseSize(text);
    if (!size)
      refuse(name, text, fmt::format("WIDTHxHEIGHT or HEIGHT in pixels, each from 1 to {}", maxPictureSide));
    store(*size);
  };
  return app.add_option_function<std::string>(name, read, help)->type_name("WxH");
}

}  // namespace prelight::cli
