#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>

namespace prelight {

/// Options of an OpenCL build, separated by spaces.
class BuildOptions {
 public:
  BuildOptions& define(std::string_view name) { return add(fmt::format("-D{}=1", name)); }
  BuildOptions& define(std::string_view name, int value) { return add(fmt::format("-D{}={}", name, value)); }
  BuildOptions& defineIf(bool condition, std::string_view name) { return condition ? define(name) : *this; }

  const std::string& text() const { return text_; }

 private:
  BuildOptions& add(const std::string& option) {
    if (!text_.empty()) text_ += ' ';
    text_ += option;
    return *this;
  }

  std::string text_ = "-cl-std=CL1.2";
};

}  // namespace prelight
