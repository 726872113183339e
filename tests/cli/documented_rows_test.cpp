#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "architecture/source_files.h"
#include "gi/probes/probe_light.h"
#include "prelight/options.h"
#include "prelight/refine.h"
#ifdef PRELIGHT_WITH_VIEWER
#include "integrators/reference.h"
#include "pictures/picture_request.h"
#include "viewer/options/shading_options.h"
#endif

namespace prelight::cli {
namespace {

/// An option of a table with its default.
struct Documented {
  OptionInfo row;
  std::optional<double> usual;
};

template <typename Options>
void addRows(std::vector<Documented>& rows) {
  for (const Option<Options>& row : optionsOf<Options>()) rows.push_back({row, row.usualValue()});
}

std::vector<Documented> allRows() {
  std::vector<Documented> rows;
  addRows<BakeRequest>(rows);
  addRows<AnimationKeys>(rows);
  addRows<RefineRequest>(rows);
  addRows<LoadOptions>(rows);
  addRows<ProbeRequest>(rows);
#ifdef PRELIGHT_WITH_VIEWER
  addRows<reference::ReferenceRequest>(rows);
  addRows<GlobalIlluminationPictureRequest>(rows);
  addRows<InstantOptions>(rows);
  addRows<viewer::ShadingOptions>(rows);
  addRows<viewer::RenderOptions>(rows);
  addRows<pictures::PictureRequest>(rows);
#endif
  return rows;
}

/// Returns the number that a page writes as "50,000", "1e-4" or "10⁶".
double numberOf(std::string text) {
  std::erase(text, ',');
  if (text == "10⁶") return 1e6;
  if (text == "2²¹") return 1 << 21;
  return std::stod(text);
}

const std::string number = R"((-?[0-9][0-9.,]*(?:e-?[0-9]+)?(?:⁶|²¹)?))";

/// Returns whether the range and the default that a line of the reference states are those of a row. A line
/// need not state them.
bool agrees(const std::string& line, const Documented& option) {
  std::smatch found;
  const OptionInfo& row = option.row;
  if (row.kind == OptionKind::Choice) {
    for (const Choice& choice : row.choices)
      if (line.find(fmt::format("`{}", choice.name)) == std::string::npos) return false;
    if (std::regex_search(line, found, std::regex("`([a-z-]+)`(?: \\(default\\)| \\|)")))
      return option.usual && found[1] == row.choices[static_cast<std::size_t>(*option.usual)].name;
    return true;
  }
  if (row.kind != OptionKind::Number) return true;
  if (std::regex_search(line, found, std::regex(number + " to " + number)) &&
      (numberOf(found[1]) != row.range.least || numberOf(found[2]) != row.range.most))
    return false;
  if (std::regex_search(line, found, std::regex("default " + number)) ||
      std::regex_search(line, found, std::regex(" to [^|]*\\| " + number + " \\|")))
    return option.usual && std::abs(numberOf(found[1]) - *option.usual) <= 0.01 * std::abs(*option.usual);
  return true;
}

/// Lines of the reference of options, the first name in each and the line.
std::vector<std::pair<std::string, std::string>> linesOfReference() {
  const std::string page = test::textOf("docs/command-line.md");
  const std::string described = page.substr(0, page.find("\n## bench\n"));
  const std::regex line("\n\\| `--([a-z-]+)[^\n]*");
  std::vector<std::pair<std::string, std::string>> lines;
  for (std::sregex_iterator at(described.begin(), described.end(), line), end; at != end; ++at)
    if (at->str().find("`, `--") == std::string::npos) lines.emplace_back((*at)[1], at->str());
  return lines;
}

TEST(DocumentedRows, RangesDefaultsAndChoices_AreThoseOfTheTables) {
  const std::vector<Documented> rows = allRows();
  std::size_t compared = 0;
  for (const auto& [name, line] : linesOfReference()) {
    bool known = false, right = false;
    for (const Documented& option : rows) {
      if (option.row.name != name || option.row.commandLine != nullptr) continue;
      known = true;
      right = right || agrees(line, option);
    }
    if (known) ++compared;
    EXPECT_TRUE(!known || right) << "docs/command-line.md differs from the table of options:" << line;
  }
#ifdef PRELIGHT_WITH_VIEWER
  EXPECT_GT(compared, 90u) << "the lines were not found";
#endif
  EXPECT_GT(compared, 30u) << "the lines were not found";
}

}  // namespace
}  // namespace prelight::cli
