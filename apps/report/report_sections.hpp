#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/input_corners.hpp"
#include "gis/clean/clean.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

// Sections that the reports of several commands share, with keys as documented in apps/README.md.

using Json = nlohmann::ordered_json;

Json readSection(const std::vector<std::string>& files, const ReadReport& read, const Crs& crs);

Json editsSection(const std::array<std::uint64_t, kEditKinds>& counts);

// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

// For users: how many triangles break the bounds, by what excuses them.
std::string boundText(const BoundCounts& bounds);

// Indented, without secrets. Bytes that are not UTF-8, which names in the input may have, are replaced.
std::string textOf(const Json& report);

// Peak memory of the process, MiB.
double peakMemoryMib();

}  // namespace coastmesh
