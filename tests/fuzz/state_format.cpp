#include "fuzz/state_format.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

#include "base/work_share.h"
#include "fit/sample_records.h"
#include "fit/vertex_fit.h"
#include "prelight/compiled_scene.h"
#include "receivers/fit_mesh.h"

namespace prelight::fuzz {

namespace {

constexpr std::uint32_t sampleCount = 5;

/// Two triangles that share an edge.
CompiledScene square() {
  CompiledScene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  scene.normals.assign(4, {0, 0, 1});
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return scene;
}

/// Progress that only carries a keeper.
class KeeperAlone final : public Progress {
 public:
  explicit KeeperAlone(WorkKeeper& keeper) : keeper_(keeper) {}
  WorkKeeper* keeper() const override { return &keeper_; }

 private:
  WorkKeeper& keeper_;
};

/// Everything that the work has computed so far.
struct Work {
  explicit Work(const FitMesh& mesh) : fit(mesh, 2) {}

  std::uint32_t round = 0;
  bool converged = false;
  std::vector<float> found;
  std::vector<double> fixed = std::vector<double>(3);
  std::vector<std::uint16_t> grown;
  SampleRecords records;
  VertexFit fit;

  template <typename State>
  void exchange(State& state) {
    state.value(round);
    state.require(round <= 2);
    state.value(converged);
    state.values(found);
    state.requireFinite(found);
    state.sameSize(fixed);
    state.elements(std::span(fixed));
    state.requireFinite(fixed);
    state.growing(grown);
  }
  void save(StateWriter& state) {
    exchange(state);
    records.save(state);
    fit.save(state);
  }
  void load(StateReader& state) {
    exchange(state);
    records.load(state);
    fit.load(state);
  }
};

void addSamples(Work& work) {
  for (std::uint32_t i = 0; i < sampleCount; ++i) {
    SampleRecord record;
    record.sample.triangle = i % 2;
    record.sample.weight = 1.0;
    record.group = i % errorGroups;
    work.records.add(record);
    work.fit.add(record.sample, std::vector<double>{1.0, 0.5 * i});
    work.grown.push_back(static_cast<std::uint16_t>(i));
  }
}

}  // namespace

StateKey fuzzedKey() { return {{"scene", 1}, {"options", 2}}; }

void doKeptWork(WorkKeeper& keeper, bool interrupt) {
  const KeeperAlone progress(keeper);
  const CompiledScene scene = square();
  const FitMesh mesh = makeFitMesh(scene);
  Work work(mesh);
  WorkPart whole(progress, "whole", keptBy(work));
  while (!whole.finished() && work.round < 2) {
    std::vector<float> inner(2);
    WorkPart part(progress, "inner", [&](auto& state) { state.sameSize(inner); });
    addSamples(work);
    part.finish(true);
    if (interrupt && work.round == 1) return keeper.save(true);
    ++work.round;
    work.found.push_back(0.25f);
    whole.advance();
  }
  (void)work.fit.solve(0.01);  // not finite for sums near the largest float: bakes are checked when written
  whole.finish(true);
}

bool doDividedWork(WorkKeeper& keeper) {
  constexpr std::uint64_t pieces = 3;
  const KeeperAlone progress(keeper);
  const FitMesh mesh = makeFitMesh(square());
  std::vector<double> sums;
  WorkPart whole(progress, "divided", [&](auto& state) { state.values(sums); });
  SharedLoop loop(whole, "pieces");
  for (std::uint64_t i = 0; i < pieces; ++i) {
    Work work(mesh);
    const bool known = loop.run(
        {i, 1}, [&] { addSamples(work); }, keptBy(work));
    if (known) sums.insert(sums.end(), work.fixed.begin(), work.fixed.end());
  }
  loop.end();
  whole.finish(true);
  return std::ranges::all_of(sums, [](double sum) { return std::isfinite(sum); });
}

namespace {

constexpr std::size_t magicBytes = 8, preambleBytes = 24, slotBytes = 40, headBytes = 32;

template <typename T>
T numberAt(std::span<const std::uint8_t> file, std::size_t at) {
  T number{};
  std::memcpy(&number, file.data() + at, sizeof number);
  return number;
}

template <typename T>
void setNumber(std::span<std::uint8_t> file, std::size_t at, T number) {
  std::memcpy(file.data() + at, &number, sizeof number);
}

std::uint64_t hashOf(std::span<const std::uint8_t> bytes) {
  return StateHash().bytes(std::as_bytes(bytes)).result();
}

/// Repairs the head of a record at `at`; returns the record's end. A length beyond the file becomes what is
/// left.
std::size_t repairRecord(std::span<std::uint8_t> file, std::size_t at) {
  constexpr std::uint32_t longestName = 4096;
  const std::size_t left = file.size() - at - headBytes;
  const std::size_t name = std::min<std::size_t>({numberAt<std::uint32_t>(file, at + 24), longestName, left});
  const std::size_t payload =
      static_cast<std::size_t>(std::min<std::uint64_t>(numberAt<std::uint64_t>(file, at + 16), left - name));
  setNumber(file, at + 24, static_cast<std::uint32_t>(name));
  setNumber(file, at + 16, std::uint64_t{payload});
  const auto nameText = file.subspan(at + headBytes, name);
  const auto bytes = file.subspan(at + headBytes + name, payload);
  setNumber(file, at, hashOf(nameText));
  setNumber(file, at + 8, std::uint64_t{XXH3_64bits(bytes.data(), bytes.size())});
  return at + headBytes + name + payload;
}

}  // namespace

std::size_t repairState(std::span<std::uint8_t> file) {
  const std::string_view begin(reinterpret_cast<const char*>(file.data()), std::min(file.size(), magicBytes));
  if (begin != "PRLSTATE" || file.size() < preambleBytes + 2 * slotBytes) return file.size();
  const auto title =
      std::min<std::size_t>(numberAt<std::uint32_t>(file, 12), file.size() - preambleBytes - 2 * slotBytes);
  setNumber(file, 12, static_cast<std::uint32_t>(title));
  setNumber(file, 16, hashOf(file.subspan(preambleBytes, title)));
  const std::size_t slot = preambleBytes + title;
  std::size_t end = slot + 2 * slotBytes;
  std::uint64_t chain = 0;
  while (file.size() - end >= headBytes) {
    const std::size_t at = end;
    end = repairRecord(file, at);
    chain = StateHash().value(chain).bytes(std::as_bytes(file.subspan(at, headBytes))).result();
  }
  const std::uint64_t sequence = std::max<std::uint64_t>(1, numberAt<std::uint64_t>(file, slot)) | 1u;
  const auto seconds = numberAt<std::uint64_t>(file, slot + 24);
  setNumber(file, slot, sequence);
  setNumber(file, slot + 8, std::uint64_t{end});
  setNumber(file, slot + 16, chain);
  setNumber(file, slot + 32,
            StateHash().value(sequence).value(std::uint64_t{end}).value(chain).value(seconds).result());
  setNumber(file, slot + slotBytes, std::uint64_t{0});  // the older commit does not count
  return end;
}

std::size_t mutateState(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind) {
  size = blind(buffer.data(), size, buffer.size());
  return seed % 4 == 0 ? size : repairState(buffer.first(size));
}

}  // namespace prelight::fuzz
