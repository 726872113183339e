#pragma once

namespace prelight {

/// First byte of a decoding process's answer.
enum class JobVerdict : char {
  Done = 'd',         ///< followed by the result
  Failed = 'f',       ///< followed by an Error: code, place, problem, fix
  OutOfMemory = 'm',  ///< followed by nothing
};

}  // namespace prelight
