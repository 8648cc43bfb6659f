#include "parallel/available_memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>
#include <string>

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The number after `word` in a file of such pairs; without a word, the first number.
std::optional<double> numberIn(const std::filesystem::path& path, const std::string& word = {}) {
  std::ifstream file(path);
  std::string name;
  double number = 0.0;
  if (word.empty()) return file >> number ? std::optional(number) : std::nullopt;
  for (std::string line; std::getline(file, line);) {
    std::istringstream pair(line);
    if (pair >> name >> number && name == word) return number;
  }
  return std::nullopt;
}

double onMachine() {
  const std::optional<double> kib = numberIn("/proc/meminfo", "MemAvailable:");
  return kib ? 1024.0 * *kib : kInfinity;
}

// Memory left in a control group and its ancestors. Page cache that can be dropped does not count as used.
double inGroups(const std::filesystem::path& root, std::filesystem::path group, const char* limit, const char* used,
                const char* forgettable) {
  double least = kInfinity;
  for (int depth = 0; depth < 64; ++depth) {
    const std::filesystem::path folder = root / group.relative_path();
    const std::optional<double> most = numberIn(folder / limit), now = numberIn(folder / used);
    if (most && now)
      least = std::min(least, *most - *now + numberIn(folder / "memory.stat", forgettable).value_or(0.0));
    if (!group.has_relative_path()) break;
    group = group.parent_path();
  }
  return std::max(least, 0.0);
}

double inControlGroup() {
  double least = kInfinity;
  std::ifstream file("/proc/self/cgroup");
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
    if (controllers.empty()) {
      least = std::min(least, inGroups("/sys/fs/cgroup", path, "memory.max", "memory.current", "inactive_file"));
    } else if (controllers == "memory") {
      least = std::min(least, inGroups("/sys/fs/cgroup/memory", path, "memory.limit_in_bytes", "memory.usage_in_bytes",
                                       "total_inactive_file"));
    }
  }
  return least;
}

double inAddressSpace() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kInfinity;
  const double pages = numberIn("/proc/self/statm").value_or(0.0);
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - pages * static_cast<double>(sysconf(_SC_PAGESIZE)));
}

}  // namespace

double availableMemory() { return std::min({onMachine(), inControlGroup(), inAddressSpace()}); }

}  // namespace coastmesh
