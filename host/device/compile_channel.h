#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace prelight {

/// Protocol between the library and the program that compiles kernels for it (host/device/compiler_main.cpp).
/// Both ends send texts through a socket, each preceded by its length:
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

/// Sends a text. Returns false when the other end is closed.
bool sendText(int socket, std::string_view text);

/// Waits for a whole text. Returns nothing when the other end is closed.
std::optional<std::string> receiveText(int socket);

}  // namespace prelight
