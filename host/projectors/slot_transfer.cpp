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
std::vector<float> directTransfer(const SideCast& cast, const std::vector<float>& fitted, std::size_t slots,
                                   const SlotTransfer& shape) {
  const std::size_t fittedColumns = cast.baseline().columns(), n = shape.shColumns(),
                    columns = shape.columns();
  const std::vector<float> lights = shape.groups > 0 ? cast.solveLights() : std::vector<float>{};
  std::vector<float> transfer(slots * 3 * columns);
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t c = 0; c < 3; ++c) {
      float* out = &transfer[(s * 3 + c) * columns];
      for (std::size_t i = 0; i < n; ++i)
        out[i] = static_cast<float>(cast.baseline().row(s)[1 + i] + fitted[s * fittedColumns + 1 + i]);
      for (std::size_t g = 0; g < shape.groups; ++g) out[n + g] = lights[(s * 3 + c) * shape.groups + g];
    }
  return transfer;
}

/// Direct transfer of the backs; 0 where none was cast.
std::vector<float> backTransfer(const SceneCast& cast, const FitMesh& mesh, const SlotTransfer& shape) {
  std::vector<float> transfer = directTransfer(*cast.back(), cast.back()->solve(), mesh.slotCount(), shape);
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

SlotTransfer makeTransfer(const CompiledScene& scene, const FitMesh& mesh, Caster& caster,
                          const SceneCast& cast, const std::vector<float>& fitted, int order, int bounces,
                          Progress& progress, std::vector<std::string>& notes) {
  SlotTransfer transfer{order, caster.groupCount(), {}, {}, {}, {}, bounces};
  transfer.direct = directTransfer(cast.front(), fitted, mesh.slotCount(), transfer);
  transfer.total = transfer.direct;
  if (bounces == 0) return transfer;
  BounceSide front{&cast.front(), transfer.direct}, back;
  if (cast.back() != nullptr) {
    back = {cast.back(), backTransfer(cast, mesh, transfer)};
    transfer.backReflected.assign(back.transfer.size(), 0.0f);
  }
  for (int b = 0; b < bounces; ++b) {
    transfer.reflected = transfer.total;
    if (back.cast != nullptr) addTo(transfer.backReflected, back.transfer);
    bounceOnce(scene, mesh, caster, transfer.columns(), front, back.cast != nullptr ? &back : nullptr,
               progress);
    const double most = addTo(transfer.total, front.transfer);
    progress.report("bounce", double(b + 1) / bounces);
    if (most < nothingLeft && b + 1 < bounces) {
      notes.push_back(fmt::format("bounces after {}: skipped, nothing is left to reflect", b + 1));
      break;
    }
  }
  return transfer;
}

std::vector<float> sentTransfer(const FitMesh& mesh, const SlotTransfer& surface, std::size_t columns) {
  std::vector<float> sent;
  const auto add = [&](const std::vector<float>& slots) {
    for (const std::uint32_t slot : mesh.slotOfVertex)
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < columns; ++i)
          sent.push_back(slots[(slot * 3 + c) * surface.columns() + i]);
  };
  add(surface.reflected);
  if (!surface.backReflected.empty()) add(surface.backReflected);
  return sent;
}

}  // namespace prelight
