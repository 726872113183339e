#include "processes/channel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>

namespace prelight {

namespace {

constexpr std::uint64_t longestText = std::uint64_t{1} << 31;

/// A message of one byte with room for a descriptor.
class FileMessage {
 public:
  FileMessage() {
    header_.msg_iov = &bytes_;
    header_.msg_iovlen = 1;
    header_.msg_control = room_.data();
    header_.msg_controllen = room_.size();
  }
  FileMessage(const FileMessage&) = delete;
  FileMessage& operator=(const FileMessage&) = delete;

  msghdr& header() { return header_; }
  char& byte() { return byte_; }

  void attach(int file) {
    cmsghdr* control = CMSG_FIRSTHDR(&header_);
    control->cmsg_level = SOL_SOCKET;
    control->cmsg_type = SCM_RIGHTS;
    control->cmsg_len = CMSG_LEN(sizeof(file));
    std::memcpy(CMSG_DATA(control), &file, sizeof(file));
  }

  /// Returns the received descriptor, or -1 if there is none.
  int file() {
    int file = -1;
    const cmsghdr* control = CMSG_FIRSTHDR(&header_);
    if (control != nullptr && control->cmsg_level == SOL_SOCKET && control->cmsg_type == SCM_RIGHTS)
      std::memcpy(&file, CMSG_DATA(control), sizeof(file));
    return file;
  }

 private:
  char byte_ = 0;
  iovec bytes_{&byte_, 1};
  alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> room_{};
  msghdr header_{};
};

/// Moves the socket on standard input to another descriptor, where no library reads or writes. Returns -1 if
/// standard input is no socket.
int takeChannel() {
  int type = 0;
  socklen_t size = sizeof(type);
  if (::getsockopt(STDIN_FILENO, SOL_SOCKET, SO_TYPE, &type, &size) != 0) return -1;
  const int channel = ::fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  if (nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  return channel;
}

}  // namespace

bool sendBytes(int socket, const void* data, std::size_t bytes) {
  const auto* next = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t count = ::send(socket, next, bytes, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    next += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

bool receiveBytes(int socket, void* data, std::size_t bytes) {
  auto* next = static_cast<char*>(data);
  while (bytes > 0) {
    const ssize_t count = ::recv(socket, next, bytes, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    next += count;
    bytes -= static_cast<std::size_t>(count);
  }
  return true;
}

bool sendText(int socket, std::string_view text) {
  const std::uint64_t length = text.size();
  return sendBytes(socket, &length, sizeof(length)) && sendBytes(socket, text.data(), text.size());
}

std::optional<std::string> receiveText(int socket) {
  std::uint64_t length = 0;
  if (!receiveBytes(socket, &length, sizeof(length)) || length > longestText) return std::nullopt;
  std::string text(length, '\0');
  if (!receiveBytes(socket, text.data(), text.size())) return std::nullopt;
  return text;
}

bool sendFile(int socket, char byte, int file) {
  FileMessage message;
  message.byte() = byte;
  message.attach(file);
  ssize_t sent = 0;
  do {
    sent = ::sendmsg(socket, &message.header(), MSG_NOSIGNAL);
  } while (sent < 0 && errno == EINTR);
  return sent == 1;
}

std::optional<ReceivedFile> receiveFile(int socket) {
  FileMessage message;
  ssize_t received = 0;
  do {
    received = ::recvmsg(socket, &message.header(), MSG_CMSG_CLOEXEC);
  } while (received < 0 && errno == EINTR);
  if (received != 1) return std::nullopt;
  return ReceivedFile{message.byte(), message.file()};
}

bool awaitData(int socket, int milliseconds) {
  pollfd data{socket, POLLIN, 0};
  int ready = 0;
  do {
    ready = ::poll(&data, 1, milliseconds);
  } while (ready < 0 && errno == EINTR);
  return ready > 0;
}

int runStarted(const char* purpose, const std::function<void(int channel)>& serve) {
  const int channel = takeChannel();
  if (channel < 0) {
    std::fprintf(stderr, "%s\n", purpose);
    return 2;
  }
  try {
    serve(channel);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}

}  // namespace prelight
