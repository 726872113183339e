#include "sandbox/job_server.h"

#include <exception>
#include <new>

#include "prelight/error.h"
#include "sandbox/job_verdict.h"

namespace prelight {

namespace {

void putError(JobSocket& socket, const Error& error) {
  socket.put(JobVerdict::Failed);
  socket.put(error.code());
  for (const std::string& part : {error.where(), error.problem(), error.fix()}) socket.putText(part);
}

void answerOne(JobSocket& socket, const std::function<SendResult(JobSocket&)>& work) {
  try {
    const SendResult send = work(socket);
    socket.put(JobVerdict::Done);
    send(socket);
  } catch (const JobSocketFailure&) {
    throw;
  } catch (const std::bad_alloc&) {
    socket.put(JobVerdict::OutOfMemory);
  } catch (const Error& error) {
    putError(socket, error);
  } catch (const std::exception& error) {
    putError(socket, InputError("data", std::string("cannot be decoded: ") + error.what()));
  }
}

}  // namespace

void serveJobs(JobSocket& socket, const std::function<SendResult(JobSocket&)>& work) {
  try {
    for (;;) answerOne(socket, work);
  } catch (const JobSocketFailure&) {
    // The library has what it wanted.
  }
}

}  // namespace prelight
