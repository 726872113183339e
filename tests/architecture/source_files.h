#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace prelight::test {

inline std::filesystem::path sourceRoot() { return PRELIGHT_SOURCE_DIR; }

/// Files with one of the extensions below a folder, as sorted paths from the root.
inline std::vector<std::string> filesBelow(const std::string& folder,
                                           const std::vector<std::string>& extensions) {
  std::vector<std::string> files;
  const std::filesystem::path root = sourceRoot();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
    if (std::count(extensions.begin(), extensions.end(), entry.path().extension().string()) > 0)
      files.push_back(std::filesystem::relative(entry.path(), root).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

/// Contents of a file whose path is given from the root.
inline std::string textOf(const std::string& file) {
  std::ifstream in(sourceRoot() / file);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace prelight::test
