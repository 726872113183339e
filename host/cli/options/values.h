#pragma once

#include <CLI/CLI.hpp>
#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "prelight/error.h"
#include "prelight/options.h"

/// Options whose values are checked as they are read. Each message names the option, what it got and what it
/// expected. CLI11's own conversions are not used, because they take "010" for eight and let NaN through.
namespace prelight::cli {

template <typename T>
struct Range {
  T min;
  T max;
};

/// Returns the number that the whole text spells and the range contains, or if `takesZero` a 0 that has a
/// meaning. Throws CLI::ValidationError with the option and the range. Bytes may have a suffix K, M or G
/// (powers of 1024).
double parseNumber(const std::string& option, const std::string& text, const NumberRange& range,
                   bool takesZero);

/// `name` includes its dashes.
CLI::Option* addWholeNumber(CLI::App& app, const std::string& name, Range<std::uint64_t> range,
                            const std::function<void(std::uint64_t)>& store, const std::string& help);

/// Returns the number that the whole text spells. Throws CLI::ValidationError with the option and the range,
/// followed by `otherwise`, the other values it takes (", or auto").
double parseRealNumber(const std::string& option, const std::string& text, Range<double> range,
                       const char* otherwise = "");

CLI::Option* addRealNumber(CLI::App& app, const std::string& name, Range<double> range,
                           const std::function<void(double)>& store, const std::string& help);

/// The size of a picture; without a width it follows from the camera's aspect ratio.
struct PictureSize {
  std::optional<int> width;
  int height = 0;
};

template <typename T, std::size_t count>
using Choices = std::array<std::pair<const char*, T>, count>;

/// Throws the usage error for a name that the option does not take.
[[noreturn]] void refuseName(const std::string& option, const std::string& name,
                             const std::vector<std::string>& known);

/// Returns the value that `name` stands for, or throws a usage error that lists the names.
template <typename T, std::size_t count>
T chooseNamed(const std::string& option, const std::string& name, const Choices<T, count>& choices) {
  std::vector<std::string> names;
  for (const auto& [known, value] : choices) {
    if (name == known) return value;
    names.emplace_back(known);
  }
  refuseName(option, name, names);
}

template <typename T, std::size_t count>
CLI::Option* addNamed(CLI::App& app, const std::string& name, const Choices<T, count>& choices,
                      const std::function<void(T)>& store, const std::string& help) {
  return app
      .add_option_function<std::string>(
          name, [=](const std::string& text) { store(chooseNamed<T, count>(name, text, choices)); }, help)
      ->type_name("NAME");
}

/// Adds an option that takes "WIDTHxHEIGHT" or "HEIGHT".
CLI::Option* addPictureSize(CLI::App& app, const std::string& name,
                            const std::function<void(PictureSize)>& store, const std::string& help);

}  // namespace prelight::cli
