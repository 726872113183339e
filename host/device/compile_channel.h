#pragma once

namespace prelight {

/// Protocol between the library and the program that compiles kernels for it (host/device/compiler_main.cpp),
/// in texts (processes/channel.h):
///
///   library: index and identity of the device      compiler: "" once it has opened it, or why it cannot
///   library: options, then source                  compiler: a CompileVerdict and its text, as one text
///
/// The last line repeats until the library closes its end.

/// Result of a compilation, which determines what the text after it is.
enum class CompileVerdict : char {
  Built = 'b',    ///< the binary; empty where the device gives none
  Refused = 'r',  ///< the build log
};

}  // namespace prelight
