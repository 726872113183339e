#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/console/division.h"

namespace prelight::cli {

/// Adds --slice, --from, --parts, --any-device and --stages to a command.
void addDivisionOptions(CLI::App& app, Division& division);

/// Returns the command and its arguments without what names files to write, a device and the division: the
/// command's name, its scene, then --NAME=VALUE or --NAME each.
std::vector<std::string> recordedArguments(const CLI::App& app);

/// Throws InputError unless `arguments` are such as recordedArguments() returns for a command of `program`.
void requireRecorded(const CLI::App& program, const std::filesystem::path& source,
                     const std::vector<std::string>& arguments);

/// Throws UsageError if the work is divided and an option is given that forbids it. `option`: its name;
/// empty: it is not given. `why`: it cannot be divided.
void requireDivisible(const Division& division, const std::string& option, const std::string& why);

/// Checks the output of a command as checkOutputFile() does; the file of a slice may have any extension.
void checkDividedOutput(const Division& division, const std::filesystem::path& output,
                        std::initializer_list<std::string_view> extensions);

}  // namespace prelight::cli
