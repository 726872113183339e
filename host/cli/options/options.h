#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "prelight/options.h"

/// Options of the parser that are made from the tables of prelight/options.h.
namespace prelight::cli {

/// Returns the option as it is typed: "--haar-error".
std::string optionName(const OptionInfo& row);

/// Returns the text of the help: what the option does, its choices, its range if that is useful to readers,
/// and the default if there is one.
std::string helpOf(const OptionInfo& row, std::optional<double> usual);

/// Adds the option of a row. Its value goes to `store`.
CLI::Option* addOption(CLI::App& app, const OptionInfo& row, std::optional<double> usual,
                       const std::function<void(double)>& store);

/// Adds an option that may be given several times. `store` reads the texts of all.
CLI::Option* addRepeatedOption(CLI::App& app, const OptionInfo& row, const char* valueName,
                               const std::function<void(const std::string&)>& store);

/// Adds the option of a row of kind OptionKind::Own, or of one that the command line reads in its own way.
CLI::Option* addOwnOption(CLI::App& app, const OptionInfo& row, const char* valueName,
                          const std::function<void(const std::string&)>& store);

/// Adds --seed.
CLI::Option* addSeedOption(CLI::App& app, std::uint64_t& seed);

/// Returns the row of this name, which must exist.
template <typename Options>
const Option<Options>& optionNamed(std::string_view name) {
  const auto rows = optionsOf<Options>();
  return *std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.name == name; });
}

/// Adds the option of a row. `options` must outlive the parser.
template <typename Options>
CLI::Option* addOption(CLI::App& app, const Option<Options>& row, Options& options) {
  return addOption(app, row, row.usualValue(),
                   [set = row.set, &options](double value) { set(options, value); });
}

template <typename Options>
CLI::Option* addOption(CLI::App& app, std::string_view name, Options& options) {
  return addOption(app, optionNamed<Options>(name), options);
}

/// Adds the options of all rows that are read in the usual way, except those with these names.
template <typename Options>
void addOptions(CLI::App& app, Options& options, std::initializer_list<std::string_view> except = {}) {
  for (const Option<Options>& row : optionsOf<Options>())
    if (row.kind != OptionKind::Own && row.commandLine == nullptr &&
        std::find(except.begin(), except.end(), row.name) == except.end())
      addOption(app, row, options);
}

}  // namespace prelight::cli
