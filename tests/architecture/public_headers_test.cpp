#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "architecture/source_files.h"

namespace prelight {
namespace {

const std::string folder = "host/include/prelight";

std::vector<std::string> publicHeaders() { return test::filesBelow(folder, {".h"}); }

/// File names after #include, with their quotes or angle brackets.
std::vector<std::string> includesOf(const std::string& text) {
  const std::regex pattern("(?:^|\n)[ \t]*#[ \t]*include[ \t]*([^\n]+)");
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Standard headers are recognised by having neither folder nor extension.
bool mayBeIncluded(const std::string& include) {
  if (std::regex_match(include, std::regex("<[a-z_]+>|<glm/[a-z_/]+\\.hpp>"))) return true;
  std::smatch own;
  return std::regex_match(include, own, std::regex("\"(prelight/[a-z_]+\\.h)\"")) &&
         std::filesystem::exists(test::sourceRoot() / "host/include" / own[1].str());
}

std::string withoutComments(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

/// Whether a text holds a name with a prefix of JSON, OpenCL or OpenGL, or of the program's private parts.
bool showsDependency(const std::string& text) {
  const std::regex shown(
      R"(\bnlohmann\b|\bjson\b|\bcl::|\bcl_[a-z]|\bCL_[A-Z]|\bgl[A-Z]\w*\(|\bGL(?:u?int|enum|float|size)|\bGL_[A-Z]|\bdevice::)");
  return std::regex_search(withoutComments(text), shown);
}

TEST(PublicHeaders, WhatTheyInclude_IsStandardGlmOrPublic) {
  const std::vector<std::string> headers = publicHeaders();
  ASSERT_GT(headers.size(), 8u) << "the headers were not found";
  for (const std::string& header : headers)
    for (const std::string& include : includesOf(test::textOf(header)))
      EXPECT_TRUE(mayBeIncluded(include)) << header << " includes " << include;
}

TEST(PublicHeaders, TheirCode_NamesNoDependencyButGlm) {
  for (const std::string& header : publicHeaders())
    EXPECT_FALSE(showsDependency(test::textOf(header))) << header;
}

TEST(PublicHeaders, UmbrellaHeader_IncludesAllOthers) {
  const std::vector<std::string> includes = includesOf(test::textOf(folder + "/prelight.h"));
  const std::set<std::string> named(includes.begin(), includes.end());
  for (const std::string& header : publicHeaders()) {
    const std::string name = header.substr(header.rfind('/') + 1);
    if (name == "prelight.h") continue;
    EXPECT_EQ(named.count("\"prelight/" + name + "\""), 1u) << name << " is missing";
  }
}

/// The two searches find what they look for.
TEST(PublicHeaders, WhatMayNotBeThere_IsFound) {
  EXPECT_EQ(includesOf("#pragma once\n#include <vector>\n  # include \"a/b.h\"\n").size(), 2u);
  EXPECT_TRUE(mayBeIncluded("<vector>"));
  EXPECT_TRUE(mayBeIncluded("<glm/gtc/quaternion.hpp>"));
  EXPECT_TRUE(mayBeIncluded("\"prelight/error.h\""));
  EXPECT_FALSE(mayBeIncluded("\"prelight/none.h\""));
  EXPECT_FALSE(mayBeIncluded("\"base/parallel.h\""));
  EXPECT_FALSE(mayBeIncluded("<nlohmann/json.hpp>"));
  EXPECT_FALSE(mayBeIncluded("<CL/opencl.hpp>"));
  EXPECT_FALSE(mayBeIncluded("<unistd.h>"));
  EXPECT_TRUE(showsDependency("nlohmann::ordered_json json;"));
  EXPECT_TRUE(showsDependency("cl::Context context;"));
  EXPECT_TRUE(showsDependency("GLuint texture;"));
  EXPECT_TRUE(showsDependency("std::vector<device::Photon> photons;"));
  EXPECT_FALSE(showsDependency("GltfScene load();  // as cl::Context would"));
}

}  // namespace
}  // namespace prelight
