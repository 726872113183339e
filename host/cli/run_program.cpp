#include "cli/run_program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "base/large_stack.h"
#include "base/text.h"
#include "cli/commands.h"
#include "cli/commit.h"
#include "cli/console/console.h"
#include "cli/console/keep_memory.h"
#include "cli/console/last_resort.h"
#include "cli/console/printable.h"
#include "cli/console/process_limits.h"
#include "cli/console/standard_streams.h"
#include "cli/context.h"
#include "prelight/error.h"

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
  program
      .add_flag("--allow-outside", global.allowOutside,
                "let a scene name buffers, images, profiles and light maps outside of its folder")
      ->group(group);
  CLI::Option* quiet = program.add_flag("--quiet", global.quiet, "print nothing but errors")->group(group);
  program.add_flag("--verbose", global.verbose, "print more: stages, the plan, every warning")
      ->group(group)
      ->excludes(quiet);
}

void addCommands(CLI::App& program, Context& context, AddBench addBench) {
  addBakeCommand(program, context);
  addRenderCommand(program, context);
  addReferenceCommand(program, context);
  addViewCommand(program, context);
  addMergeCommand(program, context);
  addExportCommand(program, context);
  addInfoCommand(program, context);
  addSceneCommand(program, context);
  addDevicesCommand(program, context);
  addBench(program, context);
  addCompareCommand(program, context);
  addPlotCommand(program, context);
  addHelpCommand(program, context);
}

/// Formats help without CLI11's "Excludes:", which drowns what an option does.
class HelpFormatter final : public CLI::Formatter {
 public:
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string type = option->get_type_name();
    return (type.empty() ? "" : " " + type) + (option->get_required() ? " (required)" : "");
  }
};

std::vector<std::string> commandNames(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
  return names;
}

/// Returns "WORD: unknown KIND; did you mean NAME? LEAD NAME, NAME, ...".
std::string unknownName(const std::string& word, std::string_view kind, const std::vector<std::string>& names,
                        const std::string& lead) {
  return fmt::format("{}: unknown {}; {}{} {}", word, kind, didYouMean(word.substr(0, word.find('=')), names),
                     lead, fmt::join(names, ", "));
}

/// Says what the first unexpected argument should have been.
std::string unexpectedArgument(const CLI::App& program, const CLI::App* command,
                               const std::vector<std::string>& arguments) {
  const auto isOption = [](const std::string& argument) {
    return argument.size() > 1 && argument.front() == '-';
  };
  const auto option = std::find_if(arguments.begin(), arguments.end(), isOption);
  const auto word = std::find_if_not(arguments.begin(), arguments.end(), isOption);
  if (command == nullptr && word != arguments.end())
    return unknownName(*word, "command", commandNames(program), "this version has");
  if (option == arguments.end()) return fmt::format("{}: unexpected argument", *word);
  const CLI::App& app = command != nullptr ? *command : program;
  return unknownName(*option, "option", optionNames(app), app.get_name() + " takes");
}

int reportUsage(const CLI::App& program, const CLI::ParseError& error) {
  const std::vector<CLI::App*> chosen = program.get_subcommands();
  const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
  const std::vector<std::string> unexpected = program.remaining(true);
  std::string text = error.what();
  if (!unexpected.empty()) {
    text = unexpectedArgument(program, command, unexpected);
  } else if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) {
    text = text.substr(0, text.find(':')) + ": expected exactly one value";
  } else if (command == nullptr && dynamic_cast<const CLI::RequiredError*>(&error) != nullptr) {
    text = fmt::format("a command is required, one of {}; prelight help shows how to begin",
                       fmt::join(commandNames(program), ", "));
  }
  printError(
      fmt::format("{} (see prelight {}--help)", text, command == nullptr ? "" : command->get_name() + " "));
  return static_cast<int>(ExitCode::BadUsage);
}

