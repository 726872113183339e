#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace prelight {

/// Most bytes of a file that a decoding process takes.
constexpr std::uint64_t mostEncodedBytes = std::uint64_t{1} << 36;

/// The other end of a JobSocket is closed, or has sent what cannot be meant.
class JobSocketFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One end of a socket between the library and a process that decodes for it. Values arrive in the order in
/// which they were sent. Neither end trusts the other: whoever receives states how much at most. All
/// functions throw JobSocketFailure.
class JobSocket {
 public:
  /// Takes a socket, which is closed in the end.
  explicit JobSocket(int socket) : socket_(socket) {}
  ~JobSocket();
  JobSocket(const JobSocket&) = delete;
  JobSocket& operator=(const JobSocket&) = delete;

  template <typename T>
  requires std::is_trivially_copyable_v<T>
  void put(const T& value) { send(&value, sizeof(T)); }
  template <typename T>
  requires std::is_trivially_copyable_v<T> T get() {
    T value{};
    receive(&value, sizeof(T));
    return value;
  }

  template <typename T>
  void putArray(std::span<const T> values) {
    put(std::uint64_t{values.size()});
    send(values.data(), values.size_bytes());
  }
  /// Receives at most `most` values.
  template <typename T>
  std::vector<T> getArray(std::uint64_t most) {
    std::vector<T> values(count(most));
    receive(values.data(), values.size() * sizeof(T));
    return values;
  }

  void putText(std::string_view text);
  std::string getText();

 private:
  void send(const void* data, std::size_t bytes);
  void receive(void* data, std::size_t bytes);
  std::uint64_t count(std::uint64_t most);

  int socket_;
};

}  // namespace prelight
