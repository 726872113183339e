#include "cli/cli_test.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include <fstream>
#include <sstream>

namespace prelight::test {

void CliTest::SetUp() {
  std::string pattern = (std::filesystem::temp_directory_path() / "prelight-cli-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
}

void CliTest::TearDown() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

ProcessResult CliTest::prelight(const std::vector<std::string>& arguments, ProcessOptions options) const {
  std::vector<std::string> command = {PRELIGHT_PROGRAM};
  command.insert(command.end(), arguments.begin(), arguments.end());
  if (options.directory.empty()) options.directory = folder_;
  return runProcess(command, options);
}

ProcessResult CliTest::prelightDone(const std::vector<std::string>& arguments, ProcessOptions options) const {
  ProcessResult result = prelight(arguments, std::move(options));
  EXPECT_EQ(result.exitCode, 0) << ::testing::PrintToString(arguments) << "\n" << result.errors;
  return result;
}

void CliTest::expectFailure(int exitCode, const std::vector<std::string>& arguments,
                            const std::vector<std::string>& parts, ProcessOptions options) const {
  SCOPED_TRACE(::testing::PrintToString(arguments));
  const std::set<std::string> before = files();
  const ProcessResult result = prelight(arguments, std::move(options));
  EXPECT_EQ(result.exitCode, exitCode) << result.errors;
  EXPECT_THAT(result.errors, ::testing::HasSubstr("error: "));
  for (const std::string& part : parts) EXPECT_THAT(result.errors, ::testing::HasSubstr(part));
  EXPECT_EQ(files(), before);
}

void CliTest::writeFile(const std::string& name, const std::string& bytes) const {
  std::ofstream file(path(name), std::ios::binary);
  file << bytes;
  ASSERT_TRUE(file.good());
}

std::string CliTest::readFile(const std::string& name) const {
  std::ifstream file(path(name), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::set<std::string> CliTest::files() const {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    names.insert(std::filesystem::relative(entry.path(), folder_).string());
  return names;
}

}  // namespace prelight::test
