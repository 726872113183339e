#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace prelight::test {

inline bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

}  // namespace prelight::test

/// Skips the test if a program that it runs is not installed.
#define SKIP_WITHOUT(program) \
  if (!prelight::test::isInstalled(program)) GTEST_SKIP() << program << " is not installed"
