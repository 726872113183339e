#pragma once

namespace CLI {
class App;
}

/// What the two programs have in common. Without the headers of command lines, which take longer to compile
/// than a main() is worth.
namespace prelight::cli {

struct Context;

/// Adds the command `bench`.
using AddBench = void (*)(CLI::App& program, Context& context);

/// Parses the arguments and runs the command that they name; failures are reported on stderr. Returns the
/// exit code.
int runProgram(int argumentCount, char** arguments, AddBench addBench);

/// Of the program that bakes and draws: `bench` becomes the program prelight-bench.
void addBenchRedirect(CLI::App& program, Context& context);

}  // namespace prelight::cli
