#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "scene/json_cursor.h"

namespace prelight {

namespace {

std::string lineAndColumn(const std::string& file, std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t lineStart = before.rfind('\n');
  const std::size_t column = before.size() - (lineStart == std::string_view::npos ? 0 : lineStart + 1) + 1;
  return fmt::format("{}: line {}, column {}", file, line, column);
}

/// Bounds what the tree may cost before it is built: its users recurse over nesting, and an ordered object
/// looks for a duplicate of every new member one by one.
void checkShape(std::string_view text, const std::string& file) {
  constexpr std::size_t maxDepth = 128;
  constexpr std::size_t maxMembers = 16384;
  std::vector<std::size_t> members;  // of every open object or array
  bool inString = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      members.push_back(0);
      if (members.size() > maxDepth) {
        throw InputError(lineAndColumn(file, text, i), fmt::format("nested deeper than {} levels", maxDepth));
      }
    } else if (c == '}' || c == ']') {
      if (!members.empty()) members.pop_back();
    } else if (c == ':' && !members.empty() && ++members.back() > maxMembers) {
      throw InputError(lineAndColumn(file, text, i),
                       fmt::format("an object of more than {} members", maxMembers));
    }
  }
}

/// The library's message without its own error number and position, which the place already tells.
std::string plainMessage(std::string message) {
  const std::size_t colon = message.find(": ");
  if (colon != std::string::npos) message.erase(0, colon + 2);
  constexpr std::string_view prefix = "syntax error while parsing ";
  const std::size_t prefixAt = message.find(prefix);
  return prefixAt == std::string::npos ? message : message.substr(prefixAt);
}

}  // namespace

nlohmann::ordered_json parseJson(std::string_view text, const std::string& file) {
  checkShape(text, file);
  try {
    return nlohmann::ordered_json::parse(text.begin(), text.end());
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t offset = error.byte == 0 ? 0 : error.byte - 1;
    throw InputError(lineAndColumn(file, text, offset), plainMessage(error.what()));
  } catch (const nlohmann::json::out_of_range& error) {
    // A number beyond double's range; the library quotes it but does not say where it stands.
    const std::string message = plainMessage(error.what());
    const std::size_t open = message.find('\'');
    const std::size_t close = message.rfind('\'');
    std::size_t offset = 0;
    if (open != std::string::npos && close > open) {
      offset = text.find(message.substr(open + 1, close - open - 1));
    }
    throw InputError(lineAndColumn(file, text, offset), message);
  }
}

}  // namespace prelight
