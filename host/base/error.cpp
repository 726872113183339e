#include "prelight/error.h"

namespace prelight {

Error::Error(ExitCode code, const std::string& where, const std::string& what, const std::string& fix)
    : std::runtime_error(where + ": " + what + (fix.empty() ? "" : " (" + fix + ")")),
      code_(code),
      where_(where),
      problem_(what),
      fix_(fix) {}

}  // namespace prelight
