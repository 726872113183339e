#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

using test::filesBelow;
using test::textOf;

constexpr std::size_t mostKernelParameters = 12;
constexpr std::size_t mostKernelLines = 60;

/// Blanks comments and preprocessor lines, so that only braces and commas of code remain. The number of lines
/// stays the same.
std::string codeOf(const std::string& text) {
  std::string code = std::regex_replace(text, std::regex("//[^\n]*"), "");
  return std::regex_replace(code, std::regex("(^|\n)[ \t]*#[^\n]*"), "$1");
}

struct DeviceFunction {
  std::string name;
  std::size_t parameters = 0;
  std::size_t lines = 0;  ///< From the line of its name to that of its closing brace.
};

std::size_t countParameters(const std::string& list) {
  if (list.find_first_not_of(" \t\n") == std::string::npos) return 0;
  return static_cast<std::size_t>(std::count(list.begin(), list.end(), ',')) + 1;
}

/// Position after the closing brace of the body whose opening brace ends at `at`.
std::size_t endOfBody(const std::string& code, std::size_t at) {
  for (int depth = 1; depth > 0 && at < code.size(); ++at) depth += (code[at] == '{') - (code[at] == '}');
  return at;
}

/// Functions that an OpenCL C text defines. Parameter lists are assumed to hold no parentheses.
std::vector<DeviceFunction> deviceFunctionsOf(const std::string& text) {
  const std::string code = codeOf(text);
  const std::regex head(R"((\w+)\s*\(([^(){};]*)\)\s*\{)");
  std::vector<DeviceFunction> functions;
  std::smatch match;
  for (auto at = code.begin(); std::regex_search(at, code.end(), match, head);) {
    const auto begin = static_cast<std::size_t>(match[0].first - code.begin());
    const std::size_t end = endOfBody(code, static_cast<std::size_t>(match[0].second - code.begin()));
    functions.push_back(
        {match[1], countParameters(match[2]),
         static_cast<std::size_t>(std::count(code.begin() + static_cast<std::ptrdiff_t>(begin),
                                             code.begin() + static_cast<std::ptrdiff_t>(end), '\n')) +
             1});
    at = code.begin() + static_cast<std::ptrdiff_t>(end);
  }
  return functions;
}

/// Kernel files of the library, of its techniques and of the laboratory.
std::vector<std::string> kernelFiles() {
  std::vector<std::string> files;
  for (const char* folder : {"kernels", "host/techniques", "benchmarks/lab/kernels"}) {
    const std::vector<std::string> found = filesBelow(folder, {".cl"});
    EXPECT_FALSE(found.empty()) << "the kernels of " << folder << " were not found";
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

TEST(OpenCl, FunctionsOfAText_AreFoundWithTheirLengths) {
  const std::vector<DeviceFunction> functions = deviceFunctionsOf(
      "#define TWICE(x) { x, x }\n"
      "float4 sum(float4 a, // the first, and {\n"
      "           float4 b) {\n"
      "  if (a.x > 0.0f) { return a; }\n"
      "  return a + b;\n"
      "}\n"
      "__kernel __attribute__((vec_type_hint(float8))) void run(__global int* out, const uint count, const "
      "uint n) { *out = 1; }\n"
      "void nothing() {}\n");
  ASSERT_EQ(functions.size(), 3u);
  EXPECT_EQ(functions[0].name, "sum");
  EXPECT_EQ(functions[0].parameters, 2u);
  EXPECT_EQ(functions[0].lines, 5u);
  EXPECT_EQ(functions[1].name, "run");
  EXPECT_EQ(functions[1].parameters, 3u);
  EXPECT_EQ(functions[1].lines, 1u);
  EXPECT_EQ(functions[2].parameters, 0u);
}

/// Arguments that belong together form a struct or a buffer: nobody reads a longer list.
TEST(OpenCl, ParametersOfKernelsAndFunctions_AreTwelveAtMost) {
  for (const std::string& file : kernelFiles())
    for (const DeviceFunction& function : deviceFunctionsOf(textOf(file)))
      EXPECT_LE(function.parameters, mostKernelParameters) << file << ": " << function.name;
}

TEST(OpenCl, KernelsAndFunctions_AreSixtyLinesLongAtMost) {
  for (const std::string& file : kernelFiles())
    for (const DeviceFunction& function : deviceFunctionsOf(textOf(file)))
      EXPECT_LE(function.lines, mostKernelLines) << file << ": " << function.name;
}

/// Only host/device uses OpenCL's types, so that kernel arguments are typed everywhere else. One test file is
/// exempt: it stands in for a broken OpenCL.
TEST(OpenCl, ItsTypesAndArguments_AreHostDevicesAlone) {
  const std::regex shown(
      R"(\bcl::|\bcl_(?:u?int|u?char|u?short|u?long|float|double|half|mem|kernel)\w*|setArg\b|[<"]CL/)");
  for (const char* top : {"host", "viewer", "benchmarks", "python", "tests"})
    for (const std::string& file : filesBelow(top, {".h", ".cpp"})) {
      if (file.rfind("host/device/", 0) == 0 || file.rfind("tests/architecture/", 0) == 0 ||
          file == "tests/device/faulty_runtime.cpp")
        continue;
      std::smatch found;
      const std::string code = std::regex_replace(textOf(file), std::regex("//[^\n]*"), "");
      EXPECT_FALSE(std::regex_search(code, found, shown)) << file << " shows " << found.str();
    }
}

/// Headers of host/device that other folders include do not show OpenCL either.
TEST(OpenCl, HeadersThatShowIt_AreIncludedByHostDeviceAlone) {
  const std::regex include(R"((?:^|\n)#include "device/opencl[^"]*")");
  for (const char* top : {"host", "viewer", "benchmarks", "python", "tests"})
    for (const std::string& file : filesBelow(top, {".h", ".cpp"})) {
      const bool mayShow = file.rfind("host/device/", 0) == 0 &&
                           (file.ends_with(".cpp") || file.rfind("host/device/opencl", 0) == 0);
      EXPECT_TRUE(mayShow || !std::regex_search(textOf(file), include)) << file;
    }
}

}  // namespace
}  // namespace prelight
