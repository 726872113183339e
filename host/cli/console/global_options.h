#pragma once

#include <optional>
#include <string>

namespace prelight::cli {

/// The options that every command takes, before or after its name.
struct GlobalOptions {
  std::optional<std::string> device;  ///< index or part of "platform name"
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  bool allowOutside = false;  ///< sets ReadOptions::allowOutside
};

}  // namespace prelight::cli
