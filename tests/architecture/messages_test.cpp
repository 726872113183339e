#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

/// String literals in a text that name a command-line option.
std::vector<std::string> optionsNamedIn(const std::string& text) {
  const std::string code = std::regex_replace(text, std::regex("(^|\n)[ \t]*//[^\n]*|  ///?[^\n]*"), "$1");
  const std::regex literal(R"("(?:[^"\\\n]|\\.)*")"), option("(^|[^-!<])--[a-z]");
  std::vector<std::string> found;
  for (std::sregex_iterator at(code.begin(), code.end(), literal), end; at != end; ++at)
    if (std::regex_search(at->str(), option)) found.push_back(at->str());
  return found;
}

/// Fields of requests and options ("BakeRequest::seed") that string literals in a text name.
std::set<std::string> fieldsNamedIn(const std::string& text) {
  const std::regex literal(R"("(?:[^"\\\n]|\\.)*")");
  const std::regex field(R"(\b(?:[A-Z]\w*(?:Request|Options|Kind)|Effort)::\w+)");
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), literal), end; at != end; ++at) {
    const std::string quoted = at->str();
    for (std::sregex_iterator name(quoted.begin(), quoted.end(), field); name != end; ++name)
      found.insert(name->str());
  }
  return found;
}

/// A text without the fields that rows of the tables of options (prelight/options.h) set.
std::string withoutRows(const std::string& text) {
  return std::regex_replace(text, std::regex(R"rx(\.field = "\w+::\w+")rx"), "");
}

/// Fields for which rows of the tables of options (prelight/options.h) name an option.
std::set<std::string> fieldsWithOptionsIn(const std::string& text) {
  const std::regex row(R"rx(\.field = "(\w+::\w+)",\s*\.name)rx");
  std::set<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), row), end; at != end; ++at) found.insert((*at)[1]);
  return found;
}

bool isOfTheProgram(const std::string& file) { return file.starts_with("host/cli/"); }

/// Callers of the library know no options. host/cli/options/option_names.cpp replaces field names in messages
/// by the options that set them.
TEST(Messages, OfTheLibrary_NameNoOptions) {
  std::size_t files = 0;
  for (const std::string& file : test::filesBelow("host", {".h", ".cpp"})) {
    if (isOfTheProgram(file)) continue;
    ++files;
    for (const std::string& literal : optionsNamedIn(test::textOf(file)))
      ADD_FAILURE() << file << " names an option: " << literal;
  }
  EXPECT_GT(files, 300u) << "the sources were not found";
}

/// host/library and its RelighterOptions are left out because the program does not use them.
TEST(Messages, FieldsThatTheyName_HaveOptions) {
  std::set<std::string> named, rows;
  for (const std::string& file : test::filesBelow("host", {".h", ".cpp"})) {
    const std::string text = test::textOf(file);
    rows.merge(fieldsWithOptionsIn(text));
    if (!isOfTheProgram(file) && !file.starts_with("host/library/") && !file.ends_with("_options.cpp"))
      named.merge(fieldsNamedIn(withoutRows(text)));
  }
  std::erase_if(named, [](const std::string& name) { return name.starts_with("RelighterOptions::"); });
  EXPECT_GT(rows.size(), 60u) << "the rows were not found";
  EXPECT_GT(named.size(), 15u) << "the names were not found";
  for (const std::string& name : named) EXPECT_TRUE(rows.count(name) > 0) << name << " has no option";
}

TEST(Messages, FieldInALiteral_IsFound) {
  EXPECT_EQ(
      fieldsNamedIn("fail(\"raise BakeRequest::maxMemory or Effort::rays\"); HaarRequest::size;").size(), 2u);
}

TEST(Messages, OptionInALiteral_IsFound) {
  EXPECT_EQ(optionsNamedIn("throw UsageError(\"--volume\", \"raise --max-memory\");").size(), 2u);
  EXPECT_EQ(optionsNamedIn("  note(\"a \\\" --quoted\");\n").size(), 1u);
  EXPECT_EQ(optionsNamedIn("/// \"--volume\" of the program\nint i = 0;\n").size(), 0u);
  EXPECT_EQ(optionsNamedIn("--i; print(\"one -- two\"); --j;").size(), 0u);
}

}  // namespace
}  // namespace prelight
