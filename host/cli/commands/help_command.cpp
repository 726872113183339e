#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "cli/command_table.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/manual_page.h"
#include "cli/options/values.h"
#include "prelight/error.h"

namespace prelight::cli {
namespace {

struct HelpCommand {
  std::string word;  ///< a task or a command; empty: none
  bool manual = false;
  std::optional<Shell> shell;
};

/// Something that people want to do, with the commands for it as they are typed.
struct Task {
  std::string_view name, purpose, commands;
};

constexpr std::array<Task, 9> tasks = {{
    {"start", "Bake a scene, look at it, and see it under another sky",
     "  prelight scene shapes -o shapes.glb\n"
     "  prelight bake shapes.glb -o baked.glb\n"
     "  prelight view baked.glb\n"
     "  prelight render baked.glb -o other.png --env studio\n"},
    {"lightmap", "Put the light of the scene's own lamps into a picture that any program can show",
     "  prelight scene rooms -o rooms.glb\n"
     "  prelight bake rooms.glb -o lit.glb --lightmap\n"
     "  prelight render lit.glb -o lit.png --shading lightmap\n"
     "  prelight export lit.glb -o lit\n"},
    {"export", "Take what was baked to three.js, Blender or another program",
     "  prelight bake model.glb -o baked.glb --lightmap --ao\n"
     "  prelight export baked.glb -o folder --target three\n"
     "  prelight export baked.glb -o plain.glb --as vertex-light\n"},
    {"picture", "Draw a picture of a scene with all its light, without a bake",
     "  prelight render model.glb -o picture.png --shading full\n"
     "  prelight reference model.glb -o truth.exr --spp 64\n"},
    {"check", "Measure how far a baked picture is from the truth",
     "  prelight render baked.glb -o baked.exr --shading sh --env sky.hdr --size 320x180\n"
     "  prelight reference model.glb -o truth.exr --error 0.01 --env sky.hdr --size 320x180\n"
     "  prelight compare baked.exr truth.exr\n"},
    {"occlusion", "Darken corners by ambient occlusion",
     "  prelight bake model.glb -o dark.glb --ao\n"
     "  prelight render dark.glb -o dark.png --shading ao\n"
     "  prelight export dark.glb -o plain.glb --as occlusion\n"},
    {"relight", "Move lamps and turn the sky over a baked scene, with their shadows",
     "  prelight bake model.glb -o baked.glb --sh 5 --bounces 2 --near-lamps 6\n"
     "  prelight view baked.glb --shading sh --env studio\n"},
    {"size", "Find out what a bake would do, and what time and memory it would take, before it runs",
     "  prelight info model.glb --sh 4 --bounces 2\n"
     "  prelight bake model.glb -o baked.glb --sh 4 --bounces 2 --dry-run\n"
     "  prelight render model.glb -o picture.png --shading full --dry-run\n"
     "  prelight bake model.glb -o baked.glb --sh 4 --bounces 2 --max-memory 4G\n"},
    {"machines", "Divide a long picture or bake among several machines",
     "  prelight reference model.glb -o 1.part --spp 4096 --slice 1/2\n"
     "  prelight reference model.glb -o 2.part --spp 4096 --slice 2/2\n"
     "  prelight merge 1.part 2.part -o truth.exr\n"
     "  prelight bake model.glb -o baked.glb --sh 4 --bounces 2 --stages\n"},
}};

std::string taskList() {
  std::string text = "What do you want to do?\n\n";
  for (const Task& task : tasks) text += fmt::format("  prelight help {:<10} {}\n", task.name, task.purpose);
  return text + "\nprelight --help lists all commands, prelight help COMMAND the options of one.\n";
}

/// Returns a task's text, or a command's help.
std::string helpOf(const CLI::App& program, const std::string& word) {
  std::vector<std::string> names;
  for (const Task& task : tasks) {
    if (task.name == word) return fmt::format("{}\n\n{}", task.purpose, task.commands);
    names.emplace_back(task.name);
  }
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return command->help(program.get_name());
    names.push_back(command->get_name());
  }
  throw UsageError("help " + word, "there is no such task or command",
                   didYouMean(word, names) + "prelight help lists the tasks");
}

std::string helpText(const HelpCommand& command, const CLI::App& program) {
  if (command.manual) return manualPage(commandTable(program), PRELIGHT_VERSION);
  if (command.shell) return completion(commandTable(program), *command.shell);
  return command.word.empty() ? taskList() : helpOf(program, command.word);
}

}  // namespace

void addHelpCommand(CLI::App& program, Context& context) {
  const auto command = std::make_shared<HelpCommand>();
  CLI::App* app = program.add_subcommand("help", "Show how to do what you want to do");
  app->add_option("TASK", command->word, "a task that `prelight help` lists, or a command")->type_name("");
  app->add_flag("--man", command->manual, "the manual page prelight(1)");
  addNamed<Shell, 3>(
      *app, "--completion", {{{"bash", Shell::Bash}, {"zsh", Shell::Zsh}, {"fish", Shell::Fish}}},
      [command](Shell shell) { command->shell = shell; },
      "the script that completes commands in bash, zsh or fish");
  app->footer(
      "Examples:\n"
      "  prelight help\n"
      "  prelight help lightmap\n"
      "  prelight help bake\n"
      "  prelight help --completion bash > ~/.local/share/bash-completion/completions/prelight\n"
      "  prelight help --man > prelight.1");
  app->callback([command, &program, &context] { context.output.write(helpText(*command, program)); });
}

}  // namespace prelight::cli
