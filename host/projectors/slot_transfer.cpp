#include "projectors/slot_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "projectors/bounce.h"

namespace prelight {

namespace {

constexpr double nothingLeft = 1e-6;  // of transfer, whose open value is about 1
constexpr std::size_t slotRange = 4096;

/// What one side of the surface receives without diffuse bounces.
class DirectTransfer {
 public:
  DirectTransfer(const SideCast& cast, const std::vector<float>& fitted, const SlotTransfer& shape)
      : cast_(cast),
        fitted_(fitted),
        bands_(shape.shColumns()),
        groups_(shape.groups),
        lights_(shape.groups > 0 ? cast.solveLights() : std::vector<float>{}),
        specular_(shape.specular && bands_ > 0 ? cast.solveSpecular() : std::vector<float>{}) {}

  /// Value `value` of a slot's [3][column]: SH, then the groups of lights. What comes straight is the same in
  /// every channel of SH.
  float value(std::size_t slot, std::size_t value) const {
    const std::size_t channel = value / (bands_ + groups_), column = value % (bands_ + groups_);
    if (column >= bands_) return lights_[(slot * 3 + channel) * groups_ + column - bands_];
    const float straight = directTransfer(cast_, fitted_, slot, column);
    return specular_.empty() ? straight : straight + specular_[(slot * 3 + channel) * bands_ + column];
  }

 private:
  const SideCast& cast_;
  const std::vector<float>& fitted_;
  std::size_t bands_, groups_;
  std::vector<float> lights_;    ///< [slot][3][group]
  std::vector<float> specular_;  ///< [slot][3][i], from the sky by mirrors and glass; empty: none
};

/// [slot], 1 where a back is seen.
std::vector<std::uint8_t> slotsWithBack(const SceneCast& cast, const FitMesh& mesh) {
  std::vector<std::uint8_t> covered(mesh.slotCount(), 0);
  for (std::size_t t = 0; t < cast.backSeen().size(); ++t)
    for (const std::uint32_t slot : mesh.triangles[t]) covered[slot] |= cast.backSeen()[t];
  return covered;
}

/// What the backs receive without diffuse bounces, where any is seen.
class BackTransfer {
 public:
  BackTransfer(const SideCast& back, const SceneCast& cast, const FitMesh& mesh, const SlotTransfer& shape)
      : fitted_(back.fit().solve(defaultSmoothing)),
        direct_(back, fitted_, shape),
        covered_(slotsWithBack(cast, mesh)) {}

  float value(std::size_t slot, std::size_t value) const {
    return covered_[slot] != 0 ? direct_.value(slot, value) : 0.0f;
  }

 private:
  std::vector<float> fitted_;
  DirectTransfer direct_;
  std::vector<std::uint8_t> covered_;  ///< [slot], as slotsWithBack()
};

double largest(const std::vector<float>& values) {
  double most = 0.0;
  for (const float value : values) most = std::max(most, double(std::abs(value)));
  return most;
}

/// Adds bounces to transfer that holds what is direct, a part of the values after the other: a value's
/// bounces depend on no other value.
class TransferBounces {
 public:
  /// `backs` as the cast has them; nullptr: none.
  TransferBounces(const FitMesh& mesh, Caster& caster, const SceneCast& cast, const BackTransfer* backs,
                  const TransferRequest& request, SlotTransfer& transfer)
      : request_(request),
        transfer_(transfer),
        slots_(mesh.slotCount()),
        partValues_(caster.partValues()),
        bounce_(mesh, caster, cast),
        backs_(backs) {
    if (!request.reflected) return;
    transfer.reflected.assign(transfer.total.size(), 0.0f);
    if (backs_ != nullptr) transfer.backReflected.assign(transfer.total.size(), 0.0f);
  }

  /// Returns the bounces that were needed.
  int run(Progress& progress) {
    const std::size_t values = 3 * transfer_.columns();
    int needed = 0;
    for (std::size_t first = 0; first < values; first += partValues_) {
      needed = std::max(needed, runPart(first, progress));
      progress.report("bounce", double(std::min(values, first + partValues_)) / double(values));
    }
    return needed;
  }

 private:
  int runPart(std::size_t first, Progress& progress) {
    std::vector<float> fronts(slots_ * partValues_, 0.0f), backs;
    forValues(first, [&](std::size_t slot, std::size_t place, std::size_t value) {
      fronts[place] = transfer_.total[placeOf(slot, value)];
    });
    if (backs_ != nullptr) backs = directBacks(first);
    for (int b = 0; b < request_.bounces; ++b) {
      bounce_.send(fronts, backs);
      if (request_.reflected) keep(first, fronts, backs);
      fronts = std::vector<float>();  // the device has them
      backs = std::vector<float>();
      fronts = bounce_.receiveFronts(static_cast<std::uint32_t>(first), progress);
      if (backs_ != nullptr && (request_.through || b + 1 < request_.bounces))
        backs = bounce_.receiveBacks(static_cast<std::uint32_t>(first), progress);
      add(first, fronts, transfer_.total);
      if (request_.through && !backs.empty()) add(first, backs, transfer_.through);
      if (largest(fronts) < nothingLeft && largest(backs) < nothingLeft) return b + 1;
    }
    return request_.bounces;
  }

