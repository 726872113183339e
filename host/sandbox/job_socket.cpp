#include "sandbox/job_socket.h"

#include <unistd.h>

#include <algorithm>

#include "processes/channel.h"

namespace prelight {

namespace {

constexpr std::uint64_t mostCharacters = 1 << 16;  ///< and the longest message

}  // namespace

JobSocket::~JobSocket() { ::close(socket_); }

void JobSocket::putText(std::string_view text) {
  putArray(std::span(text.data(), std::min<std::size_t>(text.size(), mostCharacters)));
}

std::string JobSocket::getText() {
  const std::vector<char> text = getArray<char>(mostCharacters);
  return {text.begin(), text.end()};
}

void JobSocket::send(const void* data, std::size_t bytes) {
  if (!sendBytes(socket_, data, bytes)) throw JobSocketFailure("the other end is closed");
}

void JobSocket::receive(void* data, std::size_t bytes) {
  if (!receiveBytes(socket_, data, bytes)) throw JobSocketFailure("the other end is closed");
}

std::uint64_t JobSocket::count(std::uint64_t most) {
  const auto sent = get<std::uint64_t>();
  if (sent > most) throw JobSocketFailure("more values than there can be");
  return sent;
}

}  // namespace prelight
