#include <fmt/format.h>
#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/context.h"
#include "prelight/error.h"
#include "prelight/options.h"
#include "prelight/refine.h"
#ifdef PRELIGHT_WITH_VIEWER
#include "integrators/reference.h"
#include "pictures/picture_request.h"
#include "viewer/options/shading_options.h"
#endif

namespace prelight::cli {
namespace {

/// The program's parser, in this process. No command runs, because every parse is refused.
struct Parser {
  CLI::App program{"prelight"};
  Context context;

  Parser() {
    program.require_subcommand(1);
    program.fallthrough();
    for (const auto add : {addBakeCommand, addInfoCommand, addExportCommand, addSceneCommand})
      add(program, context);
#ifdef PRELIGHT_WITH_VIEWER
    for (const auto add : {addRenderCommand, addReferenceCommand, addViewCommand}) add(program, context);
#endif
  }

  /// The parser's error for a command with one option, or empty if it accepts the option.
  std::string complaint(const std::string& command, const std::string& option, const std::string& value) {
    try {
      program.parse(
          // CLI11 takes arguments in reverse.
          std::vector<std::string>{option + "=" + value, "no/such/scene.glb", command});
    } catch (const CLI::RequiredError&) {
      return "";  // The value was accepted.
    } catch (const CLI::ParseError& error) {
      return error.what();
    } catch (const UsageError& error) {
      return error.what();
    } catch (const Error&) {
    }
    return "";
  }
};

/// Whether an option takes a number, judged by the name of the value in its help.
bool takesNumber(const CLI::Option& option) {
  static const std::set<std::string> names = {"N", "X",    "M",     "E",       "S",   "T",
                                              "F", "SIZE", "BYTES", "SECONDS", "DEG", "WxH"};
  return names.count(option.get_type_name()) > 0;
}

std::vector<std::string> badValuesFor(const CLI::Option& option) {
  std::vector<std::string> values = {"nan",
                                     "-nan",
                                     "inf",
                                     "-inf",
                                     "1e999",
                                     "-1e300",
                                     "1e300",
                                     "three",
                                     " ",
                                     "0x10",
                                     "-99999999999999999999",
                                     "99999999999999999999"};
  if (option.get_type_name() == "N" || option.get_type_name() == "SIZE")
    for (const char* value : {"1.5", "-1", "1e3", "+1"}) values.emplace_back(value);
  return values;
}

TEST(OptionRanges, NumbersOfEveryOption_RefuseWhatIsNone) {
  Parser parser;
  std::size_t tried = 0;
  for (CLI::App* const command : parser.program.get_subcommands({}))
    for (const CLI::Option* const option : command->get_options()) {
      if (option->get_lnames().empty() || !takesNumber(*option)) continue;
      const std::string name = "--" + option->get_lnames().front();
      ++tried;
      for (const std::string& value : badValuesFor(*option)) {
        const std::string complaint = parser.complaint(command->get_name(), name, value);
        EXPECT_NE(complaint.find(name), std::string::npos)
            << command->get_name() << " " << name << " '" << value << "': " << complaint;
        EXPECT_NE(complaint.find("expected"), std::string::npos)
            << name << " '" << value << "': " << complaint;
      }
    }
  EXPECT_GT(tried, 100u);
}

/// Tries values just outside of a row's range and at its ends.
template <typename Options>
void expectEdges(Parser& parser, const std::string& command, std::set<std::string>& tried) {
  for (const Option<Options>& row : optionsOf<Options>()) {
    if (row.kind != OptionKind::Number || row.commandLine != nullptr) continue;
    const std::string name = std::string("--") + row.name;
    CLI::App* const app = parser.program.get_subcommand(command);
    if (app->get_option_no_throw(name) == nullptr) continue;
    tried.insert(command + " " + name);
    const auto text = [](double value) { return fmt::format("{}", value); };
    const bool real = row.range.kind == NumberKind::Real;
    for (const double value : {row.range.least - 1.0, 2.0 * row.range.most + 1.0}) {
      if (!real && value < 0.0) continue;
      const std::string complaint = parser.complaint(command, name, text(value));
      EXPECT_NE(complaint.find(name + ": got '" + text(value) + "', expected " + row.range.text()),
                std::string::npos)
          << complaint;
    }
    for (const double value : {row.range.least, row.range.most})
      EXPECT_EQ(parser.complaint(command, name, text(value)), "")
          << command << " " << name << " " << text(value);
  }
}

TEST(OptionRanges, RowsOfTheTables_AreTheOptionsRanges) {
  Parser parser;
  std::set<std::string> tried;
  expectEdges<BakeRequest>(parser, "bake", tried);
  expectEdges<AnimationKeys>(parser, "bake", tried);
  expectEdges<RefineRequest>(parser, "bake", tried);
  expectEdges<LoadOptions>(parser, "bake", tried);
#ifdef PRELIGHT_WITH_VIEWER
  expectEdges<reference::ReferenceRequest>(parser, "reference", tried);
  expectEdges<GlobalIlluminationPictureRequest>(parser, "render", tried);
  expectEdges<InstantOptions>(parser, "render", tried);
  expectEdges<viewer::ShadingOptions>(parser, "render", tried);
  expectEdges<pictures::PictureRequest>(parser, "render", tried);
  EXPECT_GE(tried.size(), 70u);
#endif
  EXPECT_GE(tried.size(), 28u);
}

}  // namespace
}  // namespace prelight::cli
