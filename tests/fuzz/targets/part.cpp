// Parts of divided work: the file of a slice, and the work that takes pieces from it.
#include "base/work_parts.h"
#include "fuzz/scratch_file.h"
#include "fuzz/state_format.h"
#include "fuzz/target.h"

namespace prelight::fuzz {

namespace {

void readPart(Bytes input) {
  const ScratchFile file("1.part", input);
  const PartTitle title = readPartTitle(file.path());
  require(title.slice.index >= 1 && title.slice.index <= title.slice.count, "slices are counted from 1");
  const ScratchFolder folder;
  WorkKeeper keeper(StateLog(folder / "out.glb.state", fuzzedKind, fuzzedKey()), 1e9);
  GivenParts parts({file.path()}, fuzzedKind, fuzzedKey(), false);
  keeper.divide(&parts);
  try {
    require(doDividedWork(keeper), "what parts give is finite");
  } catch (const StageEnd&) {
    // Other parts are asked for.
  }
}

}  // namespace

Target part() { return {"part", readPart, mutateState}; }

}  // namespace prelight::fuzz
