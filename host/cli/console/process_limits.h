#pragma once

namespace prelight::cli {

/// Makes writing to a full or closed destination fail with an error instead of ending the process (SIGPIPE,
/// SIGXFSZ).
void ignoreWriteSignals();

}  // namespace prelight::cli
