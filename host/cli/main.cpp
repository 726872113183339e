#include "cli/run_program.h"

int main(int argumentCount, char** arguments) {
  return prelight::cli::runProgram(argumentCount, arguments, prelight::cli::addBenchRedirect);
}
