#include "decoder/jobs.h"

#include <array>
#include <memory>
#include <optional>
#include <utility>

#include "images/exr.h"
#include "images/image_library.h"
#include "images/picture_jobs.h"
#include "images/plain_png.h"
#include "prelight/error.h"
#include "scene/codecs/draco_jobs.h"
#include "scene/codecs/draco_mesh.h"

namespace prelight {

namespace {

/// Returns the function that sends a result.
template <typename Result>
SendResult sending(Result result) {
  return [result = std::move(result)](JobSocket& socket) { putResult(socket, result); };
}

SendResult doPictureJob(JobSocket& socket, DecoderJob job) {
  const PictureRequest request = getPictureRequest(socket);
  switch (job) {
    case DecoderJob::PlainPng:
      return sending(decodePlainPng(request.bytes));
    case DecoderJob::PlainExr:
      return sending(decodePlainExr(request.bytes));
    case DecoderJob::Pixels:
      return sending(imageLibrary().decodePixels(request.bytes, request.format, request.where));
    case DecoderJob::Layers:
      return sending(imageLibrary().decodeLayers(request.bytes, request.where));
    default:
      return sending(imageLibrary().decodeImage(request.bytes, request.format, request.where));
  }
}

/// Decodes a mesh and tells its parts.
class MeshWork {
 public:
  SendResult operator()(JobSocket& socket) {
    switch (socket.get<MeshRequest>()) {
      case MeshRequest::Indices:
        return [indices = mesh().indices()](JobSocket& to) { to.putArray(std::span(indices)); };
      case MeshRequest::Values:
        return values(socket);
      default:
        return decode(socket);
    }
  }

 private:
  const DracoMesh& mesh() const {
    if (!mesh_) throw JobSocketFailure("no mesh yet");
    return *mesh_;
  }

  SendResult decode(JobSocket& socket) {
    const auto mostBytes = socket.get<std::uint64_t>();
    const std::string where = socket.getText();
    const std::vector<std::uint8_t> bytes = socket.getArray<std::uint8_t>(mostEncodedBytes);
    mesh_ = decodeDracoHere(bytes, mostBytes, where);
    return [vertices = std::uint64_t{mesh_->vertices()},
            triangles = std::uint64_t{mesh_->triangles()}](JobSocket& to) {
      to.put(vertices);
      to.put(triangles);
    };
  }

  SendResult values(JobSocket& socket) {
    const auto wanted = socket.get<DracoValues>();
    const std::string where = socket.getText();
    return [values = mesh().values(wanted, where)](JobSocket& to) { to.putArray(std::span(values)); };
  }

  std::shared_ptr<DracoMesh> mesh_;
};

/// Four bytes that are no picture: refusing them, OpenImageIO loads all that it looks for in files.
constexpr std::array<std::uint8_t, 4> noPicture{};

void loadDecoders(DecoderJob job) {
  switch (job) {
    case DecoderJob::PlainPng:
      decodePlainPng({});
      return;
    case DecoderJob::PlainExr:
      return;
    case DecoderJob::Mesh:
      decodeDracoHere({}, 0, "");
      return;
    default:
      imageLibrary().useOneThread();
      imageLibrary().decodeImage(noPicture, PictureFormat::Jpeg, "");
  }
}

}  // namespace

void DecoderModules::load(DecoderJob job) {
  if (!loaded_.insert(job).second) return;
  try {
    loadDecoders(job);
  } catch (const Error&) {
    // These are no data; where a module is missing the job will tell.
  }
}

std::function<SendResult(JobSocket&)> workOf(DecoderJob job) {
  if (job == DecoderJob::Mesh) return MeshWork();
  return [job](JobSocket& socket) { return doPictureJob(socket, job); };
}

}  // namespace prelight
