#include "apps/report/report_sections.hpp"

#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>

#include "gis/for_count.hpp"
#include "gis/secrets.hpp"

namespace coastmesh {

namespace {

// "touching ring" as "touching_ring".
std::string keyOf(std::string_view words) {
  std::string key(words);
  for (char& c : key) {
    if (c == ' ' || c == '-') c = '_';
  }
  return key;
}

// In names of sources, whatever section they are in.
void hideSecrets(Json& json) {
  if (json.is_string()) {
    json = withoutSecrets(json.get_ref<const std::string&>());
  } else if (json.is_structured()) {
    for (Json& member : json) hideSecrets(member);
  }
}

}  // namespace

Json readSection(const std::vector<std::string>& files, const ReadReport& read, const Crs& crs) {
  return {{"files", files},
          {"features", read.features},
          {"rings", read.rings},
          {"points", read.points},
          {"skipped_empty", read.skipped_empty},
          {"skipped_points", read.skipped_points},
          {"filtered", read.filtered},
          {"beyond_frame", read.beyond_frame},
          {"notes", read.notes},
          {"warnings", read.warnings},
          {"crs", nameOf(crs)}};
}

Json editsSection(const std::array<std::uint64_t, kEditKinds>& counts) {
  Json section = Json::object();
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) {
    section[keyOf(toString(static_cast<EditKind>(kind)))] = counts[kind];
  }
  return section;
}

std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

std::string boundText(const BoundCounts& bounds) {
  return grouped(bounds.below) + forCount(bounds.below, " triangle breaks", " triangles break") +
         " the bounds on angles: " + grouped(bounds.corner) + " in input angles too small for them, " +
         grouped(bounds.near) + " near to such an angle, " + grouped(bounds.unresolved()) + " unresolved";
}

std::string textOf(const Json& report) {
  Json shown = report;
  hideSecrets(shown);
  return shown.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

double peakMemoryMib() {
  // VmHWM is this program's own; the value of getrusage starts with that of the process that started it.
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    double kib = 0.0;
    if (std::sscanf(line.c_str(), "VmHWM: %lf kB", &kib) == 1) return kib / 1024.0;
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

}  // namespace coastmesh
