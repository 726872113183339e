#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "cli/cli_test.h"

// Checks docs/notes/sources.md: everything that it names exists, every row has a verdict, and its commands
// run.
namespace prelight::test {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t columns = 8;
enum Column { Source, What, Is, Files, SeenBy, Theirs, Here, Difference };

struct Row {
  std::string paper;  ///< First word of the heading above.
  std::vector<std::string> cells;
};

std::string textOf(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::string> matchesIn(const std::string& text, const std::string& pattern) {
  const std::regex expression(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line.substr(1));
  for (std::string cell; std::getline(in, cell, '|');) {
    const std::size_t first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos ? ""
                                               : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
  }
  return cells;
}

/// Rows of the chapters' tables, without the header rows.
std::vector<Row> rowsOfTheSources() {
  std::vector<Row> rows;
  std::istringstream document(textOf(fs::path(PRELIGHT_SOURCE_DIR) / "docs/notes/sources.md"));
  std::string paper;
  for (std::string line; std::getline(document, line);) {
    if (line.starts_with("## ")) paper = line.substr(3, line.find(' ', 3) - 3);
    if (paper.empty() || !line.starts_with("|") || line.starts_with("|---")) continue;
    if (std::vector<std::string> cells = cellsOf(line); cells.front() != "source")
      rows.push_back({paper, std::move(cells)});
  }
  return rows;
}

std::vector<std::string> namedIn(const std::string& cell) { return matchesIn(cell, "`([^`]+)`"); }

TEST(Sources, Rows_SayWhatIsThereAndOtherwiseWhyNot) {
  const std::vector<Row> rows = rowsOfTheSources();
  EXPECT_GT(rows.size(), 200u);
  for (const Row& row : rows) {
    SCOPED_TRACE(row.paper + ": " + row.cells.front());
    ASSERT_EQ(row.cells.size(), columns);
    const bool there = row.cells[Is] != "no";
    EXPECT_TRUE(row.cells[Is] == "yes" || row.cells[Is] == "part" || !there) << row.cells[Is];
    EXPECT_EQ(!namedIn(row.cells[Files]).empty(), there);
    EXPECT_EQ(!namedIn(row.cells[SeenBy]).empty(), there);
    EXPECT_EQ(!row.cells[Theirs].empty(), there);
    EXPECT_EQ(!row.cells[Here].empty(), there);
    EXPECT_FALSE(row.cells[Is] != "yes" && row.cells[Difference].empty());
    for (const std::string& cell : row.cells) EXPECT_EQ(cell.find("planned"), std::string::npos) << cell;
  }
}

/// Numbers stand only in cells that benchmarks/evidence/evidence.py writes: those that begin with their name.
TEST(Sources, NumbersThatNoRunHasPrinted_AreNotThere) {
  const std::regex links("\\([^)]*\\)"), digit("[0-9]");
  std::size_t measured = 0;
  for (const Row& row : rowsOfTheSources()) {
    const std::string& here = row.cells[Here];
    if (here.starts_with("<!--")) {
      EXPECT_TRUE(here.ends_with("]") || here.ends_with("> not measured")) << here;
      measured += here.ends_with("]") ? 1 : 0;
    } else {
      EXPECT_FALSE(std::regex_search(std::regex_replace(here, links, ""), digit))
          << row.cells[Source] << ": " << here;
    }
  }
  EXPECT_GT(measured, 40u);
}

TEST(Sources, Files_AreThere) {
  for (const Row& row : rowsOfTheSources())
    for (const std::string& file : namedIn(row.cells[Files]))
      EXPECT_TRUE(fs::exists(fs::path(PRELIGHT_SOURCE_DIR) / file)) << row.cells[Source] << ": " << file;
}

/// "Suite.Name" of every test in the sources.
std::set<std::string> testNames() {
  std::set<std::string> names;
  const std::regex definition("\\bTEST(?:_F|_P)?\\(\\s*(\\w+),\\s*(\\w+)");
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(PRELIGHT_SOURCE_DIR) / "tests")) {
    if (entry.path().extension() != ".cpp") continue;
    const std::string text = textOf(entry.path());
    for (std::sregex_iterator at(text.begin(), text.end(), definition), end; at != end; ++at)
      names.insert((*at)[1].str() + "." + (*at)[2].str());
  }
  return names;
}

TEST(Sources, Tests_AreThere) {
  const std::set<std::string> tests = testNames();
  std::size_t asked = 0;
  for (const Row& row : rowsOfTheSources())
    for (const std::string& pattern : matchesIn(row.cells[SeenBy], "`ctest -R ([^`]+)`")) {
      const std::regex expression(pattern);
      EXPECT_TRUE(std::any_of(tests.begin(), tests.end(),
                              [&](const std::string& name) { return std::regex_search(name, expression); }))
          << row.cells[Source] << ": " << pattern;
      ++asked;
    }
  EXPECT_GT(asked, 50u);
}

