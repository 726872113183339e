#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

#include "cli/commands.h"
#include "cli/run_program.h"
#include "prelight/error.h"

/// The benchmarks are a program of their own, prelight-bench, so that people who only want to bake need not
/// compile them. `prelight bench` replaces itself by that program.
namespace prelight::cli {
namespace {

[[noreturn]] void becomeBenchmarks(const Context& context) {
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const std::string program = folder / "prelight-bench";
  execv(program.c_str(), context.arguments);
  const std::error_code failed(errno, std::generic_category());
  throw Error(
      ExitCode::RuntimeFailure, "bench", "cannot start " + program + ": " + failed.message(),
      "build it: cmake --build BUILD_FOLDER --target prelight_bench, configured with PRELIGHT_BENCHMARKS=ON");
}

}  // namespace

void addBenchRedirect(CLI::App& program, Context& context) {
  CLI::App* app = program.add_subcommand("bench", "Measure speed and error on built-in scenes");
  app->set_help_flag();  // all arguments belong to the other program
  app->prefix_command()->fallthrough(false);
  app->callback([&context] { becomeBenchmarks(context); });
}

}  // namespace prelight::cli
