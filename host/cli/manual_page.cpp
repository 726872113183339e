#include "cli/manual_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "prelight/error.h"

namespace prelight::cli {
namespace {

/// Escapes text for roff, where a dot at the beginning of a line starts a request and a plain - is a hyphen.
std::string roff(std::string_view text) {
  std::string escaped;
  bool lineBegins = true;
  for (const char c : text) {
    if (lineBegins && (c == '.' || c == '\'')) escaped += "\\&";
    lineBegins = c == '\n';
    if (c == '\\')
      escaped += "\\e";
    else if (c == '-')
      escaped += "\\-";
    else
      escaped += c;
  }
  return escaped;
}

std::string optionEntry(const OptionRow& option) {
  const std::string value = option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(option.value));
  const std::string names = roff(fmt::format("{}", fmt::join(option.names, ", ")));
  const std::string tag =
      option.named ? fmt::format("\\fB{}\\fR{}", names, value) : fmt::format("\\fI{}\\fR", names);
  return fmt::format(".TP\n{}\n{}{}\n", tag, roff(option.purpose),
                     option.required && option.named ? " (required)" : "");
}

std::string commandSection(const CommandRow& command) {
  std::string text = fmt::format(".SS {}\n{}.\n", roff(command.name), roff(command.purpose));
  for (const OptionRow& option : command.options) text += optionEntry(option);
  if (!command.examples.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.examples));
  return text;
}

std::string exitStatus() {
  constexpr std::pair<ExitCode, const char*> codes[] = {{ExitCode::Done, "done"},
                                                        {ExitCode::RuntimeFailure, "failed at run time"},
                                                        {ExitCode::BadUsage, "bad usage"},
                                                        {ExitCode::BadInput, "bad input file"},
                                                        {ExitCode::NoDevice, "no usable OpenCL device"},
                                                        {ExitCode::OutOfMemory, "out of memory"},
                                                        {ExitCode::Interrupted, "interrupted"}};
  std::string text = ".SH EXIT STATUS\n";
  for (const auto& [code, meaning] : codes)
    text += fmt::format(".TP\n.B {}\n{}\n", static_cast<int>(code), meaning);
  return text;
}

}  // namespace

std::string manualPage(const CommandTable& table, std::string_view version) {
  std::string text = fmt::format(
      ".TH PRELIGHT 1 \"\" \"Prelight {}\" \"User Commands\"\n"
      ".SH NAME\nprelight \\- bake the light transport of glTF scenes, and relight them\n"
      ".SH SYNOPSIS\n.B prelight\n.I COMMAND\n[\\fIARGUMENTS\\fR] [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.PP\n\\fBprelight help\\fR shows the commands for what you want to do.\n"
      ".SH OPTIONS\nThese may stand before or after the command.\n",
      roff(version), roff(table.purpose));
  for (const OptionRow& option : table.options) text += optionEntry(option);
  text += ".SH COMMANDS\n";
  for (const CommandRow& command : table.commands) text += commandSection(command);
  return text + exitStatus();
}

}  // namespace prelight::cli
