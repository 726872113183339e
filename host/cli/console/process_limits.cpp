#include "cli/console/process_limits.h"

#include <signal.h>  // NOLINT(modernize-deprecated-headers): <csignal> lacks the POSIX part

namespace prelight::cli {

void ignoreWriteSignals() {
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
}

}  // namespace prelight::cli
