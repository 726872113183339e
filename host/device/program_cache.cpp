#include "device/program_cache.h"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>
#include <cstdlib>

#include "device/cache_folder.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr const char* binaryMagic = "PRELIGHT-KERNEL-1";

/// Returns the first line of an entry, which identifies the payload.
std::string headerOf(const std::string& key, const std::string& payload) {
  return fmt::format("{} {} {} {}\n", binaryMagic, key, payload.size(), sha256(payload));
}

}  // namespace

std::string sha256(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int length = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &length, EVP_sha256(), nullptr);
  std::string hex;
  for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
  return hex;
}

fs::path ProgramCache::defaultFolder() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache != nullptr && *cache == '/')
    return fs::path(cache) / "prelight" / "kernels";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return fs::path(home) / ".cache" / "prelight" / "kernels";
  return {};
}

std::optional<std::vector<unsigned char>> ProgramCache::load(const std::string& key) const {
  if (folder_.empty() || refusalOfCache(folder_)) return std::nullopt;
  const std::optional<std::string> entry = readOwnFile(folder_ / key);
  if (!entry) return std::nullopt;
  const std::size_t end = entry->find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string payload = entry->substr(end + 1);
  if (entry->substr(0, end + 1) != headerOf(key, payload)) return std::nullopt;
  return std::vector<unsigned char>(payload.begin(), payload.end());
}

void ProgramCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
  if (folder_.empty() || !makePrivateFolders(folder_) || refusalOfCache(folder_)) return;
  const std::string payload(binary.begin(), binary.end());
  writeOwnFile(folder_ / key, headerOf(key, payload) + payload);
}

void ProgramCache::remove(const std::string& key) const {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove(folder_ / key, ignored);
}

}  // namespace prelight
