#include "device/kernel_source.h"

#include <gtest/gtest.h>

#include "prelight/error.h"

namespace prelight {
namespace {

TEST(KernelSource, Include_IsReplacedAndLinesAreMarked) {
  const std::map<std::string, std::string> sources{{"a.cl", "int x;\n#include \"dir/b.h\"\nint z;\n"},
                                                   {"dir/b.h", "int y;\n"}};
  EXPECT_EQ(expandKernelSource("a.cl", sources),
            "#line 1 \"a.cl\"\nint x;\n#line 1 \"dir/b.h\"\nint y;\n#line 3 \"a.cl\"\nint z;\n");
}

TEST(KernelSource, MissingInclude_IsNamedWithItsPlace) {
  const std::map<std::string, std::string> sources{{"a.cl", "\n#include \"gone.h\"\n"}};
  try {
    expandKernelSource("a.cl", sources);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("a.cl:2"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("gone.h"), std::string::npos) << error.what();
  }
}

TEST(KernelSource, CircularInclude_IsRefused) {
  const std::map<std::string, std::string> sources{{"a.cl", "#include \"b.cl\"\n"},
                                                   {"b.cl", "#include \"a.cl\"\n"}};
  EXPECT_THROW(expandKernelSource("a.cl", sources), Error);
}

TEST(KernelSource, LogThatKnowsNoFiles_NamesThem) {
  const std::map<std::string, std::string> sources{{"a.cl", "int x;\n#include \"dir/b.h\"\nint z;\n"},
                                                   {"dir/b.h", "int y;\nint w;\n"}};
  const std::string expanded = expandKernelSource("a.cl", sources);
  EXPECT_EQ(nameSourceFiles("<kernel>:2:5: error: x\n<kernel>:5:1: w\n<kernel>:7: z\n", expanded),
            "a.cl:1:5: error: x\ndir/b.h:2:1: w\na.cl:3: z\n");
  EXPECT_EQ(nameSourceFiles("a.cl:1: x\n<kernel>:99: ?", expanded), "a.cl:1: x\n<kernel>:99: ?");
}

TEST(KernelSource, EmbeddedKernels_AllResolve) {
  EXPECT_GE(kernelSources().size(), 10u);
  for (const auto& [name, text] : kernelSources()) {
    EXPECT_FALSE(text.empty()) << name;
    EXPECT_NO_THROW(expandKernelSource(name, kernelSources())) << name;
  }
}

}  // namespace
}  // namespace prelight
