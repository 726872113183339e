#pragma once

#include <functional>

#include "sandbox/job_socket.h"

namespace prelight {

/// Sends the result of a job.
using SendResult = std::function<void(JobSocket&)>;

/// Answers jobs until the other end is closed: `work` receives one, does it and returns how its result is
/// sent. What it throws is the answer instead.
void serveJobs(JobSocket& socket, const std::function<SendResult(JobSocket&)>& work);

}  // namespace prelight
