#pragma once

#include <functional>
#include <set>

#include "sandbox/decoder.h"
#include "sandbox/job_server.h"

namespace prelight {

/// The decoders that this process has loaded.
class DecoderModules {
 public:
  /// Loads what a job's decoders need from files. Failures show when the job is done.
  void load(DecoderJob job);

 private:
  std::set<DecoderJob> loaded_;
};

/// Returns the function that receives a request of a session and does it in this process.
std::function<SendResult(JobSocket&)> workOf(DecoderJob job);

}  // namespace prelight
