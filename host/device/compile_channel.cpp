#include "device/compile_channel.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace prelight {

namespace {

constexpr std::uint64_t longestText = std::uint64_t{1} << 31;

bool sendAll(int socket, const char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t count = ::send(socket, data, bytes, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

bool receiveAll(int socket, char* data, std::size_t bytes) {
  while (bytes > 0) {
    const ssize_t count = ::recv(socket, data, bytes, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace

bool sendText(int socket, std::string_view text) {
  const std::uint64_t length = text.size();
  return sendAll(socket, reinterpret_cast<const char*>(&length), sizeof(length)) &&
         sendAll(socket, text.data(), text.size());
}

std::optional<std::string> receiveText(int socket) {
  std::uint64_t length = 0;
  if (!receiveAll(socket, reinterpret_cast<char*>(&length), sizeof(length)) || length > longestText)
    return std::nullopt;
  std::string text(length, '\0');
  if (!receiveAll(socket, text.data(), text.size())) return std::nullopt;
  return text;
}

}  // namespace prelight
