#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace prelight {

/// Texts and bytes through a socket between the library and a program that it has started
/// (processes/child_process.h).

/// Sends bytes. Returns false when the other end is closed.
bool sendBytes(int socket, const void* data, std::size_t bytes);

/// Waits for as many bytes. Returns false when the other end is closed.
bool receiveBytes(int socket, void* data, std::size_t bytes);

/// Sends a text, preceded by its length. Returns false when the other end is closed.
bool sendText(int socket, std::string_view text);

/// Waits for a whole text. Returns nothing when the other end is closed.
std::optional<std::string> receiveText(int socket);

/// Sends one byte and, with it, an open file. Returns false when the other end is closed.
bool sendFile(int socket, char byte, int file);

/// A byte and the file that came with it, which the receiver closes.
struct ReceivedFile {
  char byte = 0;
  int file = -1;
};

/// Waits for what sendFile() sends. Returns nothing when the other end is closed.
std::optional<ReceivedFile> receiveFile(int socket);

/// Waits for data or the other end's closing. Returns false when neither comes within `milliseconds`.
bool awaitData(int socket, int milliseconds);

/// How long a started program waits for work before it ends and so releases its memory, in ms.
constexpr int patience = 2000;

/// Runs a program that the library starts: `serve` talks through the socket that was the standard input.
/// Returns the exit code: 0, 1 with a message after an exception, or 2 with `purpose` if standard input is no
/// socket.
int runStarted(const char* purpose, const std::function<void(int channel)>& serve);

}  // namespace prelight