  std::vector<float> directBacks(std::size_t first) const {
    std::vector<float> backs(slots_ * partValues_, 0.0f);
    forValues(first, [&](std::size_t slot, std::size_t place, std::size_t value) {
      backs[place] = backs_->value(slot, value);
    });
    return backs;
  }

  void keep(std::size_t first, const std::vector<float>& fronts, const std::vector<float>& backs) {
    add(first, fronts, transfer_.reflected);
    if (backs_ != nullptr) add(first, backs, transfer_.backReflected);
  }

  void add(std::size_t first, const std::vector<float>& part, std::vector<float>& sum) const {
    forValues(first, [&](std::size_t slot, std::size_t place, std::size_t value) {
      sum[placeOf(slot, value)] += part[place];
    });
  }

  /// Calls use(slot, place in [slot][partValues_], value of [3][column]) for the values of a part.
  template <typename Use>
  void forValues(std::size_t first, const Use& use) const {
    const std::size_t count = std::min(partValues_, 3 * transfer_.columns() - first);
    parallelRanges(slots_, slotRange, [&](std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot)
        for (std::size_t i = 0; i < count; ++i) use(slot, slot * partValues_ + i, first + i);
    });
  }

  std::size_t placeOf(std::size_t slot, std::size_t value) const {
    return slot * 3 * transfer_.columns() + value;
  }

  const TransferRequest& request_;
  SlotTransfer& transfer_;
  std::size_t slots_;
  std::size_t partValues_;
  Bounce bounce_;
  const BackTransfer* backs_;
};

/// [slot][3][column] of what `direct` says of each value.
template <typename Direct>
std::vector<float> directValues(std::size_t slots, std::size_t values, const Direct& direct) {
  std::vector<float> filled(slots * values);
  parallelRanges(slots, slotRange, [&](std::size_t begin, std::size_t end) {
    for (std::size_t slot = begin; slot < end; ++slot)
      for (std::size_t i = 0; i < values; ++i) filled[slot * values + i] = direct.value(slot, i);
  });
  return filled;
}

}  // namespace

SlotTransfer makeTransfer(const FitMesh& mesh, Caster& caster, const SceneCast& cast,
                          const std::vector<float>& fitted, const TransferRequest& request,
                          Progress& progress, std::vector<std::string>& notes) {
  SlotTransfer transfer;
  transfer.order = request.order;
  transfer.groups = caster.groupCount();
  transfer.bounces = request.bounces;
  transfer.specular = request.specular;
  const std::size_t values = 3 * transfer.columns();
  transfer.total = directValues(mesh.slotCount(), values, DirectTransfer(cast.front(), fitted, transfer));
  std::optional<BackTransfer> backs;
  if (cast.back() != nullptr && (request.bounces > 0 || request.through))
    backs.emplace(*cast.back(), cast, mesh, transfer);
  if (request.through && backs) transfer.through = directValues(mesh.slotCount(), values, *backs);
  if (request.bounces == 0) return transfer;
  const int needed =
      TransferBounces(mesh, caster, cast, backs ? &*backs : nullptr, request, transfer).run(progress);
  if (needed < request.bounces)
    notes.push_back(fmt::format("bounces after {}: skipped, nothing is left to reflect", needed));
  return transfer;
}

std::vector<float> sentTransfer(const FitMesh& mesh, const SlotTransfer& surface, std::size_t bands,
                                std::size_t groups) {
  std::vector<float> sent;
  const auto add = [&](const std::vector<float>& slots) {
    for (const std::uint32_t slot : mesh.slotOfVertex)
      for (std::size_t c = 0; c < 3; ++c) {
        const auto row = slots.begin() + static_cast<std::ptrdiff_t>((slot * 3 + c) * surface.columns());
        const auto lights = row + static_cast<std::ptrdiff_t>(surface.shColumns());
        sent.insert(sent.end(), row, row + static_cast<std::ptrdiff_t>(bands));
        sent.insert(sent.end(), lights, lights + static_cast<std::ptrdiff_t>(groups));
      }
  };
  add(surface.reflected);
  if (!surface.backReflected.empty()) add(surface.backReflected);
  return sent;
}

}  // namespace prelight
