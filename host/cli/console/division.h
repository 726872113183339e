#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/work_parts.h"

namespace prelight::cli {

/// How a command divides its work among processes (docs/scaling-out.md).
struct Division {
  std::optional<SliceChoice> slice;          ///< the output is the file of a slice
  std::filesystem::path state;               ///< that the slice goes on from; empty: from the beginning
  std::vector<std::filesystem::path> parts;  ///< files of slices to take pieces from
  bool anyDevice = false;                    ///< they may be of another device
  bool listsStages = false;                  ///< nothing is written, and the stages are told
  std::vector<std::string> arguments;        ///< of the command, for the slice's file: recordedArguments()
};

}  // namespace prelight::cli
