#include "fuzz/target.h"

#include <stdexcept>

#include "prelight/error.h"

namespace prelight::fuzz {

void runTarget(const Target& target, Bytes input) {
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
