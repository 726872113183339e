#include "projectors/slot_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "projectors/bounce.h"

namespace prelight {

namespace {

constexpr double nothingLeft = 1e-6;  // of transfer, whose open value is about 1

/// [slot][3][column], the transfer that leaves direct occlusion for the first bounce. SH is the same in every
/// channel.
std::vector<float> directTransfers(const SideCast& cast, const std::vector<float>& fitted, std::size_t slots,
                                   const SlotTransfer& shape) {
  const std::size_t n = shape.shColumns(), columns = shape.columns();
  const std::vector<float> lights = shape.groups > 0 ? cast.solveLights() : std::vector<float>{};
  std::vector<float> transfer(slots * 3 * columns);
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      float* out = &transfer[(s * 3 + c) * columns];
      for (std::size_t i = 0; i < n; ++i) out[i] = directTransfer(cast, fitted, s, i);
      for (std::size_t g = 0; g < shape.groups; ++g) out[n + g] = lights[(s * 3 + c) * shape.groups + g];
    }
  return transfer;
}

/// Direct transfer of the backs; 0 where none was cast.
std::vector<float> backTransfer(const SceneCast& cast, const FitMesh& mesh, const SlotTransfer& shape) {
  std::vector<float> transfer = directTransfers(*cast.back(), cast.back()->solve(), mesh.slotCount(), shape);
  std::vector<std::uint8_t> covered(mesh.slotCount(), 0);
  for (std::size_t t = 0; t < cast.backSeen().size(); ++t)
    for (const std::uint32_t slot : mesh.triangles[t]) covered[slot] |= cast.backSeen()[t];
  const std::size_t row = transfer.size() / mesh.slotCount();
  for (std::size_t slot = 0; slot < covered.size(); ++slot)
    if (!covered[slot]) std::fill_n(transfer.begin() + static_cast<std::ptrdiff_t>(slot * row), row, 0.0f);
  return transfer;
}

double addTo(std::vector<float>& total, const std::vector<float>& more) {
  double most = 0.0;
  for (std::size_t i = 0; i < total.size(); ++i) {
    total[i] += more[i];
    most = std::max(most, double(std::abs(more[i])));
  }
  return most;
}

}  // namespace

SlotTransfer makeTransfer(const FitMesh& mesh, Caster& caster, const SceneCast& cast,
                          const std::vector<float>& fitted, int order, int bounces, Progress& progress,
                          std::vector<std::string>& notes) {
  SlotTransfer transfer{order, caster.groupCount(), {}, {}, {}, bounces};
  transfer.total = directTransfers(cast.front(), fitted, mesh.slotCount(), transfer);
  if (bounces == 0) return transfer;
  std::vector<float> backs;
  if (cast.back() != nullptr) backs = backTransfer(cast, mesh, transfer);
  transfer.backReflected.assign(backs.size(), 0.0f);
  const std::size_t columns = 3 * transfer.columns();
  for (int b = 0; b < bounces; ++b) {
    sendTransfer(mesh, caster, b == 0 ? transfer.total : transfer.last, backs);
    addTo(transfer.backReflected, backs);
    transfer.last = receiveTransfer(caster, cast.front(), columns, progress);
    if (cast.back() != nullptr && b + 1 < bounces)
      backs = receiveTransfer(caster, *cast.back(), columns, progress);
    const double most = addTo(transfer.total, transfer.last);
    progress.report("bounce", double(b + 1) / bounces);
    if (most < nothingLeft && b + 1 < bounces) {
      notes.push_back(fmt::format("bounces after {}: skipped, nothing is left to reflect", b + 1));
      break;
    }
  }
  return transfer;
}

std::vector<float> reflectedTransfer(const SlotTransfer& transfer) {
  std::vector<float> reflected = transfer.total;
  for (std::size_t i = 0; i < transfer.last.size(); ++i) reflected[i] -= transfer.last[i];
  return reflected;
}

std::vector<float> sentTransfer(const FitMesh& mesh, const SlotTransfer& surface, std::size_t columns) {
  std::vector<float> sent;
  const auto add = [&](const std::vector<float>& slots) {
    for (const std::uint32_t slot : mesh.slotOfVertex)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < columns; ++i)
          sent.push_back(slots[(slot * 3 + c) * surface.columns() + i]);
  };
  add(reflectedTransfer(surface));
  if (!surface.backReflected.empty()) add(surface.backReflected);
  return sent;
}

}  // namespace prelight
