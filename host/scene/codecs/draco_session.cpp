#include <utility>

#include "sandbox/decoder.h"
#include "scene/codecs/draco_jobs.h"
#include "scene/codecs/draco_mesh.h"

namespace prelight {

namespace {

/// A mesh that another process has decoded and holds.
class MeshElsewhere final : public DracoMesh {
 public:
  MeshElsewhere(std::unique_ptr<DecoderSession> session, std::span<const std::uint8_t> bytes,
                std::uint64_t mostBytes, const std::string& where)
      : session_(std::move(session)), mostBytes_(mostBytes), where_(where) {
    session_->ask(
        where,
        [&](JobSocket& socket) {
          socket.put(MeshRequest::Decode);
          socket.put(mostBytes);
          socket.putText(where);
          socket.putArray(bytes);
        },
        [&](JobSocket& socket) {
          vertices_ = socket.get<std::uint64_t>();
          triangles_ = socket.get<std::uint64_t>();
        });
  }

  std::size_t vertices() const override { return vertices_; }
  std::size_t triangles() const override { return triangles_; }

  std::vector<std::uint32_t> indices() const override {
    std::vector<std::uint32_t> indices;
    session_->ask(
        where_, [&](JobSocket& socket) { socket.put(MeshRequest::Indices); },
        [&](JobSocket& socket) {
          indices = socket.getArray<std::uint32_t>(mostBytes_);
          if (indices.size() != 3 * triangles_) throw JobSocketFailure("another number of indices");
          for (const std::uint32_t index : indices)
            if (index >= vertices_) throw JobSocketFailure("an index beyond the vertices");
        });
    return indices;
  }

  std::vector<std::uint8_t> values(const DracoValues& wanted, const std::string& where) const override {
    std::vector<std::uint8_t> values;
    session_->ask(
        where,
        [&](JobSocket& socket) {
          socket.put(MeshRequest::Values);
          socket.put(wanted);
          socket.putText(where);
        },
        [&](JobSocket& socket) {
          values = socket.getArray<std::uint8_t>(mostBytes_);
          if (vertices_ == 0 || values.size() % vertices_ != 0)
            throw JobSocketFailure("another number of values");
        });
    return values;
  }

 private:
  std::unique_ptr<DecoderSession> session_;
  std::uint64_t mostBytes_;
  std::string where_;
  std::size_t vertices_ = 0, triangles_ = 0;
};

}  // namespace

std::unique_ptr<DracoMesh> decodeDraco(std::span<const std::uint8_t> bytes, std::uint64_t mostBytes,
                                       const std::string& where) {
  auto session = DecoderSession::begin(DecoderJob::Mesh);
  if (!session) return decodeDracoHere(bytes, mostBytes, where);
  return std::make_unique<MeshElsewhere>(std::move(session), bytes, mostBytes, where);
}

}  // namespace prelight
