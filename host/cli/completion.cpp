#include "cli/completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace prelight::cli {
namespace {

/// Returns `text` with a backslash before every character of `special`.
std::string withBackslashes(std::string_view text, std::string_view special) {
  std::string result;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

std::string namesIn(const std::vector<OptionRow>& options) {
  std::vector<std::string> names;
  for (const OptionRow& option : options)
    if (option.named) names.insert(names.end(), option.names.begin(), option.names.end());
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bashCompletion(const CommandTable& table) {
  std::vector<std::string> commands;
  for (const CommandRow& command : table.commands) commands.push_back(command.name);
  std::string text = fmt::format(
      "# prelight(1) for bash\n"
      "_prelight() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} command= options= word\n"
      "  for word in \"${{COMP_WORDS[@]:1:COMP_CWORD-1}}\"; do\n"
      "    case $word in\n"
      "      {}) command=$word; break ;;\n"
      "    esac\n"
      "  done\n"
      "  case $command in\n",
      fmt::join(commands, "|"));
  for (const CommandRow& command : table.commands)
    text += fmt::format("    {}) options='{}' ;;\n", command.name, namesIn(command.options));
  text += fmt::format(
      "  esac\n"
      "  COMPREPLY=()\n"
      "  if [[ $current == -* ]]; then\n"
      "    COMPREPLY=($(compgen -W \"$options {}\" -- \"$current\"))\n"
      "  elif [[ -z $command ]]; then\n"
      "    COMPREPLY=($(compgen -W '{}' -- \"$current\"))\n"
      "  fi\n"
      "}}\n"
      "complete -o bashdefault -o default -F _prelight prelight\n",
      namesIn(table.options), fmt::join(commands, " "));
  return text;
}

/// Returns `text` for use between single quotes.
std::string zshText(std::string_view text, std::string_view special) {
  std::string result;
  for (const char c : withBackslashes(text, special)) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result;
}

std::string zshArguments(const std::vector<OptionRow>& options) {
  std::string text;
  for (const OptionRow& option : options) {
    if (!option.named) continue;
    for (const std::string& name : option.names)
      text += fmt::format(
          " \\\n        '{}{}[{}]{}'", option.repeats ? "*" : "", name, zshText(option.purpose, "\\[]:"),
          option.value.empty() ? "" : fmt::format(":{}:_files", zshText(option.value, "\\:")));
  }
  return text;
}

std::string zshCompletion(const CommandTable& table) {
  std::string text =
      "#compdef prelight\n"
      "_prelight() {\n"
      "  local state line\n"
      "  typeset -A opt_args\n"
      "  local -a commands=(\n";
  for (const CommandRow& command : table.commands)
    text += fmt::format("    '{}:{}'\n", command.name, zshText(command.purpose, "\\:"));
  text += fmt::format(
      "  )\n"
      "  local -a everywhere=({}\n"
      "  )\n"
      "  _arguments -C $everywhere '1:command:->command' '*::argument:->argument'\n"
      "  case $state in\n"
      "    command) _describe -t commands command commands ;;\n"
      "    argument)\n"
      "      case $words[1] in\n",
      zshArguments(table.options));
  for (const CommandRow& command : table.commands)
    text += fmt::format("      {}) _arguments $everywhere{} \\\n        '*:file:_files' ;;\n", command.name,
                        zshArguments(command.options));
  return text + "      esac ;;\n  esac\n}\n_prelight \"$@\"\n";
}

std::string fishOptions(const std::vector<OptionRow>& options, const std::string& condition) {
  std::string text;
  for (const OptionRow& option : options) {
    if (!option.named) continue;
    text += "complete -c prelight" + condition;
    for (const std::string& name : option.names)
      text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    text += fmt::format("{} -d '{}'\n", option.value.empty() ? "" : " -r",
                        withBackslashes(option.purpose, "\\'"));
  }
  return text;
}

std::string fishCompletion(const CommandTable& table) {
  std::string text = "# prelight(1) for fish\n" + fishOptions(table.options, "");
  for (const CommandRow& command : table.commands) {
    text += fmt::format("complete -c prelight -n __fish_use_subcommand -f -a {} -d '{}'\n", command.name,
                        withBackslashes(command.purpose, "\\'"));
    text += fishOptions(command.options, fmt::format(" -n '__fish_seen_subcommand_from {}'", command.name));
  }
  return text;
}

}  // namespace

std::string completion(const CommandTable& table, Shell shell) {
  switch (shell) {
    case Shell::Zsh:
      return zshCompletion(table);
    case Shell::Fish:
      return fishCompletion(table);
    case Shell::Bash:
      break;
  }
  return bashCompletion(table);
}

}  // namespace prelight::cli
