#include "cli/options/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <vector>

#include "cli/options/values.h"

namespace prelight::cli {
namespace {

/// Returns the choices with their explanations: "lobe, which conserves energy (default); thesis".
std::string choicesText(const OptionInfo& row, std::optional<double> usual) {
  std::vector<std::string> texts;
  bool explained = false;
  for (std::size_t i = 0; i < row.choices.size(); ++i) {
    const Choice& choice = row.choices[i];
    texts.emplace_back(choice.name);
    if (choice.help != nullptr) texts.back() += fmt::format(", {}", choice.help);
    if (usual == static_cast<double>(i)) texts.back() += " (default)";
    explained = explained || choice.help != nullptr;
  }
  return fmt::format("{}", fmt::join(texts, explained ? "; " : ", "));
}

/// Returns a default for people: no more than one decimal above 1, where a unit may have been converted.
double shown(double value) { return value < 1.0 ? value : std::round(10.0 * value) / 10.0; }

const char* valueNameOf(const OptionInfo& row) {
  const std::string_view unit = row.unit;
  if (unit == "m") return "M";
  if (unit == "s") return "SECONDS";
  if (unit == "deg") return "DEG";
  switch (row.range.kind) {
    case NumberKind::Real:
      return "X";
    case NumberKind::Whole:
      return "N";
    case NumberKind::PowerOfTwo:
      return "SIZE";
    case NumberKind::Bytes:
      break;
  }
  return "BYTES";
}

double indexOf(const OptionInfo& row, const std::string& text) {
  std::vector<std::string> names;
  for (const Choice& choice : row.choices) {
    if (text == choice.name) return static_cast<double>(names.size());
    names.emplace_back(choice.name);
  }
  refuseName(optionName(row), text, names);
}

}  // namespace

std::string optionName(const OptionInfo& row) {
  return std::string("--") + (row.commandLine != nullptr ? row.commandLine : row.name);
}

std::string helpOf(const OptionInfo& row, std::optional<double> usual) {
  if (row.kind == OptionKind::Choice) return fmt::format("{}: {}", row.help, choicesText(row, usual));
  if (row.kind != OptionKind::Number) return row.help;
  std::string help = row.help;
  if (row.range.kind == NumberKind::Whole && row.range.most < 1e4)
    help += fmt::format(", {:.0f} to {:.0f}", row.range.least, row.range.most);
  if (!usual && row.range.zero != nullptr) help += fmt::format(", or 0 ({})", row.range.zero);
  if (usual && row.range.contains(*usual)) help += fmt::format(" (default {:g})", shown(*usual));
  return help;
}

CLI::Option* addOption(CLI::App& app, const OptionInfo& row, std::optional<double> usual,
                       const std::function<void(double)>& store) {
  const std::string name = optionName(row), help = helpOf(row, usual);
  CLI::Option* added = nullptr;
  switch (row.kind) {
    case OptionKind::Flag:
      added = app.add_flag_callback(
          name, [=] { store(1.0); }, help);
      break;
    case OptionKind::Number: {
      // Where nothing else is the default, 0 has to be given to have its meaning.
      const auto read = [=, range = row.range, takesZero = !usual](const std::string& text) {
        store(parseNumber(name, text, range, takesZero));
      };
      added = app.add_option_function<std::string>(name, read, help)->type_name(valueNameOf(row));
      break;
    }
    case OptionKind::Choice:
      added = app.add_option_function<std::string>(
                     name, [=](const std::string& text) { store(indexOf(row, text)); }, help)
                  ->type_name("NAME");
      break;
    case OptionKind::Own:
      break;
  }
  if (const auto shadings = row.shadingNames(); !shadings.empty())
    added->group(fmt::format("{} shading", fmt::join(shadings, " and ")));
  return added;
}

CLI::Option* addOwnOption(CLI::App& app, const OptionInfo& row, const char* valueName,
                          const std::function<void(const std::string&)>& store) {
  return app.add_option_function<std::string>(optionName(row), store, row.help)->type_name(valueName);
}

CLI::Option* addRepeatedOption(CLI::App& app, const OptionInfo& row, const char* valueName,
                               const std::function<void(const std::string&)>& store) {
  const auto readAll = [=](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) store(text);
  };
  return app.add_option_function<std::vector<std::string>>(optionName(row), readAll, row.help)
      ->type_name(valueName)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

CLI::Option* addSeedOption(CLI::App& app, std::uint64_t& seed) {
  const OptionInfo& row = optionNamed<BakeRequest>("seed");
  return addWholeNumber(
      app, optionName(row), {0, std::numeric_limits<std::uint64_t>::max()},
      [&seed](std::uint64_t given) { seed = given; }, row.help);
}

}  // namespace prelight::cli
