#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "encodings/registry/registry.h"

namespace prelight {
namespace {

TEST(Encodings, Names_AreFoundAndDiffer) {
  std::set<std::string_view> names;
  for (const Encoding& encoding : encodings()) {
    EXPECT_TRUE(names.insert(encoding.name).second) << encoding.name;
    ASSERT_NE(encodingNamed(encoding.name), nullptr);
    EXPECT_EQ(encodingNamed(encoding.name)->name, encoding.name);
  }
  EXPECT_EQ(encodingNamed("no such thing"), nullptr);
}

}  // namespace
}  // namespace prelight
