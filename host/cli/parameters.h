#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "cli/option_names.h"
#include "cli/values.h"
#include "prelight/parameters.h"
#include "viewer/options/option_parameter.h"

namespace prelight::cli {

/// Returns the row of the table of `Options` for this option, given without dashes. The row must exist.
template <typename Options>
const Parameter<Options>& parameterNamed(std::string_view option) {
  const auto rows = parametersOf<Options>();
  return *std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.option == option; });
}

/// Returns the help text of a row, with its range if that is useful to readers, and the default if there is
/// one.
template <typename Options>
std::string helpOf(const Parameter<Options>& row) {
  std::string help = withOptions(row.help);
  if (row.range.kind == NumberKind::Whole && row.range.most < 1e4)
    help += fmt::format(", {:.0f} to {:.0f}", row.range.least, row.range.most);
  const std::optional<double> usual = row.get({});
  if (usual && row.range.contains(*usual)) help += fmt::format(" (default {:g})", *usual);
  return help;
}

/// Adds an option for a number in the table of `Options`, which is passed to `store`.
template <typename Options>
CLI::Option* addParameter(CLI::App& app, std::string_view option, const std::function<void(double)>& store) {
  const Parameter<Options>& row = parameterNamed<Options>(option);
  CLI::Option* const added = addNumber(app, "--" + std::string(option), row.range, store, helpOf(row));
  return std::string_view(row.unit) == "m" ? added->type_name("M") : added;
}

/// Adds an option for a number that is written to its field. `options` must outlive the parser.
template <typename Options>
CLI::Option* addParameter(CLI::App& app, std::string_view option, Options& options) {
  const auto set = parameterNamed<Options>(option).set;
  return addParameter<Options>(app, option, [set, &options](double value) { set(options, value); });
}

/// Adds an option for every number of `options`, under a heading of the help.
template <typename Options>
void addParameters(CLI::App& app, const char* group,
                   std::span<const viewer::OptionParameter<Options>> parameters, Options& options) {
  for (const viewer::OptionParameter<Options>& parameter : parameters) {
    const std::string help = fmt::format("{} (default {:g})", parameter.help, parameter.get({}));
    CLI::Option* const option =
        parameter.isWhole
            ? addWholeNumber(
                  app, parameter.option,
                  {static_cast<std::uint64_t>(parameter.least), static_cast<std::uint64_t>(parameter.most)},
                  [&](std::uint64_t value) { parameter.set(options, static_cast<double>(value)); }, help)
            : addRealNumber(
                  app, parameter.option, {parameter.least, parameter.most},
                  [&](double value) { parameter.set(options, value); }, help);
    option->group(group);
  }
}

}  // namespace prelight::cli
