#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/work_parts.h"
#include "cli/commands.h"
#include "cli/console/console.h"
#include "cli/division/division_options.h"

namespace prelight::cli {
namespace {

struct MergeCommand {
  std::vector<std::filesystem::path> parts;
  std::filesystem::path output;
  bool anyDevice = false;
};

void runMerge(const CLI::App& program, const MergeCommand& command, Context& context) {
  // The others are of the same work, or are refused as --parts.
  std::vector<std::string> arguments = readPartTitle(command.parts.front()).arguments;
  requireRecorded(program, command.parts.front(), arguments);
  Console(context.options, context.output)
      .line("merging", fmt::format("prelight {}", fmt::join(arguments, " ")));
  arguments.insert(arguments.end(), {"--output", command.output.string()});
  for (const std::filesystem::path& part : command.parts) arguments.push_back("--parts=" + part.string());
  if (command.anyDevice) arguments.emplace_back("--any-device");
  context.runAgain(arguments);
}

}  // namespace

void addMergeCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<MergeCommand>();
  CLI::App* app =
      program.add_subcommand("merge", "Put together what slices of a bake or a reference have done");
  app->add_option("PARTS", command->parts,
                  "files that --slice has written, in any order; what slices that "
                  "are missing would have done is done here")
      ->required()
      ->type_name("");
  app->add_option("-o,--output", command->output,
                  "baked file or picture to write, as the slices' command would; while stages are left, a "
                  "state for their slices (OUT.state) is written in its place")
      ->required()
      ->type_name("OUT");
  app->add_flag("--any-device", command->anyDevice,
                "take work of other devices, too: results may then depend on which device did what");
  app->footer(
      "Examples:\n"
      "  prelight reference level.glb -o 1.part --spp 4096 --slice 1/2\n"
      "  prelight reference level.glb -o 2.part --spp 4096 --slice 2/2\n"
      "  prelight merge 1.part 2.part -o truth.exr");
  app->callback([command, &program, &context] { runMerge(program, *command, context); });
}

}  // namespace prelight::cli
