// Parts of divided work: the file of a slice, and the work that takes pieces from it.
#include <filesystem>
#include <string>

#include "base/work_parts.h"
#include "fuzz/scratch_file.h"
#include "fuzz/state_format.h"
#include "fuzz/target.h"

namespace prelight::fuzz {

namespace {

/// Three of four inputs get right lengths and hashes, so that what follows these is read.
std::size_t mutatePart(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind) {
  size = blind(buffer.data(), size, buffer.size());
  return seed % 4 == 0 ? size : repairState(buffer.first(size));
}

void readPart(Bytes input) {
  const ScratchFile file("1.part", input);
  const PartTitle title = readPartTitle(file.path());
  require(title.slice.index >= 1 && title.slice.index <= title.slice.count, "slices are counted from 1");
  const ScratchFile state("out.glb.state", {});
  std::filesystem::remove(state.path());
  WorkKeeper keeper(StateLog(state.path(), fuzzedKind, fuzzedKey()), 1e9);
  GivenParts parts({file.path()}, fuzzedKind, fuzzedKey(), false);
  keeper.divide(&parts);
  try {
    require(doDividedWork(keeper), "what parts give is finite");
  } catch (const StageEnd&) {
    // Other parts are asked for.
  }
}

}  // namespace

Target part() { return {"part", readPart, mutatePart}; }

}  // namespace prelight::fuzz
