#include "base/temporary_name.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <system_error>

#include "base/state_file.h"

namespace prelight {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view prefix = ".prelight-";

/// Returns when a process began, in ticks since the machine's start; 0 if there is none or it is unknown.
std::uint64_t startOf(std::uint64_t process) {
  std::ifstream file(fmt::format("/proc/{}/stat", process));
  std::string text{std::istreambuf_iterator<char>(file), {}};
  // The name, in brackets, may contain anything.
  const std::size_t name = text.rfind(')');
  if (name == std::string::npos) return 0;
  constexpr int fieldsBetween = 20;
  std::size_t at = name;
  for (int i = 0; i < fieldsBetween && at != std::string::npos; ++i) at = text.find(' ', at + 1);
  if (at == std::string::npos) return 0;
  std::uint64_t start = 0;
  std::from_chars(text.data() + at + 1, text.data() + text.size(), start);
  return start;
}

/// Returns a name that distinguishes machines, their starts, and containers, which cannot see each other's
/// processes.
std::string placeOfProcesses() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  const std::string boot{std::istreambuf_iterator<char>(file), {}};
  std::error_code ignored;
  const fs::path names = fs::read_symlink("/proc/self/ns/pid", ignored);
  return fmt::format("{:08x}", StateHash().text(boot).text(names.string()).result() & 0xffffffffu);
}

/// The parts of a temporary name after the prefix: PLACE-PROCESS-START-NUMBER.
struct Maker {
  std::string_view place;
  std::uint64_t process = 0;
  std::uint64_t start = 0;
};

std::optional<Maker> makerOf(std::string_view name) {
  if (!name.starts_with(prefix)) return std::nullopt;
  name.remove_prefix(prefix.size());
  Maker maker;
  maker.place = name.substr(0, name.find('-'));
  name.remove_prefix(std::min(name.size(), maker.place.size() + 1));
  for (std::uint64_t* part : {&maker.process, &maker.start}) {
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), *part);
    if (error != std::errc() || end == name.data() + name.size() || *end != '-') return std::nullopt;
    name.remove_prefix(static_cast<std::size_t>(end - name.data()) + 1);
  }
  return maker;
}

}  // namespace

std::string temporaryName(int number) {
  const auto process = static_cast<std::uint64_t>(::getpid());
  return fmt::format("{}{}-{}-{}-{}", prefix, placeOfProcesses(), process, startOf(process), number);
}

void removeAbandonedFiles(const fs::path& folder) {
  const std::string place = placeOfProcesses();
  std::error_code ignored;
  for (fs::directory_iterator entry(folder, ignored), end; entry != end; entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    const std::optional<Maker> maker = makerOf(name);
    if (!maker || maker->place != place || maker->start == 0) continue;
    if (startOf(maker->process) == maker->start) continue;
    std::error_code failed;
    if (entry->is_regular_file(failed)) fs::remove(entry->path(), failed);
  }
}

}  // namespace prelight
