#include "cli/command_table.h"

namespace prelight::cli {
namespace {

OptionRow rowOf(const CLI::Option& option) {
  OptionRow row;
  for (const std::string& name : option.get_snames()) row.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) row.names.push_back("--" + name);
  row.named = !row.names.empty();
  if (!row.named) row.names.push_back(option.get_name(true));
  if (row.named && option.get_items_expected_max() > 0) {
    row.value = option.get_type_name();
    if (row.value.empty()) row.value = "VALUE";
  }
  row.purpose = option.get_description();
  row.required = option.get_required();
  row.repeats = option.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll;
  return row;
}

std::vector<OptionRow> rowsOf(const CLI::App& app, bool withHelp) {
  std::vector<OptionRow> rows;
  for (const CLI::Option* option : app.get_options({}))
    if (withHelp || option != app.get_help_ptr()) rows.push_back(rowOf(*option));
  return rows;
}

}  // namespace

CommandTable commandTable(const CLI::App& program) {
  CommandTable table{program.get_description(), rowsOf(program, true), {}};
  for (const CLI::App* command : program.get_subcommands({}))
    table.commands.push_back(
        {command->get_name(), command->get_description(), command->get_footer(), rowsOf(*command, false)});
  return table;
}

}  // namespace prelight::cli
