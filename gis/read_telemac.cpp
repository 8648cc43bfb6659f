#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gis/fortran_records.hpp"
#include "gis/grid_formats.hpp"
#include "gis/prj_file.hpp"
#include "gis/rim_boundaries.hpp"
#include "gis/text_reader.hpp"
#include "gis/write_telemac.hpp"

namespace coastmesh {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t last = text.find_last_not_of(std::string(" \0", 2));
  return last == std::string::npos ? std::string() : text.substr(0, last + 1);
}

// Ranks of nodes on the rim from 1, 0 inside.
using Ranks = std::vector<std::int32_t>;

Ranks readGeometry(FortranReader& file, Grid& grid) {
  const std::string title = file.text();
  if (title.size() != 80) file.fail("the title of a SELAFIN file has 80 characters");
  grid.title = trimmed(title.substr(0, 72));
  const std::size_t real = trimmed(title.substr(72)) == "SERAFIND" ? 8 : 4;
  const std::vector<std::int32_t> counts = file.integers(2);
  std::vector<std::string> variables;
  if (counts[0] < 0 || counts[1] < 0) file.fail("the number of its variables is negative");
  for (std::int64_t i = 0; i < std::int64_t{counts[0]} + counts[1]; ++i)
    variables.push_back(trimmed(file.text().substr(0, 16)));
  const std::vector<std::int32_t> parameters = file.integers(10);
  if (parameters[6] > 1) file.fail("it has " + std::to_string(parameters[6]) + " planes; only 2D meshes can be read");
  if (parameters[9] == 1) file.integers(6);  // the date
  const std::vector<std::int32_t> sizes = file.integers(4);
  if (sizes[2] != 3) file.fail("elements of " + std::to_string(sizes[2]) + " nodes; only triangles can be read");
  if (sizes[0] < 0 || sizes[1] < 0) file.fail("a count of it is negative");
  const auto elements = static_cast<std::size_t>(sizes[0]), nodes = static_cast<std::size_t>(sizes[1]);
  const std::vector<std::int32_t> corners = file.integers(3 * elements);
  for (std::size_t t = 0; t < elements; ++t) {
    auto& triangle = grid.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      const std::int32_t node = corners[3 * t + i];
      if (node < 1 || node > sizes[1])
        file.fail("triangle " + std::to_string(t + 1) + " names node " + std::to_string(node) + ", which is not there");
      triangle[i] = static_cast<std::uint32_t>(node - 1);
    }
  }
  Ranks ranks = file.integers(nodes);
  const std::vector<double> x = file.reals(nodes, real), y = file.reals(nodes, real);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      file.fail("node " + std::to_string(i + 1) + " has no finite coordinates");
    grid.nodes.push_back({x[i] + parameters[2], y[i] + parameters[3]});
  }
  if (file.atEnd()) return ranks;
  file.reals(1, real);  // the time
  for (const std::string& name : variables) {
    const std::vector<double> values = file.reals(nodes, real);
    const bool is_bottom = name == "BOTTOM" || name == "FOND" || name == "BOTTOM ELEVATION";
    if (is_bottom && std::ranges::any_of(values, [](double z) { return z != 0.0; })) grid.z = values;
  }
  return ranks;
}

// What each node is by the .cli; shore where it says nothing.
std::vector<BoundaryRole> readConditions(const std::string& path, const Ranks& ranks, Grid& grid) {
  std::vector<BoundaryRole> roles(grid.nodes.size(), BoundaryRole::Land);
  const auto on_rim = static_cast<std::size_t>(std::ranges::count_if(ranks, [](std::int32_t r) { return r != 0; }));
  if (!std::filesystem::exists(path)) {
    grid.notes.push_back("there is no '" + std::filesystem::path(path).filename().string() + "' beside it");
    return roles;
  }
  TextReader file(path);
  std::size_t lines = 0;
  while (file.nextLine()) {
    if (file.line().starts_with('#')) continue;
    ++lines;
    const std::int64_t level = file.integer(), flow = file.integer();
    for (int k = 0; k < 9; ++k) file.number();
    const std::int64_t node = file.integer();
    if (node < 1 || node > static_cast<std::int64_t>(roles.size()))
      file.fail("there is no node " + std::to_string(node));
    if (file.hasWord() && file.integer() != ranks[static_cast<std::size_t>(node - 1)])
      grid.notes.push_back("line " + std::to_string(lines) + " of the .cli is not the rank that IPOBO gives node " +
                           std::to_string(node));
    if (level == 2) continue;
    const bool discharge = level == 4 && (flow == 5 || flow == 6);
    roles[static_cast<std::size_t>(node - 1)] = discharge ? BoundaryRole::River : BoundaryRole::Open;
  }
  if (lines != on_rim)
    grid.notes.push_back("the .cli has " + std::to_string(lines) + " lines, but IPOBO " + std::to_string(on_rim) +
                         " nodes on the rim");
  return roles;
}

// Loops in the order of their ranks, each from its lowest.
void sortByRank(std::vector<std::vector<std::uint32_t>>& loops, const Ranks& ranks) {
  const auto rankOf = [&](std::uint32_t node) { return ranks[node]; };
  for (auto& loop : loops) std::ranges::rotate(loop, std::ranges::min_element(loop, {}, rankOf));
  std::ranges::stable_sort(loops, {}, [&](const auto& loop) { return ranks[loop.front()]; });
}

}  // namespace

Grid readTelemac(const std::string& path) {
  Grid grid;
  FortranReader file(path);
  const Ranks ranks = readGeometry(file, grid);
  const std::vector<BoundaryRole> roles = readConditions(withEnding(path, ".cli"), ranks, grid);
  auto loops = rimOf(grid);
  sortByRank(loops, ranks);
  // An edge is open where both its nodes are; between two kinds it is of the second.
  grid.boundaries = cutLoops(grid.nodes, loops, [&](std::uint32_t from, std::uint32_t to) {
    return RimKind{roles[from] == BoundaryRole::Land ? BoundaryRole::Land : roles[to]};
  });
  grid.crs = readPrjBeside(path);
  return grid;
}

}  // namespace coastmesh