/// Adds the numbered items of a cell such as "5.1, Eq. 4.1 to 4.3, 4.5, Figure 1.1", as "Eq 4.1" and "Figure
/// 1.1".
void addNumbered(const std::string& cell, std::set<std::string>& numbered) {
  const std::regex token("(Eq|Figure|Table|Listing)s?\\b|(\\d+)\\.(\\d+)|\\b(to)\\b");
  std::string kind;
  int last = 0;
  bool until = false;
  for (std::sregex_iterator at(cell.begin(), cell.end(), token), end; at != end; ++at) {
    if ((*at)[1].matched) kind = (*at)[1];
    if ((*at)[4].matched) until = true;
    if (!(*at)[2].matched || kind.empty()) continue;
    const int number = std::stoi((*at)[3]);
    for (int i = until ? last + 1 : number; i <= number; ++i)
      numbered.insert(kind + " " + (*at)[2].str() + "." + std::to_string(i));
    last = number;
    until = false;
  }
}

/// Numbered items of a paper: kind, chapter, and first and last number.
struct NumberedItems {
  const char* paper;
  const char* kind;
  int chapter;
  int first;
  int last;
};

constexpr NumberedItems itemsOfTheSources[] = {
    {"Larsen", "Eq", 2, 1, 14},          {"Larsen", "Eq", 3, 1, 3},
    {"Larsen", "Eq", 4, 1, 2},           {"Larsen", "Eq", 5, 1, 3},
    {"Larsen", "Eq", 6, 1, 2},           {"Larsen", "Eq", 11, 1, 3},
    {"Larsen", "Eq", 12, 1, 5},          {"Larsen", "Eq", 13, 1, 2},
    {"Larsen", "Table", 1, 1, 3},        {"Larsen", "Table", 2, 1, 2},
    {"Larsen", "Table", 8, 1, 2},        {"Larsen", "Table", 14, 1, 2},
    {"Larsen", "Figure", 3, 1, 5},       {"Larsen", "Figure", 4, 1, 9},
    {"Larsen", "Figure", 5, 1, 4},       {"Larsen", "Figure", 6, 1, 3},
    {"Larsen", "Figure", 8, 1, 8},       {"Larsen", "Figure", 9, 1, 4},
    {"Larsen", "Figure", 10, 1, 2},      {"Larsen", "Figure", 11, 1, 2},
    {"Larsen", "Figure", 12, 1, 3},      {"Larsen", "Figure", 13, 1, 1},
    {"Larsen", "Figure", 14, 1, 6},      {"Real-Time", "Eq", 10, 40, 43},
    {"Real-Time", "Eq", 11, 1, 35},      {"Real-Time", "Table", 11, 1, 1},
    {"Real-Time", "Figure", 10, 45, 47}, {"Real-Time", "Figure", 11, 1, 25},
    {"Sherif", "Eq", 3, 1, 7},           {"Sherif", "Eq", 4, 1, 6},
    {"Sherif", "Eq", 6, 1, 15},          {"Sherif", "Eq", 7, 1, 3},
    {"Sherif", "Table", 7, 1, 1},        {"Sherif", "Figure", 1, 1, 7},
    {"Sherif", "Figure", 2, 1, 13},      {"Sherif", "Figure", 3, 1, 8},
    {"Sherif", "Figure", 4, 1, 8},       {"Sherif", "Figure", 5, 1, 5},
    {"Sherif", "Figure", 6, 1, 19},      {"Sherif", "Figure", 7, 1, 25},
    {"Staniszewski", "Eq", 1, 1, 7},     {"Staniszewski", "Figure", 2, 1, 6},
    {"Staniszewski", "Figure", 3, 1, 4}, {"Staniszewski", "Listing", 2, 1, 8},
    {"Staniszewski", "Listing", 3, 1, 1}};

TEST(Sources, EverythingThatTheyNumber_HasALine) {
  std::map<std::string, std::set<std::string>> numbered;
  for (const Row& row : rowsOfTheSources()) addNumbered(row.cells[Source], numbered[row.paper]);
  for (const NumberedItems& items : itemsOfTheSources)
    for (int i = items.first; i <= items.last; ++i) {
      const std::string item =
          std::string(items.kind) + " " + std::to_string(items.chapter) + "." + std::to_string(i);
      EXPECT_TRUE(numbered[items.paper].contains(item)) << items.paper << ": " << item;
    }
}

using Words = std::vector<std::string>;

