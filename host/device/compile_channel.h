#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace prelight {

/// The language between the library and the program that compiles kernels for it
/// (host/device/compiler_main.cpp). Both ends send texts through a socket, each with its length before it:
///
///   library: index and identity of the device      compiler: "" once it has opened it, or why it cannot
///   library: options, then source                  compiler: a CompileVerdict and its text, as one text
///
/// The last line repeats until the library closes its end.

/// What became of a program, and what the text after it is.
enum class CompileVerdict : char {
  Built = 'b',    ///< the binary; empty where the device gives none
  Refused = 'r',  ///< the build log
};

/// False when the other end is gone.
bool sendText(int socket, std::string_view text);

/// Waits for the whole text; nothing when the other end is gone.
std::optional<std::string> receiveText(int socket);

}  // namespace prelight
