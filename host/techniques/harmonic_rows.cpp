#include "techniques/harmonic_rows.h"

#include "basis/ch.h"

namespace prelight {

HarmonicTransfer shTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values) {
  const int order = context.request.sh.order;
  const auto n = static_cast<std::size_t>(order * order);
  return {order, transfer.channels(), transfer.bounces,
          packRows(context.mesh, values, context.scene, transfer.channels(), n,
                   [&](const float* row, float* out) {
                     for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(row[i], 0.0f);
                   }),
          false};
}

HarmonicTransfer chTransfer(const BakeContext& context, const SlotTransfer& transfer,
                            const SlotValues& values) {
  const ChRequest& request = context.request.ch;
  const auto n = static_cast<std::size_t>(request.order * request.order);
  const ch::Basis basis(request.order);
  std::vector<double> sh(n), coefficients(n);
  const auto write = [&](const float* row, float* out) {
    sh.assign(row, row + n);
    request.naive ? basis.momentsFromSh(sh, coefficients) : basis.fromSh(sh, coefficients);
    for (std::size_t i = 0; i < n; ++i) out[i] = finiteOr(coefficients[i], 0.0f);
  };
  return {request.order, transfer.channels(), transfer.bounces,
          packRows(context.mesh, values, context.scene, transfer.channels(), n, write), request.naive};
}

}  // namespace prelight
