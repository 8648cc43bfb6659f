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

// Parts that the reports of several commands have in common; their keys are as apps/README.md documents them.

using Json = nlohmann::ordered_json;

Json readSection(const std::vector<std::string>& files, const ReadReport& read, const Crs& crs);

Json editsSection(const std::array<std::uint64_t, kEditKinds>& counts);

// 1234567 as "1,234,567".
std::string grouped(std::uint64_t number);

// For people: how many triangles break the bounds, by what excuses them.
std::string boundText(const BoundCounts& bounds);

// Names in the input need not be UTF-8.
std::string textOf(const Json& report);

// The most memory that the process has held, in MiB.
double peakMemoryMib();

}  // namespace coastmesh
