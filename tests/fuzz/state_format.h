#pragma once

#include <cstdint>
#include <vector>

#include "base/kept_work.h"
#include "base/state_file.h"
#include "fuzz/target.h"

namespace prelight::fuzz {

/// Returns the key of the target's states.
StateKey fuzzedKey();
constexpr const char* fuzzedKind = "bake";

/// Work whose state has values of every kind that states have: numbers, truths, arrays of fixed, stored and
/// growing length, arrays that must be finite, records of samples and sums of a fit, in nested parts of two
/// steps. With a state it continues. `interrupt` ends it in the middle, as an interrupted run does.
void doKeptWork(WorkKeeper& keeper, bool interrupt);

/// Work whose loop processes divide (WorkShare) and whose pieces have values of every kind. Returns whether
/// its results are finite. Throws StageEnd where pieces are missing.
bool doDividedWork(WorkKeeper& keeper);

/// Sets lengths, hashes and the record of the last commit so that a changed state gets past the checks of its
/// file. Returns the size; other files than states stay as they are.
std::size_t repairState(std::span<std::uint8_t> file);

/// A Mutate for files of that format. Three of four inputs get right lengths and hashes, so that what follows
/// these is read.
std::size_t mutateState(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind);

}  // namespace prelight::fuzz
