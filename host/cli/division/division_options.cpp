#include "cli/division/division_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "cli/output_file.h"
#include "prelight/error.h"

namespace prelight::cli {

namespace {

constexpr std::uint32_t mostSlices = 1'000'000;

/// Options that say where results go, or which process does what.
constexpr auto unrecorded =
    std::to_array<std::string_view>({"help", "output", "report", "export", "export-target", "dump-kernels",
                                     "resume", "dry-run", "slice", "from", "parts", "any-device", "stages"});

bool isRecorded(const CLI::Option& option) {
  return option.get_lnames().empty() ||
         std::find(unrecorded.begin(), unrecorded.end(), option.get_lnames().front()) == unrecorded.end();
}

SliceChoice parseSlice(const std::string& text) {
  SliceChoice choice{0, 0};
  const std::size_t bar = text.find('/');
  const auto read = [](std::string_view digits, std::uint32_t& number) {
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return error == std::errc() && end == digits.data() + digits.size();
  };
  const bool reads = bar != std::string::npos && read(std::string_view(text).substr(0, bar), choice.index) &&
                     read(std::string_view(text).substr(bar + 1), choice.count);
  if (!reads || choice.index < 1 || choice.index > choice.count || choice.count > mostSlices)
    throw UsageError("--slice", fmt::format("got '{}', expected I/N with I from 1 to N and N at most {}",
                                            text, mostSlices));
  return choice;
}

}  // namespace

void addDivisionOptions(CLI::App& app, Division& division) {
  CLI::Option* slice =
      app.add_option_function<std::string>(
             "--slice", [&division](const std::string& text) { division.slice = parseSlice(text); },
             "do the I-th of N shares of the next stage of the work and write it to the file of -o, for "
             "`prelight merge`; a share that was interrupted goes on when it is asked for again")
          ->type_name("I/N")
          ->excludes("--resume")
          ->excludes("--dry-run");
  for (const char* ofTheWhole : {"--report", "--export"})
    if (CLI::Option* option = app.get_option_no_throw(ofTheWhole)) slice->excludes(option);
  app.add_option("--from", division.state,
                 "state that `prelight merge` has left, for the slices of a later stage")
      ->type_name("FILE.state")
      ->needs(slice);
  CLI::Option* parts =
      app.add_option("--parts", division.parts,
                     "take the work that these files of slices hold, as `prelight merge` does with their own "
                     "arguments; end before a stage that has no slices yet")
          ->type_name("FILE...")
          ->excludes(slice)
          ->excludes("--dry-run");
  app.add_flag("--any-device", division.anyDevice,
               "take work of other devices, too: results may then depend on which device did what")
      ->needs(parts);
  app.add_flag("--stages", division.listsStages,
               "write nothing; list the stages that slices have to do one after the other, as work with few "
               "rays or samples has them")
      ->excludes(slice)
      ->excludes(parts)
      ->excludes("--resume")
      ->excludes("--dry-run");
}

std::vector<std::string> recordedArguments(const CLI::App& app) {
  std::vector<std::string> positional{app.get_name()}, named;
  for (const CLI::Option* option : app.get_options({})) {
    if (option->count() == 0 || !isRecorded(*option)) continue;
    if (option->get_lnames().empty()) {
      positional.insert(positional.end(), option->results().begin(), option->results().end());
      continue;
    }
    const std::string name = "--" + option->get_lnames().front();
    if (option->get_items_expected_max() == 0)
      named.push_back(name);
    else
      for (const std::string& value : option->results()) named.push_back(name + '=' + value);
  }
  positional.insert(positional.end(), named.begin(), named.end());
  return positional;
}

void requireRecorded(const CLI::App& program, const std::filesystem::path& source,
                     const std::vector<std::string>& arguments) {
  const auto refuse = [&](const std::string& what) {
    throw InputError(source.string(), "names a command that slices do not have: " + what,
                     "give the command yourself, with --parts");
  };
  const CLI::App* command = nullptr;
  for (const CLI::App* each : program.get_subcommands({}))
    if (!arguments.empty() && each->get_name() == arguments.front()) command = each;
  if (command == nullptr || command->get_option_no_throw("--slice") == nullptr) refuse("no such command");
  if (arguments.size() < 2 || arguments[1].empty() || arguments[1].front() == '-') refuse("no scene");
  for (std::size_t i = 2; i < arguments.size(); ++i) {
    const CLI::Option* option =
        arguments[i].starts_with("--")
            ? command->get_option_no_throw(arguments[i].substr(0, arguments[i].find('=')))
            : nullptr;
    if (option == nullptr || !isRecorded(*option)) refuse(arguments[i]);
  }
}

void requireDivisible(const Division& division, const std::string& option, const std::string& why) {
  if (!option.empty() && (division.slice || !division.parts.empty()))
    throw UsageError(option, why, "say how many rays or samples instead");
}

void checkDividedOutput(const Division& division, const std::filesystem::path& output,
                        std::initializer_list<std::string_view> extensions) {
  checkOutputFile("-o", output, division.slice ? std::initializer_list<std::string_view>{} : extensions);
}

}  // namespace prelight::cli
