#include <fmt/format.h>

#include <exception>
#include <new>
#include <string>
#include <vector>

#include "base/error.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/terminal_progress.h"

namespace prelight::cli {
namespace {

void addGlobalOptions(CLI::App& program, GlobalOptions& global) {
  const std::string group = "Global options (before or after the command)";
  program
      .add_option("--device", global.device,
                  "OpenCL device: a number of `prelight devices`, or part of its name")
      ->type_name("SUBSTRING|INDEX")
      ->group(group);
  program.add_flag("--json", global.json, "print the result as JSON on stdout")->group(group);
  CLI::Option* quiet = program.add_flag("--quiet", global.quiet, "print nothing but errors")->group(group);
  program.add_flag("--verbose", global.verbose, "print more: stages, the plan, every warning")
      ->group(group)
      ->excludes(quiet);
}

void addCommands(CLI::App& program, const GlobalOptions& global) {
  addBakeCommand(program, global);
  addRenderCommand(program, global);
  addViewCommand(program, global);
  addInfoCommand(program, global);
  addSceneCommand(program, global);
  addDevicesCommand(program, global);
  addCompareCommand(program, global);
}

/// The names of a command's own options, or of all commands: what was possible where something else was got.
std::string choices(const CLI::App& app, bool commands) {
  std::string list;
  const auto append = [&](const std::string& name) { list += (list.empty() ? "" : ", ") + name; };
  if (commands) {
    for (const CLI::App* sub : app.get_subcommands({})) append(sub->get_name());
  } else {
    for (const CLI::Option* option : app.get_options({}))
      if (option->nonpositional() && !option->get_lnames().empty())
        append("--" + option->get_lnames().front());
  }
  return list;
}

/// Says what the first argument that nobody took should have been.
std::string unexpectedArgument(const CLI::App& program, const CLI::App* command,
                               const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments)
    if (argument.size() > 1 && argument.front() == '-') {
      const CLI::App& app = command != nullptr ? *command : program;
      return fmt::format("{}: unknown option; {} takes {}", argument, app.get_name(), choices(app, false));
    }
  if (command == nullptr)
    return fmt::format("{}: unknown command; this version has {}", arguments.front(), choices(program, true));
  return fmt::format("{}: one argument too many", arguments.front());
}

int reportUsage(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
  const std::vector<std::string> unexpected = program.remaining(true);
  std::string text =
      unexpected.empty() ? std::string(error.what()) : unexpectedArgument(program, command, unexpected);
  if (unexpected.empty() && command == nullptr && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr)
    text = fmt::format("a command is required, one of {}", choices(program, true));
  printError(
      fmt::format("{} (see prelight {}--help)", text, command == nullptr ? "" : command->get_name() + " "));
  return static_cast<int>(ExitCode::BadUsage);
}

int run(int argumentCount, const char* const* arguments) {
  GlobalOptions global;
  CLI::App program(
      "Prelight precomputes how light travels through a glTF scene and relights it in real time.",
      "prelight");
  program.set_version_flag("--version", std::string("prelight ") + PRELIGHT_VERSION);
  program.require_subcommand(1);
  program.fallthrough();
  program.get_formatter()->column_width(34);
  program.footer("Example:\n  prelight scene shapes -o shapes.glb && prelight bake shapes.glb -o baked.glb");
  addGlobalOptions(program, global);
  addCommands(program, global);
  try {
    program.parse(argumentCount, arguments);
  } catch (const CLI::Success& help) {  // --help and --version
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    return reportUsage(program, error);
  }
  return static_cast<int>(ExitCode::Done);
}

}  // namespace
}  // namespace prelight::cli

int main(int argumentCount, char** arguments) {
  using prelight::ExitCode;
  prelight::cli::installSignalHandlers();
  try {
    return prelight::cli::run(argumentCount, arguments);
  } catch (const prelight::Error& error) {
    prelight::cli::printError(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    prelight::cli::printError(
        "out of memory (give the bake less with --max-memory, or close other programs)");
    return static_cast<int>(ExitCode::OutOfMemory);
  } catch (const std::exception& error) {
    prelight::cli::printError(error.what());
    return static_cast<int>(ExitCode::RuntimeFailure);
  }
}
