#include "techniques/slot_transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/kept_work.h"
#include "base/parallel.h"
#include "techniques/bounce.h"

namespace prelight {

namespace {

constexpr double nothingLeft = 1e-6;  // of transfer, whose open value is about 1
constexpr std::size_t slotRange = 4096;

/// What one side of the surface receives without diffuse bounces.
class DirectTransfer {
 public:
  DirectTransfer(const SideSums& sums, const Baseline& baseline, const DirectColumns& columns,
                 const std::vector<float>& fitted, const SlotTransfer& shape, const Progress& progress)
      : baseline_(baseline),
        fitted_(fitted),
        bands_(shape.shColumns()),
        groups_(shape.groups),
        lights_(columns.lights != nullptr ? solved(*columns.lights, sums, progress) : std::vector<float>{}),
        specular_(shape.specular && bands_ > 0 && columns.specular != nullptr
                      ? solved(*columns.specular, sums, progress)
                      : std::vector<float>{}) {}

  /// Value `value` of a slot's [3][column]: SH, then the groups of lights. What comes straight is the same in
  /// every channel of SH.
  float value(std::size_t slot, std::size_t value) const {
    const std::size_t channel = value / (bands_ + groups_), column = value % (bands_ + groups_);
    if (column >= bands_) return lights_[(slot * 3 + channel) * groups_ + column - bands_];
    const float straight = directTransfer(baseline_, fitted_, slot, column);
    return specular_.empty() ? straight : straight + specular_[(slot * 3 + channel) * bands_ + column];
  }

 private:
  static std::vector<float> solved(const FittedColumn& column, const SideSums& sums,
                                   const Progress& progress) {
    return column.fitOn(sums).solve(defaultSmoothing, {.progress = &progress});
  }

  const Baseline& baseline_;
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
  BackTransfer(const SideSums& back, const SceneCast& cast, const DirectColumns& columns, const FitMesh& mesh,
               const SlotTransfer& shape, const Progress& progress)
      : fitted_(back.fit().solve(defaultSmoothing, {.progress = &progress})),
        direct_(back, columns.hemisphere.baselineOf(Side::Back), columns, fitted_, shape, progress),
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
  TransferBounces(const FitMesh& mesh, StoredTransport& transport, const SceneCast& cast,
                  const BackTransfer* backs, const TransferRequest& request, SlotTransfer& transfer)
      : request_(request),
        transfer_(transfer),
        slots_(mesh.slotCount()),
        partValues_(transport.partValues()),
        bounce_(mesh, transport, cast),
        backs_(backs) {
    if (!request.reflected) return;
    transfer.reflected.assign(transfer.total.size(), 0.0f);
    if (backs_ != nullptr) transfer.backReflected.assign(transfer.total.size(), 0.0f);
  }

  /// Returns the bounces that were needed.
  int run(Progress& progress) {
    const std::size_t values = 3 * transfer_.columns();
    WorkPart part(progress, "bounces", [this](auto& state) { this->exchange(state); });
    while (at_.first < values) {
      if (at_.sent)
        receive(progress);
      else
        send();
      part.advance();
      if (at_.bounce == 0 && !at_.sent)
        progress.report("bounce", double(std::min(values, at_.first)) / double(values));
    }
    part.finish();
    return at_.needed;
  }

 private:
  /// Where the bounces stand.
  struct Course {
    std::uint64_t first = 0;  ///< of the part's values
    int bounce = 0;
    int needed = 0;     ///< bounces of the parts before, at most
    bool sent = false;  ///< the device has what is sent
  };

  /// Parts that are done do not change. Nobody asks whether to stop while there is something to be sent: what
  /// that is need not be kept.
  template <typename State>
  void exchange(State& state) {
    state.value(at_.first);
    state.value(at_.bounce);
    state.value(at_.needed);
    state.value(at_.sent);
    const std::size_t values = 3 * transfer_.columns();
    state.require(at_.first % partValues_ == 0 && at_.first < values + partValues_ && at_.bounce >= 0 &&
                  at_.bounce < request_.bounces && at_.needed >= 0 && at_.needed <= request_.bounces &&
                  at_.sent == (at_.first < values));
    exchangeDone(state);
    if (at_.sent) exchangeCurrent(state);
  }

  void exchangeDone(StateWriter& state) const {
    std::vector<float> blocks;
    state.growing(0, at_.first / partValues_, blockSize() * sizeof(float),
                  [&](std::uint64_t part, std::uint64_t count) {
                    blocks.clear();
                    for (const std::uint64_t end = part + count; part < end; ++part) {
                      const std::vector<float> block = blockAt(part * partValues_);
                      blocks.insert(blocks.end(), block.begin(), block.end());
                    }
                    return std::as_bytes(std::span(blocks));
                  });
  }

