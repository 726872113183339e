#include "device/layout.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <regex>
#include <set>

#include "device/kernel_source.h"
#include "prelight/device.h"
#include "support/devices.h"

namespace prelight {
namespace {

/// The first capture group of every match, in order.
std::vector<std::string> matches(const std::string& text, const std::regex& pattern) {
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at)
    found.push_back((*at)[1]);
  return found;
}

/// Names of the structs that kernels/shared defines.
std::set<std::string> sharedStructs() {
  const std::regex definition(R"((?:^|\n)(?:typedef )?struct (\w+)\s*\{)");
  std::set<std::string> names;
  for (const auto& [file, text] : kernelSources())
    if (file.starts_with("shared/"))
      for (const std::string& name : matches(text, definition)) names.insert(name);
  return names;
}

std::vector<std::string> hostNames() {
  std::vector<std::string> names;
  for (const StructLayout& layout : hostLayouts()) names.push_back(layout.name);
  return names;
}

TEST(Layouts, EveryStructOfKernelsShared_IsCompared) {
  const auto structs = sharedStructs();
  ASSERT_THAT(structs, testing::IsSupersetOf({"Ray", "OccluderLight", "LightLayout"}));
  EXPECT_THAT(hostNames(), testing::UnorderedElementsAreArray(structs));
}

TEST(Layouts, ProbeKernel_AsksForTheStructsInTheHostsOrder) {
  const std::string& probe = kernelSources().at("core/layout_probe_kernels.cl");
  EXPECT_EQ(matches(probe, std::regex(R"(PROBE\(\d+, (\w+),)")), hostNames());
}

TEST(Layouts, Device_AgreesWithTheHost) {
  const auto host = hostLayouts(), device = deviceLayouts(test::sharedDevice().context());
  ASSERT_EQ(host.size(), device.size());
  for (std::size_t i = 0; i < host.size(); ++i) {
    EXPECT_EQ(host[i].size, device[i].size) << host[i].name;
    EXPECT_EQ(host[i].offset, device[i].offset) << host[i].name;
  }
}

}  // namespace
}  // namespace prelight
