#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <span>

#include "cli/values.h"
#include "viewer/option_parameter.h"

namespace prelight::cli {

/// An option for each number of `options`, under a heading of the help.
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
