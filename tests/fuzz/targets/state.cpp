// States of interrupted runs: the file, and the work that goes on from what it holds.
#include "base/kept_work.h"
#include "base/state_log.h"
#include "fuzz/scratch_file.h"
#include "fuzz/state_format.h"
#include "fuzz/target.h"

namespace prelight::fuzz {

namespace {

void readAll(const StateLog& log) {
  for (const std::string& name : log.names()) (void)log.read(name);
  for (const StateLog::ArrayShape& array : log.arrays()) {
    std::uint64_t count = 0;
    require(log.readArray(array.name, array.count, array.elementSize,
                          [&](std::uint64_t first, std::span<const std::byte> elements) {
                            require(first == count, "arrays come in order");
                            count += elements.size() / array.elementSize;
                          }),
            "arrays have the shape that the state tells");
    require(count == array.count, "arrays come whole");
  }
}

void readState(Bytes input) {
  const ScratchFile file("out.glb.state", input);
  std::optional<StateLog> log = StateLog::open(file.path(), fuzzedKind, fuzzedKey());
  if (!log) return;
  readAll(*log);
  WorkKeeper keeper(std::move(*log), 0.0);
  doKeptWork(keeper, false);
}

}  // namespace

Target state() { return {"state", readState, mutateState}; }

}  // namespace prelight::fuzz