/// Sets up a program with all commands.
void describe(CLI::App& program, AddBench addBench, Context& context) {
  program.description(
      "Prelight precomputes how light travels through a glTF scene and relights it in real time.");
  program.set_version_flag("--version", fmt::format("prelight {} ({})", PRELIGHT_VERSION, commitName()));
  program.require_subcommand(1);
  program.fallthrough();
  const auto formatter = std::make_shared<HelpFormatter>();
  formatter->column_width(34);
  program.formatter(formatter);
  program.footer("Example:\n  prelight scene shapes -o shapes.glb && prelight bake shapes.glb -o baked.glb");
  addGlobalOptions(program, context.options);
  addCommands(program, context, addBench);
}

int run(int argumentCount, const char* const* arguments, AddBench addBench, Context& context) {
  CLI::App program("", "prelight");
  describe(program, addBench, context);
  context.runAgain = [&](const std::vector<std::string>& others) {
    CLI::App again("", "prelight");
    describe(again, addBench, context);
    again.parse(std::vector<std::string>(others.rbegin(), others.rend()));
  };
  try {
    program.parse(argumentCount, arguments);
  } catch (const CLI::Success& help) {  // thrown by --help and --version
    std::ostringstream text;
    const int code = program.exit(help, text, text);
    context.output.write(text.str());
    return code;
  } catch (const CLI::ParseError& error) {
    return reportUsage(program, error);
  }
  return static_cast<int>(ExitCode::Done);
}

/// Uses constant texts, because there may be no memory to compose one.
int reportOutOfMemory() {
  writeError(
      "prelight: error: out of memory (give the bake less with --max-memory, or close other programs)\n");
  return static_cast<int>(ExitCode::OutOfMemory);
}

/// Returns whether an error means a lack of memory, which threads need, too.
bool isOutOfMemory(const std::error_code& error) {
  return error == std::errc::not_enough_memory || error == std::errc::resource_unavailable_try_again;
}

/// Prints what went wrong and returns its exit code.
int reportFailure(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const Error& error) {
    if (error.code() == ExitCode::Interrupted)
      writeError(printable(error.what()) + '\n');
    else
      printError(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    return reportOutOfMemory();
  } catch (const std::system_error& error) {
    if (isOutOfMemory(error.code())) return reportOutOfMemory();
    printError(error.what());
  } catch (const std::exception& error) {
    printError(error.what());
  } catch (...) {
    printError("unknown failure");
  }
  return static_cast<int>(ExitCode::RuntimeFailure);
}

/// Treats every failure after a request to stop as the stop itself.
int reportFailure(const std::exception_ptr& failure, const Context& context) {
  if (!context.signals.stopRequested()) return reportFailure(failure);
  try {
    std::rethrow_exception(failure);
  } catch (const Interrupted&) {
    return reportFailure(failure);
  } catch (...) {
    return reportFailure(std::make_exception_ptr(Interrupted("interrupted; no half-written output is left")));
  }
}

/// Turns the loss of a result on its way to stdout into a failure.
int reportLostOutput(int code, const StandardOutput& output) {
  const std::error_code lost = output.failure();
  if (!lost) return code;
  printError("stdout: cannot write the result: " + lost.message() +
             " (free the device, or send it elsewhere)");
  return code == static_cast<int>(ExitCode::Done) ? static_cast<int>(ExitCode::RuntimeFailure) : code;
}

int runReporting(int argumentCount, char* const* arguments, AddBench addBench) {
  openStandardStreams();
  ignoreWriteSignals();
  answerLastResorts();
  Context context;
  context.arguments = arguments;
  int code = 0;
  try {
    code = run(argumentCount, arguments, addBench, context);
  } catch (...) {
    code = reportFailure(std::current_exception(), context);
  }
  return reportLostOutput(code, context.output);
}

}  // namespace

int runProgram(int argumentCount, char** arguments, AddBench addBench) {
  keepFreedMemory();
  const auto work = [&] {
    try {
      return runReporting(argumentCount, arguments, addBench);
    } catch (...) {
      return reportFailure(std::current_exception());
    }
  };
  try {
    return onLargeStack(work);
  } catch (...) {  // no memory to parse the arguments
    return reportFailure(std::current_exception());
  }
}

}  // namespace prelight::cli
