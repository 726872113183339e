#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

constexpr int mostLines = 60;
constexpr int mostParameters = 12;

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t indentOf(const std::string& line) { return line.find_first_not_of(' '); }

/// A function as clang-format lays it out: its head, joined to one line, and the lines of its body.
struct Function {
  std::string head;
  int line = 0;  ///< Line of its opening brace, counted from 1.
  int length = 0;
};

/// Joins the lines of one declaration that ends with line `last`. Sets `indent` to that of the declaration's
/// first line.
std::string headEndingAt(const std::vector<std::string>& lines, std::size_t last, std::size_t& indent) {
  indent = indentOf(lines[last]);
  std::string head = lines[last].substr(indent);
  for (std::size_t i = last; i-- > 0;) {
    const std::string& before = lines[i];
    const std::size_t start = indentOf(before);
    if (start == std::string::npos || std::string(";}{:").find(before.back()) != std::string::npos) break;
    if (before.compare(start, 2, "//") == 0 || before[start] == '#') break;
    indent = start;
    head = before.substr(start) + " " + head;
  }
  return head;
}

/// Whether `head` begins a function rather than a statement, a type, a lambda or a list.
bool isFunction(const std::string& head) {
  static const std::regex other(
      "^(if|for|while|switch|else|do|try|catch|return|case|class|struct|namespace|enum|union)\\b.*|^\\}.*|"
      "^template <[^(]*> (class|struct) .*|^[^(]*=.*|.*\\[[^\\]]*\\]\\(.*");
  return head.find('(') != std::string::npos && !std::regex_match(head, other);
}

/// Functions at the outermost level and in classes.
std::vector<Function> functionsOf(const std::vector<std::string>& lines) {
  std::vector<Function> functions;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].empty() || lines[i].back() != '{') continue;
    std::size_t indent = 0;
    const std::string head = headEndingAt(lines, i, indent);
    if (!isFunction(head) || indent > 4) continue;
    std::size_t end = i + 1;
    while (end < lines.size() &&
           (lines[end].empty() || indentOf(lines[end]) > indent || lines[end][indent] != '}'))
      ++end;
    functions.push_back({head, static_cast<int>(i + 1), static_cast<int>(end - i)});
  }
  return functions;
}

/// Number of parameters: the commas at the first level of the first pair of brackets, plus one.
int parametersOf(const std::string& head) {
  int depth = 0, angles = 0, parameters = 0;
  for (std::size_t i = head.find('('); i < head.size(); ++i) {
    const char c = head[i];
    if (c == '(' || c == '{' || c == '[') ++depth;
    if (c == ')' || c == '}' || c == ']') --depth;
    if (c == '<') ++angles;
    if (c == '>') --angles;
    if (depth == 0) break;
    if (depth == 1 && angles == 0 && c != ' ' && parameters == 0 && c != '(') parameters = 1;
    if (depth == 1 && angles == 0 && c == ',') ++parameters;
  }
  return parameters;
}

TEST(Functions, SearchFindsBodiesAndParameters) {
  const std::vector<std::string> lines = linesOf(
      "int small(int a, std::map<int, int> b) {\n  return a;\n}\n\nclass A {\n  void f(\n      int a) {\n\n  "
      "  "
      "g();\n  }\n};\n");
  const std::vector<Function> functions = functionsOf(lines);
  ASSERT_EQ(functions.size(), 2u);
  EXPECT_EQ(functions[0].length, 2);
  EXPECT_EQ(parametersOf(functions[0].head), 2);
  EXPECT_EQ(functions[1].length, 3);
  EXPECT_EQ(parametersOf(functions[1].head), 1);
}

TEST(Functions, OfHostViewerBenchmarksAndPython_AreShort) {
  int seen = 0;
  for (const char* top : {"host", "viewer", "benchmarks", "python"}) {
    for (const std::string& file : test::filesBelow(top, {".h", ".cpp"})) {
      for (const Function& function : functionsOf(linesOf(test::textOf(file)))) {
        ++seen;
        EXPECT_LE(function.length, mostLines) << file << ":" << function.line << " " << function.head;
        EXPECT_LE(parametersOf(function.head), mostParameters)
            << file << ":" << function.line << " " << function.head;
      }
    }
  }
  EXPECT_GT(seen, 2000) << "the sources were not found";
}

}  // namespace
}  // namespace prelight
