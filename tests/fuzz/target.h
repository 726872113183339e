#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace prelight::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// Changes bytes at random without regard to their meaning. Arguments: buffer, size, capacity. Returns the
/// new size.
using BlindMutate = std::size_t (*)(std::uint8_t* data, std::size_t size, std::size_t capacity);

/// Changes an input so that its lengths and checksums stay right. Returns the new size, at most `capacity`.
using Mutate = std::size_t (*)(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed,
                               BlindMutate blind);

/// A reader of bytes that may come from anyone.
struct Target {
  std::string_view name;  ///< of its executable, its corpus and its regressions
  /// Reads the input. prelight::Error is the right answer to input that is no good; every other exception, a
  /// crash and a report of a sanitizer are findings.
  void (*read)(Bytes input) = nullptr;
  Mutate mutate = nullptr;  ///< nullptr: blind changes alone
};

/// Reads an input and takes prelight::Error as an answer. Throws std::logic_error for an error without a
/// message, and what else the target throws.
void runTarget(const Target& target, Bytes input);

/// Throws std::logic_error unless what a reader promises about accepted input holds.
void require(bool holds, const char* promise);

/// Targets, one per file of targets/.
Target baked();
Target draco();
Target exr();
Target gltf();
Target ies();
Target kernels();
Target ktx2();
Target merl();
Target meshopt();
Target options();
Target part();
Target picture();
Target sky();
Target state();
Target uri();

std::vector<Target> allTargets();

}  // namespace prelight::fuzz
