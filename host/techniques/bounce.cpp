#include "techniques/bounce.h"

#include <algorithm>

namespace prelight {

Bounce::Bounce(const FitMesh& mesh, StoredTransport& transport, const SceneCast& cast)
    : mesh_(mesh), transport_(transport), cast_(cast), fronts_(transport, cast.front()) {}

void Bounce::send(const std::vector<float>& fronts, const std::vector<float>& backs) {
  const std::size_t width = transport_.partValues();
  constexpr std::size_t some = 16384;  // vertices: not all need be in memory twice
  const std::size_t vertices = mesh_.slotOfVertex.size();
  transport_.resizeTransfer(vertices * width * (backs.empty() ? 1 : 2));
  std::vector<float> rows;
  const auto upload = [&](const std::vector<float>& slots, std::size_t offset) {
    for (std::size_t first = 0; first < vertices; first += some) {
      const std::size_t count = std::min(some, vertices - first);
      rows.resize(count * width);
      for (std::size_t v = 0; v < count; ++v)
        std::copy_n(&slots[mesh_.slotOfVertex[first + v] * width], width, &rows[v * width]);
      transport_.setTransfer(rows, (offset + first) * width);
    }
  };
  upload(fronts, 0);
  if (!backs.empty()) upload(backs, vertices);
}

std::vector<float> Bounce::sent() const { return transport_.readTransfer(); }

void Bounce::sendAgain(const std::vector<float>& sent) {
  transport_.resizeTransfer(sent.size());
  transport_.setTransfer(sent);
}

std::vector<float> Bounce::receiveFronts(std::uint32_t firstValue, Progress& progress) {
  return receive(fronts_, cast_.front(), firstValue, progress);
}

std::vector<float> Bounce::receiveBacks(std::uint32_t firstValue, Progress& progress) {
  if (!backs_) backs_.emplace(transport_, *cast_.back());
  return receive(*backs_, *cast_.back(), firstValue, progress);
}

std::vector<float> Bounce::receive(const StoredRows& rows, const SideCast& side, std::uint32_t firstValue,
                                   Progress& progress) {
  return rows.fit(
      transport_.partValues(), transport_.rowsPerGather(),
      [&](std::uint32_t first, std::uint32_t count, std::vector<float>& values) {
        transport_.gather(side.storedFirst() + first, count, {firstValue, 0}, values);
      },
      progress);
}

}  // namespace prelight
