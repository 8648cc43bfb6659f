#pragma once

#include <optional>
#include <string>
#include <vector>

namespace coastmesh {

// Where a nodal attribute comes from: a number for all nodes, or a raster, of classes if there is a table.
struct FieldSource {
  std::string name;  // in full: see `fullFieldName`
  std::optional<double> number;
  std::string file{}, table{};
};

// Adds what NAME=NUMBER, NAME=FILE or NAME=FILE,TABLE says: what can be read as a number is one, and what follows the
// last comma is a table if it ends in .csv. Returns what is wrong with it, as the end of a sentence about it ("is
// not ..."); empty if nothing.
std::string addFieldSource(const std::string& text, std::vector<FieldSource>& sources);

// The files of one of these texts; none if it is wrong.
std::vector<std::string> filesOfFieldSource(const std::string& text);

}  // namespace coastmesh
