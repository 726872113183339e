#pragma once

namespace CLI {
class App;
}

/// The common part of the two programs. It does without CLI11's headers, which take long to compile.
namespace prelight::cli {

struct Context;

/// A function that adds the command `bench`.
using AddBench = void (*)(CLI::App& program, Context& context);

/// Parses the arguments and runs the command that they name; failures are reported on stderr. Returns the
/// exit code.
int runProgram(int argumentCount, char** arguments, AddBench addBench);

/// Adds `bench` to the program that bakes and draws, where the command becomes the program prelight-bench.
void addBenchRedirect(CLI::App& program, Context& context);

}  // namespace prelight::cli
