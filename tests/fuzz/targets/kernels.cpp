// Entries of the cache of compiled kernels. Its payload is the device driver's, which reads it.
#include <sys/stat.h>

#include <string>

#include "device/program_cache.h"
#include "fuzz/scratch_file.h"
#include "fuzz/target.h"

namespace prelight::fuzz {

namespace {

constexpr const char* entryKey = "0000000000000000000000000000000000000000000000000000000000000000";
constexpr mode_t ownerFile = 0600;

/// The first line of an entry names the payload's length and hash (host/device/program_cache.cpp). Every
/// second input gets a right one, so that what follows is read.
std::size_t mutateEntry(std::span<std::uint8_t> buffer, std::size_t size, unsigned seed, BlindMutate blind) {
  size = blind(buffer.data(), size, buffer.size());
  if (seed % 2 == 0) return size;
  const std::string payload(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
  const std::string begin = payload.substr(payload.find('\n') + 1);  // all of it where no line ends
  const std::string entry = std::string("PRELIGHT-KERNEL-1 ") + entryKey + ' ' +
                            std::to_string(begin.size()) + ' ' + sha256(begin) + '\n' + begin;
  if (entry.size() > buffer.size()) return size;
  std::copy(entry.begin(), entry.end(), buffer.begin());
  return entry.size();
}

void readEntry(Bytes input) {
  const ScratchFile file(entryKey, input);
  ::chmod(file.path().c_str(), ownerFile);
  const auto payload = ProgramCache(file.path().parent_path()).load(entryKey);
  require(!payload || payload->size() < input.size(), "payloads are parts of their entries");
}

}  // namespace

Target kernels() { return {"kernels", readEntry, mutateEntry}; }

}  // namespace prelight::fuzz
