#include "fuzz/target.h"

#include <cstdlib>
#include <stdexcept>

#include "prelight/error.h"

namespace prelight::fuzz {

void runTarget(const Target& target, Bytes input) {
  // Decoders run in this process, where the fuzzer and its sanitizers see them.
  static const int decodeHere = ::setenv("PRELIGHT_SANDBOX", "0", 0);
  require(decodeHere == 0, "the environment takes a variable");
  try {
    target.read(input);
  } catch (const Error& error) {
    require(!error.where().empty() && !error.problem().empty(), "an error says where and what");
  }
}

void require(bool holds, const char* promise) {
  if (!holds) throw std::logic_error(promise);
}

}  // namespace prelight::fuzz
