#pragma once

#include <functional>
#include <memory>
#include <string>

#include "sandbox/job_socket.h"

namespace prelight {

/// The work of a decoding process. Its requests and results are those of images/picture_jobs.h, and for
/// meshes of scene/codecs/draco_jobs.h.
enum class DecoderJob : char {
  PlainPng = 'n',  ///< decodePlainPng(), by libpng
  PlainExr = 'e',  ///< decodePlainExr(), by libOpenEXR
  Pixels = 'p',    ///< these three by OpenImageIO and libavif: ImageLibrary::decodePixels(),
  Layers = 'l',    ///< ImageLibrary::decodeLayers(),
  Image = 'i',     ///< ImageLibrary::decodeImage()
  Mesh = 'm',      ///< decodeDraco(), by libdraco
};

/// A process that decodes data which nobody vouches for, one picture or mesh. It has given up the rights to
/// open files, start programs and reach the network (sandbox/rights.h), so that a decoder which the data take
/// over harms nothing, and one that crashes ends nothing else.
class DecoderSession {
 public:
  /// Returns nullptr where PRELIGHT_SANDBOX is 0 or no such process can be started: the caller decodes
  /// itself.
  static std::unique_ptr<DecoderSession> begin(DecoderJob job);

  explicit DecoderSession(int socket) : socket_(socket) {}

  /// Sends a request by `put`, receives whether it was done, and the result by `get`. Throws the Error that
  /// the decoder met, std::bad_alloc, or InputError about `where` when the process ended without an answer.
  void ask(const std::string& where, const std::function<void(JobSocket&)>& put,
           const std::function<void(JobSocket&)>& get);

 private:
  JobSocket socket_;
};

}  // namespace prelight
