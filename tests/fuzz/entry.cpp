// Entry points that libFuzzer calls; PRELIGHT_FUZZ_TARGET is the function that returns the target.
#include <cstddef>
#include <cstdint>

#include "fuzz/target.h"

extern "C" {

std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t capacity);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const prelight::fuzz::Target target = prelight::fuzz::PRELIGHT_FUZZ_TARGET();
  prelight::fuzz::runTarget(target, {data, size});
  return 0;
}

std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t capacity,
                                    unsigned int seed) {
  static const prelight::fuzz::Target target = prelight::fuzz::PRELIGHT_FUZZ_TARGET();
  if (target.mutate == nullptr) return LLVMFuzzerMutate(data, size, capacity);
  return target.mutate({data, capacity}, size, seed, LLVMFuzzerMutate);
}

}  // extern "C"