  void exchangeDone(StateReader& state) {
    std::vector<float> block(blockSize());
    state.growing(at_.first / partValues_, blockSize() * sizeof(float),
                  [&](std::uint64_t part, std::span<const std::byte> blocks) {
                    const std::size_t bytes = blockSize() * sizeof(float);
                    for (; !blocks.empty(); blocks = blocks.subspan(bytes), ++part) {
                      std::memcpy(block.data(), blocks.data(), bytes);
                      state.requireFinite(block);
                      setBlock(part * partValues_, block);
                    }
                  });
  }

  void exchangeCurrent(StateWriter& state) const {
    state.values(blockAt(at_.first));
    state.values(bounce_.sent());
  }

  void exchangeCurrent(StateReader& state) {
    std::vector<float> block(blockSize()), sent;
    state.sameSize(block);
    state.requireFinite(block);
    setBlock(at_.first, block);
    state.values(sent);
    state.require(sent.size() == bounce_.sentValues(backs_ != nullptr));
    state.requireFinite(sent);
    bounce_.sendAgain(sent);
  }

  /// What bounces change.
  std::vector<std::vector<float>*> sums() const {
    std::vector<std::vector<float>*> all{&transfer_.total};
    for (std::vector<float>* sum : {&transfer_.reflected, &transfer_.backReflected, &transfer_.through})
      if (!sum->empty()) all.push_back(sum);
    return all;
  }

  std::size_t blockSize() const { return sums().size() * slots_ * partValues_; }

  /// A part's values of all sums, [sum][slot][partValues_].
  std::vector<float> blockAt(std::size_t first) const {
    std::vector<float> block(blockSize(), 0.0f);
    const auto all = sums();
    for (std::size_t i = 0; i < all.size(); ++i)
      forValues(first, [&](std::size_t slot, std::size_t place, std::size_t value) {
        block[i * slots_ * partValues_ + place] = (*all[i])[placeOf(slot, value)];
      });
    return block;
  }

  void setBlock(std::size_t first, const std::vector<float>& block) {
    const auto all = sums();
    for (std::size_t i = 0; i < all.size(); ++i)
      forValues(first, [&](std::size_t slot, std::size_t place, std::size_t value) {
        (*all[i])[placeOf(slot, value)] = block[i * slots_ * partValues_ + place];
      });
  }

  void send() {
    if (at_.bounce == 0) {
      fronts_.assign(slots_ * partValues_, 0.0f);
      forValues(at_.first, [&](std::size_t slot, std::size_t place, std::size_t value) {
        fronts_[place] = transfer_.total[placeOf(slot, value)];
      });
      if (backs_ != nullptr) sentBacks_ = directBacks(at_.first);
    }
    bounce_.send(fronts_, sentBacks_);
    if (request_.reflected) keep(at_.first, fronts_, sentBacks_);
    fronts_ = std::vector<float>();  // the device has them
    sentBacks_ = std::vector<float>();
    at_.sent = true;
  }

  void receive(Progress& progress) {
    const auto first = static_cast<std::uint32_t>(at_.first);
    std::vector<float> fronts = bounce_.receiveFronts(first, progress), backs;
    if (backs_ != nullptr && (request_.through || at_.bounce + 1 < request_.bounces))
      backs = bounce_.receiveBacks(first, progress);
    add(first, fronts, transfer_.total);
    if (request_.through && !backs.empty()) add(first, backs, transfer_.through);
    at_.sent = false;
    ++at_.bounce;
    const bool left = largest(fronts) >= nothingLeft || largest(backs) >= nothingLeft;
    if (left && at_.bounce < request_.bounces) {
      fronts_ = std::move(fronts);
      sentBacks_ = std::move(backs);
      return;
    }
    at_.needed = std::max(at_.needed, at_.bounce);
    at_.bounce = 0;
    at_.first += partValues_;
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
  Course at_;
  std::vector<float> fronts_, sentBacks_;  ///< [slot][partValues_], to be sent
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

SlotTransfer makeTransfer(const FitMesh& mesh, const SceneCast& cast, const DirectColumns& direct,
                          StoredTransport* transport, const std::vector<float>& fitted,
                          const TransferRequest& request, Progress& progress,
                          std::vector<std::string>& notes) {
  SlotTransfer transfer;
  transfer.order = request.order;
  transfer.groups = direct.lights != nullptr ? direct.lights->groups() : 0;
  transfer.bounces = request.bounces;
  transfer.specular = request.specular;
  const std::size_t values = 3 * transfer.columns();
  transfer.total = directValues(mesh.slotCount(), values,
                                DirectTransfer(cast.front().sums(), direct.hemisphere.baselineOf(Side::Front),
                                               direct, fitted, transfer, progress));
  std::optional<BackTransfer> backs;
  if (cast.back() != nullptr && (request.bounces > 0 || request.through))
    backs.emplace(cast.back()->sums(), cast, direct, mesh, transfer, progress);
  if (request.through && backs) transfer.through = directValues(mesh.slotCount(), values, *backs);
  if (request.bounces == 0) return transfer;
  const int needed =
      TransferBounces(mesh, *transport, cast, backs ? &*backs : nullptr, request, transfer).run(progress);
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
