// The program prelight-decoder, which the library starts to decode pictures and meshes (sandbox/decoder.h).
// It loads a module of decoders once, and starts a process without rights for each job.
#include <unistd.h>

#include <csignal>
#include <functional>
#include <optional>

#include "decoder/jobs.h"
#include "processes/channel.h"
#include "sandbox/job_server.h"
#include "sandbox/rights.h"

namespace prelight {

namespace {

/// Does the jobs of a session.
void serve(int session, DecoderJob job) {
  JobSocket socket(session);
  const std::function<SendResult(JobSocket&)> work = workOf(job);
  giveUpRights();
  socket.put(std::uint8_t{1});
  serveJobs(socket, work);
}

/// Starts a process for each session until the library closes its end or asks for nothing.
void startSessions(int channel) {
  ::signal(SIGCHLD, SIG_IGN);  // nobody waits for them
  DecoderModules modules;
  while (awaitData(channel, patience)) {
    const std::optional<ReceivedFile> session = receiveFile(channel);
    if (!session) return;
    const auto job = static_cast<DecoderJob>(session->byte);
    modules.load(job);
    if (::fork() == 0) {
      ::close(channel);
      serve(session->file, job);
      return;
    }
    ::close(session->file);
  }
}

}  // namespace

}  // namespace prelight

int main() {
  // Skips the libraries' cleanup at exit, which would only cost time.
  _exit(prelight::runStarted(
      "prelight-decoder: Prelight's library starts this program to decode pictures and meshes",
      prelight::startSessions));
}
