#include "gis/file/leftovers.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <climits>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "gis/file/remove_folder.hpp"
#include "gis/file/staging_names.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRandom = "XXXXXX";

// A running process, for as long as its machine runs.
struct Process {
  std::uint64_t boot = 0;
  pid_t number = 0;
  std::uint64_t start = 0;  // in ticks since the machine's
};

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// From a /proc/PID/stat: "PID (NAME) STATE …", of which the start is the 20th after the name. A name may have brackets.
std::optional<std::uint64_t> startIn(const std::string& stat) {
  constexpr int kField = 20;
  std::size_t at = stat.rfind(')');
  for (int field = 0; field < kField && at != stat.npos; ++field) at = stat.find(' ', at + 1);
  std::uint64_t start = 0;
  if (at == stat.npos || std::from_chars(stat.data() + at + 1, stat.data() + stat.size(), start).ec != std::errc())
    return std::nullopt;
  return start;
}

// FNV-1a.
std::uint64_t hashOf(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

// nullopt where the system has no such files, or those of other numbers of processes.
std::optional<Process> thisProcess() {
  std::string boot = contentOf("/proc/sys/kernel/random/boot_id");
  const std::string stat = contentOf("/proc/self/stat");
  std::array<char, 64> numbering{};
  const ssize_t length = ::readlink("/proc/self/ns/pid", numbering.data(), numbering.size());
  const std::optional<std::uint64_t> start = startIn(stat);
  if (boot.empty() || length <= 0 || !start || !stat.starts_with(std::to_string(::getpid()) + " ")) return std::nullopt;
  return Process{hashOf(boot.append(numbering.data(), static_cast<std::size_t>(length))), ::getpid(), *start};
}

std::string markOf(const Process& process) {
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "%016llx-%lld-%llu-", static_cast<unsigned long long>(process.boot),
                static_cast<long long>(process.number), static_cast<unsigned long long>(process.start));
  return text.data();
}

// The process whose staging folder has that name; nullopt for any other name.
std::optional<Process> processOf(std::string_view name) {
  const std::size_t part = name.rfind(kStagingMark);
  if (!name.starts_with('.') || part == name.npos || part < 2) return std::nullopt;
  std::string_view rest = name.substr(part + kStagingMark.size());
  const auto next = [&](auto& number, int base) {
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number, base);
    if (error != std::errc() || end == rest.data() + rest.size() || *end != '-') return false;
    rest.remove_prefix(static_cast<std::size_t>(end - rest.data()) + 1);
    return true;
  };
  Process process;
  constexpr int kHexadecimal = 16, kDecimal = 10;
  if (!next(process.boot, kHexadecimal) || !next(process.number, kDecimal) || !next(process.start, kDecimal))
    return std::nullopt;
  // Written alike, so that no other name is taken for one of ours.
  const std::string_view mark = name.substr(part + kStagingMark.size(), name.size() - part - kStagingMark.size());
  if (rest.size() != kRandom.size() || process.number <= 0 || !mark.starts_with(markOf(process))) return std::nullopt;
  return process;
}

// REQUIRES: of this boot and numbering.
bool hasEnded(const Process& process) {
  if (::kill(process.number, 0) != 0 && errno == ESRCH) return true;
  const std::optional<std::uint64_t> start = startIn(contentOf("/proc/" + std::to_string(process.number) + "/stat"));
  return start && *start != process.start;
}

// True for a folder of this user, no link, without the only copies of files that were being replaced.
bool mayGo(const fs::path& folder) {
  struct stat info {};
  if (::lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != ::geteuid()) return false;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (entry->path().native().ends_with(kBackupEnding)) return false;
  return !error;
}

}  // namespace

std::string stagingPattern(const std::string& target) {
  const fs::path path(target);
  const std::string name = "." + path.filename().string() + std::string(kStagingMark);
  const std::optional<Process> process = thisProcess();
  std::string full = name + (process ? markOf(*process) : "") + std::string(kRandom);
  if (full.size() > NAME_MAX) full = name + std::string(kRandom);
  return ((path.has_parent_path() ? path.parent_path() : fs::path(".")) / full).string();
}

void removeLeftovers(const std::string& folder) {
  const std::optional<Process> own = thisProcess();
  if (!own) return;
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::optional<Process> of = processOf(entry->path().filename().native());
    if (of && of->boot == own->boot && hasEnded(*of) && mayGo(entry->path())) found.push_back(entry->path());
  }
  for (const fs::path& leftover : found) removeFolder(leftover.c_str());
}

}  // namespace coastmesh
