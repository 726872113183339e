#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>

#include "architecture/source_files.h"
#include "cli/cli_test.h"

namespace prelight::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* notes =
    "docs/notes";  // techniques.md, and pages of techniques with tables of the same form

/// A row of the tables: cells by the names of their columns.
using Row = std::map<std::string, std::string>;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') + 1 - first);
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) cells.push_back(trimmed(cell));
  return cells;
}

/// Adds the rows of all tables of a page whose first column is `technique`.
void addRowsOf(const std::string& page, std::vector<Row>& rows) {
  std::vector<std::string> columns;
  std::istringstream in(textOf(page));
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("|")) {
      columns.clear();
      continue;
    }
    if (line.starts_with("|---")) continue;
    const std::vector<std::string> cells = cellsOf(line);
    if (line.starts_with("| technique |")) {
      columns = cells;
      continue;
    }
    if (columns.empty()) continue;
    EXPECT_EQ(cells.size(), columns.size()) << line;
    Row row;
    for (std::size_t i = 0; i < std::min(cells.size(), columns.size()); ++i) row[columns[i]] = cells[i];
    rows.push_back(row);
  }
}

std::vector<Row> techniqueRows() {
  std::vector<Row> rows;
  for (const std::string& page : filesBelow(notes, {".md"})) addRowsOf(page, rows);
  return rows;
}

std::vector<std::string> matchesIn(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

class DocumentedTechniques : public CliTest {
 protected:
  /// The names that an option accepts, taken from the error for an unknown name.
  std::vector<std::string> namesOf(const std::string& option) const {
    const std::string errors = prelight({"render", "x.glb", "-o", "y.png", option, "no-such-name"}).errors;
    const std::vector<std::string> lists = matchesIn(errors, "\\((?:one of:|expected) ([^)]*)\\)");
    EXPECT_EQ(lists.size(), 1u) << errors;
    const std::vector<std::string> names =
        lists.empty() ? lists
                      : matchesIn(std::regex_replace(lists[0], std::regex(" or "), ", "), "([a-z0-9-]+)");
    EXPECT_GT(names.size(), 1u) << errors;
    return names;
  }

  /// Expects a row for each name that the option accepts, with that option in the column of how to ask for
  /// it.
  void expectRows(const std::string& option, const std::vector<std::string>& but = {}) const {
    const std::vector<Row> rows = techniqueRows();
    for (const std::string& name : namesOf(option)) {
      if (std::count(but.begin(), but.end(), name) > 0) continue;
      const std::regex asked("`[^`]*" + option + " " + name + "(?![a-z0-9-])[^`]*`");
      EXPECT_TRUE(
          std::any_of(rows.begin(), rows.end(),
                      [&](const Row& row) { return std::regex_search(row.at("asked for by"), asked); }))
          << notes << " has no row for " << option << " " << name;
    }
  }
};

TEST_F(DocumentedTechniques, EveryShading_HasARow) { expectRows("--shading", {"screen"}); }

TEST_F(DocumentedTechniques, EveryWayToFindOcclusion_HasARow) {
  expectRows("--occlusion");
  expectRows("--ao-correction", {"none"});
}

TEST_F(DocumentedTechniques, Cells_AreFilled_ErrorsAndCostsInNumbers) {
  const std::vector<Row> rows = techniqueRows();
  EXPECT_GE(rows.size(), 20u);
  for (const Row& row : rows) {
    for (const auto& [column, cell] : row)
      EXPECT_FALSE(cell.empty()) << row.at("technique") << ": " << column;
    for (const char* column : {"error against traced truth", "cost"})
      EXPECT_TRUE(std::regex_search(row.at(column), std::regex("[0-9]")))
          << row.at("technique") << ": " << column;
  }
}

TEST_F(DocumentedTechniques, OptionsThatTheyName_AreThePrograms) {
  std::string help;
  for (const char* command : {"bake", "render", "reference"})
    help += prelightDone({command, "--help"}).output;
  for (const Row& row : techniqueRows())
    for (const char* column : {"asked for by", "parameters"})
      for (const std::string& option : matchesIn(row.at(column), "(--[a-z][a-z-]*)"))
        EXPECT_TRUE(std::regex_search(help, std::regex("\\s" + option + "\\b(?!-)")))
            << row.at("technique") << " names " << option;
}

/// The test `Subject.Condition_Expectation` is in the file that the cell names, in GoogleTest's notation.
TEST_F(DocumentedTechniques, TestsThatTheyName_Exist) {
  for (const Row& row : techniqueRows()) {
    const std::string& cell = row.at("test");
    const std::vector<std::string> files = matchesIn(cell, "`(tests/[a-z0-9_/]+\\.cpp)`");
    const std::vector<std::string> tests = matchesIn(cell, "`([A-Za-z0-9]+\\.[A-Za-z0-9_]+)`");
    EXPECT_FALSE(files.empty()) << row.at("technique");
    EXPECT_EQ(tests.size(), files.size()) << row.at("technique") << ": a test a file";
    for (std::size_t i = 0; i < std::min(files.size(), tests.size()); ++i) {
      const std::size_t point = tests[i].find('.');
      const std::string name = tests[i].substr(0, point) + ", " + tests[i].substr(point + 1) + ")";
      EXPECT_THAT(textOf(files[i]), ::testing::HasSubstr(name)) << row.at("technique");
    }
  }
}

TEST_F(DocumentedTechniques, Pictures_Exist) {
  for (const Row& row : techniqueRows()) {
    const std::vector<std::string> pictures = matchesIn(row.at("picture"), "\\]\\(\\.\\./(images/[^)]+)\\)");
    EXPECT_FALSE(pictures.empty()) << row.at("technique");
    for (const std::string& picture : pictures)
      EXPECT_TRUE(fs::exists(sourceRoot() / "docs" / picture)) << picture;
  }
}

}  // namespace
}  // namespace prelight::test