Words wordsOf(const std::string& command) {
  std::istringstream in(command);
  return {std::istream_iterator<std::string>(in), {}};
}

/// The arguments of `prelight` for the commands of a row, in their order.
using Commands = std::vector<Words>;

Commands commandsIn(const std::string& text) {
  Commands commands;
  for (const std::string& command : matchesIn(text, "`prelight ([^`]+)`"))
    commands.push_back(wordsOf(command));
  return commands;
}

/// Commands of all rows that have some, without repetitions.
std::vector<Commands> commandsOfTheSources() {
  std::set<Commands> commands;
  for (const Row& row : rowsOfTheSources())
    if (Commands ofRow = commandsIn(row.cells[SeenBy]); !ofRow.empty()) commands.insert(std::move(ofRow));
  return {commands.begin(), commands.end()};
}

/// The command that makes each picture that rows compare with.
std::map<std::string, Words> madeBeforehand() {
  std::map<std::string, Words> made;
  std::istringstream document(textOf(fs::path(PRELIGHT_SOURCE_DIR) / "docs/notes/sources.md"));
  for (std::string line; std::getline(document, line) && !line.starts_with("## ");)
    if (line.starts_with("| `") && line.find(".exr`") != std::string::npos)
      made[matchesIn(line, "\\| `([^`]+)`").front()] = commandsIn(line).at(0);
  return made;
}

void setOption(Words& words, const std::string& option, const std::string& value) {
  const auto given = std::find(words.begin(), words.end(), option);
  if (given == words.end()) {
    words.insert(words.end(), {option, value});
  } else {
    *std::next(given) = value;
  }
}

/// The command with few rays, samples, photons and pixels. `baked`: its scene is the output of another
/// command.
Words quickly(Words words, bool baked) {
  const bool full = std::find(words.begin(), words.end(), "full") != words.end();
  const bool lightMap = std::find_if(words.begin(), words.end(), [](const std::string& word) {
                          return word == "--lightmap" || word == "lightmap";
                        }) != words.end();
  if (words[0] == "reference" || (words[0] == "render" && full)) setOption(words, "--spp", "1");
  if (words[0] == "reference" || words[0] == "render") setOption(words, "--size", "24");
  if (words[0] == "bake" || (words[0] == "render" && !full && !baked)) setOption(words, "--rays", "16");
  if (lightMap) setOption(words, "--texel-size", "0.5");
  if (full) setOption(words, "--photons", "1000");
  return words;
}

std::string valueOf(const Words& words, const std::string& option) {
  const auto given = std::find(words.begin(), words.end(), option);
  return given == words.end() ? "" : *std::next(given);
}

class SourcesCommand : public CliTest, public ::testing::WithParamInterface<Commands> {
 protected:
  /// CliBenchSuite runs the suites themselves, so that only the arguments are tried here.
  void expectAcceptedBenchmark(Words words) {
    EXPECT_THAT(prelightDone({"bench", "--help"}).output,
                ::testing::ContainsRegex("\n  (  )?" + words.at(1) + " "));
    setOption(words, "--plot", "no-folder/plots");
    expectFailure(failed, words, {"--plot", "no-folder"});
  }

  /// Makes a built-in scene, or a picture that rows compare with, unless it is there.
  void make(const std::string& name) {
    static const std::map<std::string, Words> made = madeBeforehand();
    if (files().contains(name)) return;
    if (const auto picture = made.find(name); picture != made.end()) {
      expectDone(picture->second);
    } else if (name.ends_with(".glb")) {
      prelightDone({"scene", name.substr(0, name.find('.')), "-o", name, "--quiet"});
    }
  }

  void expectDone(const Words& words) {
    const std::string output = valueOf(words, "-o");
    for (const std::string& word : words)
      if (word != output) make(word);
    prelightDone(quickly(words, written_.contains(words.at(1))));
    if (output.empty()) return;
    EXPECT_FALSE(readFile(output).empty());
    written_.insert(output);
  }

 private:
  std::set<std::string> written_;  ///< outputs of commands
};

TEST_P(SourcesCommand, RunsInAQuickForm) {
  for (const Words& words : GetParam()) {
    SCOPED_TRACE(::testing::PrintToString(words));
    if (words.front() == "bench") {
      expectAcceptedBenchmark(words);
    } else {
      expectDone(words);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Page, SourcesCommand, ::testing::ValuesIn(commandsOfTheSources()),
                         [](const auto& test) {
                           std::string name = std::to_string(test.index);
                           for (const std::string& word : test.param.front()) name += "_" + word;
                           std::erase_if(name, [](char c) { return std::isalnum(c) == 0 && c != '_'; });
                           return name;
                         });

}  // namespace
}  // namespace prelight::test
