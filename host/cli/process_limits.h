#pragma once

namespace prelight::cli {

/// Lets writing to a full or closed place fail with an error instead of ending the process (SIGPIPE,
/// SIGXFSZ).
void ignoreWriteSignals();

}  // namespace prelight::cli
