#include "base/machine_memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace prelight {

namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t installedMemory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGE_SIZE);
  return pages > 0 && bytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes)
                                : unlimited;
}

std::uint64_t limitOf(int resource) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  return limit.rlim_cur;
}

/// Returns the number in a file of a control group; "max" means no limit.
std::uint64_t limitIn(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::uint64_t bytes = unlimited;
  return in >> bytes ? bytes : unlimited;
}

/// Returns the least limit of a control group and of those that contain it.
std::uint64_t limitUpFrom(const std::filesystem::path& root, std::filesystem::path group, const char* file) {
  std::uint64_t least = limitIn(root / file);
  for (; !group.empty(); group = group.parent_path()) least = std::min(least, limitIn(root / group / file));
  return least;
}

/// Returns the limit of the control groups of this process: "0::/PATH" of version 2, "N:memory:/PATH" of
/// version 1.
std::uint64_t groupLimit() {
  std::ifstream in("/proc/self/cgroup");
  std::uint64_t least = unlimited;
  for (std::string line; std::getline(in, line);) {
    const std::size_t name = line.find(':'), path = line.find(":/", name + 1);
    if (path == std::string::npos) continue;
    const std::string controllers = line.substr(name + 1, path - name - 1), group = line.substr(path + 2);
    if (controllers.empty())
      least = std::min(least, limitUpFrom("/sys/fs/cgroup", group, "memory.max"));
    else if (controllers == "memory")
      least = std::min(least, limitUpFrom("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return least;
}

}  // namespace

std::uint64_t machineMemory() {
  return std::max<std::uint64_t>(
      1, std::min({installedMemory(), groupLimit(), limitOf(RLIMIT_AS), limitOf(RLIMIT_DATA)}));
}

}  // namespace prelight
