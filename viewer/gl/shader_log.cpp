#include "viewer/gl/shader_log.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string_view>

namespace prelight::viewer::gl {
namespace {

/// Takes the number that the text begins with off it.
std::optional<std::size_t> takeNumber(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

/// The line with the name of its file, or as it is where it names none.
std::string named(const std::string& line, const std::vector<std::string>& files) {
  constexpr std::string_view error = "ERROR: ";
  std::string_view rest = line;
  if (rest.starts_with(error)) rest.remove_prefix(error.size());
  const std::optional<std::size_t> file = takeNumber(rest);
  if (!file || *file >= files.size() || !(rest.starts_with(':') || rest.starts_with('('))) return line;
  rest.remove_prefix(1);
  const std::optional<std::size_t> number = takeNumber(rest);
  if (!number) return line;
  if (rest.starts_with(')')) rest.remove_prefix(1);
  return files[*file] + ":" + std::to_string(*number) + std::string(rest);
}

}  // namespace

std::string nameShaderFiles(const std::string& log, const std::vector<std::string>& files) {
  std::istringstream lines(log);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += "\n  " + named(line, files);
  return result;
}

}  // namespace prelight::viewer::gl
