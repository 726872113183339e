#include "cli/options/option_names.h"

#include <algorithm>
#include <cctype>

#include "cli/options/options.h"
#include "gi/probes/probe_light.h"
#include "prelight/find_option.h"

namespace prelight::cli {
namespace {

bool isOfName(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':'; }

/// Returns the end of the name that begins at `at`. A colon without a letter after it ends part of a
/// sentence, not a name.
std::size_t endOfName(std::string_view text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isOfName(text[end])) ++end;
  while (end > at && text[end - 1] == ':') --end;
  return std::max(end, at + 1);
}

/// Returns the option that sets what the library calls `name`, or an empty text if there is none.
std::string optionOf(std::string_view name) {
  if (name.find("::") == std::string_view::npos) return {};
  if (const OptionInfo* row = findOption(name)) return optionName(*row);
  for (const Option<ProbeRequest>& row : optionsOf<ProbeRequest>())
    if (row.field == name) return optionName(row);
  return {};
}

}  // namespace

std::string withOptions(std::string_view text) {
  std::string replaced;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = endOfName(text, at);
    const std::string_view name = text.substr(at, end - at);
    const std::string option = optionOf(name);
    replaced += option.empty() ? name : option;
    at = end;
  }
  return replaced;
}

}  // namespace prelight::cli
