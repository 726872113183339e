#include "cli/console/console.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "cli/console/printable.h"
#include "cli/options/option_names.h"

namespace prelight::cli {
namespace {

constexpr std::size_t shownWarnings = 10;

std::string label(std::string_view word, int colorCode) {
  if (!mayColor(STDERR_FILENO)) return fmt::format("prelight: {}: ", word);
  return fmt::format("prelight: \x1b[1;{}m{}:\x1b[0m ", colorCode, word);
}

void printWarning(std::string_view text) {
  writeError(label("warning", 33) + printable(withOptions(text)) + '\n');
}

std::string scaled(double value, double base, const std::array<const char*, 5>& units) {
  std::size_t unit = 0;
  while (value >= base && unit + 1 < units.size()) {
    value /= base;
    ++unit;
  }
  if (unit == 0) return fmt::format("{:.0f}{}", value, units[0]);
  return fmt::format("{:.{}f}{}", value, value < 100.0 ? 1 : 0, units[unit]);
}

}  // namespace

void Console::line(std::string_view name, std::string_view text) const {
  if (textWanted()) output_.write(fmt::format("{:<10} {}\n", printable(name), printable(withOptions(text))));
}

void Console::json(const nlohmann::ordered_json& result) const {
  // A name from a file that is not valid UTF-8 must not make a finished bake fail.
  if (options_.json)
    output_.write(printableJson(withOptions(
                      result.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace))) +
                  '\n');
}

void Console::note(std::string_view text) const {
  if (!options_.quiet) writeError(fmt::format("prelight: {}\n", printable(withOptions(text))));
}

void Console::warn(const Warnings& warnings) const {
  if (options_.quiet) return;
  const std::size_t shown = options_.verbose ? warnings.size() : std::min(warnings.size(), shownWarnings);
  for (std::size_t i = 0; i < shown; ++i) printWarning(warnings[i]);
  if (shown < warnings.size())
    printWarning(fmt::format("{} more (--verbose shows all)", warnings.size() - shown));
}

bool mayColor(int fileDescriptor) {
  const char* noColor = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  const bool refused = noColor != nullptr && *noColor != '\0';
  const bool dumb = terminal != nullptr && std::string_view(terminal) == "dumb";
  return !refused && !dumb && isatty(fileDescriptor) == 1;
}

void printError(std::string_view text) {
  writeError(label("error", 31) + printable(withOptions(text)) + '\n');
}

std::string shortCount(double value) { return scaled(value, 1000.0, {"", " k", " M", " G", " T"}); }

std::string shortBytes(double bytes) { return scaled(bytes, 1024.0, {" B", " KiB", " MiB", " GiB", " TiB"}); }

std::string shortSeconds(double seconds) {
  if (!(seconds >= 120.0)) return fmt::format("{:.2f} s", seconds);
  if (seconds > 1e9) return fmt::format("{:.3g} s", seconds);
  const auto whole = static_cast<long>(seconds);
  return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

}  // namespace prelight::cli
