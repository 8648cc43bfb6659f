#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Null if the grid has none of that name and component.
NodeField* findField(Grid& grid, const std::string& name, std::uint32_t component = 0);
const NodeField* findField(const Grid& grid, const std::string& name, std::uint32_t component = 0);

// The most frequent of a field's values, of several the least; NaN if none is known.
double mostFrequentOf(const NodeField& field);

// The value of nodes of which nothing else is known: the field's own usual one, else that of its name, else the most
// frequent; NaN if it has none.
double defaultOf(const NodeField& field);

// "mannings_n_at_sea_floor", or with its component: "surface_directional_effective_roughness_length 3".
std::string titleOf(const NodeField& field);
// The same as one word, with components behind an underscore: of the short name, for columns and files, and of the full
// one, for variables.
std::string wordOf(const NodeField& field);
std::string variableWordOf(const NodeField& field);

// The nearest number of seven digits, as many as single precision has, to a value that was computed: 0.025 for
// 0.0250000004. NaN stays NaN.
double roundedValue(double value);

// Gives states (`isState`) the nearer of 0 and 1: edits of grids interpolate between nodes.
void roundStates(Grid& grid);

// Throws OutputError if a value is unknown; for formats that need one at every node.
void requireFields(const Grid& grid, const std::string& path);

// The known values of a field.
struct FieldRange {
  double least = 0.0, greatest = 0.0;
  std::size_t unknown = 0;  // nodes without a value
};
FieldRange rangeOf(const NodeField& field);

// Gives `grid` the fields of `other` that it lacks, with their defaults. Returns the names of these.
std::vector<std::string> addMissingFields(Grid& grid, const Grid& other);

}  // namespace coastmesh
