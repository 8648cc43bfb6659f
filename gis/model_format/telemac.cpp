#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/fortran_records.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/lower_case.hpp"
#include "gis/places.hpp"

namespace coastmesh {
namespace {

std::string withoutPadding(const std::string& text) {
  const std::size_t last = text.find_last_not_of(std::string(" \0", 2));
  return last == std::string::npos ? std::string() : text.substr(0, last + 1);
}

// Ranks of nodes on the boundary, from 1; 0 inside.
using Ranks = std::vector<std::int32_t>;

Ranks readGeometry(FortranReader& file, Grid& grid) {
  const std::string title = file.text();
  if (title.size() != 80) file.fail("the title of a SELAFIN file has 80 characters");
  grid.title = withoutPadding(title.substr(0, 72));
  const std::size_t real = withoutPadding(title.substr(72)) == "SERAFIND" ? 8 : 4;
  const std::vector<std::int32_t> counts = file.integers(2);
  std::vector<std::string> variables;
  if (counts[0] < 0 || counts[1] < 0) file.fail("the number of its variables is negative");
  for (std::int64_t i = 0; i < std::int64_t{counts[0]} + counts[1]; ++i) variables.push_back(file.text());
  const std::vector<std::int32_t> parameters = file.integers(10);
  if (parameters[6] > 1) file.fail("it has " + std::to_string(parameters[6]) + " planes; only 2D meshes can be read");
  if (parameters[9] == 1) file.integers(6);  // the date
  const std::vector<std::int32_t> sizes = file.integers(4);
  if (sizes[2] != 3)
    file.fail("elements of " + std::to_string(sizes[2]) + forCount(sizes[2], " node", " nodes") +
              "; only triangles can be read");
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
  for (const std::string& variable : variables) {
    const std::vector<double> values = file.reals(nodes, real);
    const std::string name = withoutPadding(variable.substr(0, 16));
    const bool is_bottom = name == "BOTTOM" || name == "FOND" || name == "BOTTOM ELEVATION";
    if (is_bottom && std::ranges::any_of(values, [](double z) { return z != 0.0; })) grid.z = values;
    const std::string unit = variable.size() > 16 ? withoutPadding(variable.substr(16)) : std::string();
    const std::string field = fieldOfTelemac(name, unit);
    if (!field.empty() && findField(grid, field) == nullptr) grid.node_fields.push_back({field, unit});
    if (!field.empty() && grid.node_fields.back().values.empty()) grid.node_fields.back().values = values;
  }
  return ranks;
}

// The role of each node in the .cli; land if it is not listed.
std::vector<BoundaryRole> readConditions(const std::string& path, const Ranks& ranks, Grid& grid) {
  std::vector<BoundaryRole> roles(grid.nodes.size(), BoundaryRole::Land);
  const auto on_boundary =
      static_cast<std::size_t>(std::ranges::count_if(ranks, [](std::int32_t r) { return r != 0; }));
  if (!std::filesystem::exists(path)) {
    grid.notes.push_back("there is no '" + std::filesystem::path(path).filename().string() +
                         "' beside it, so all boundaries are taken as shore");
    return roles;
  }
  if (on_boundary == 0 && std::filesystem::is_empty(path)) return roles;  // a closed globe
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
  if (lines != on_boundary)
    grid.notes.push_back("the .cli has " + std::to_string(lines) + forCount(lines, " line", " lines") + ", but IPOBO " +
                         std::to_string(on_boundary) + " nodes on the boundary");
  return roles;
}

// LAKE.SLF has its LAKE.CLI.
std::string conditionsBeside(const std::string& path) {
  const std::string lower = withEnding(path, ".cli"), upper = withEnding(path, ".CLI");
  return !std::filesystem::exists(lower) && std::filesystem::exists(upper) ? upper : lower;
}

// Sorts loops by rank; each starts at its node of lowest rank.
void sortByRank(std::vector<std::vector<std::uint32_t>>& loops, const Ranks& ranks) {
  const auto rankOf = [&](std::uint32_t node) { return ranks[node]; };
  for (auto& loop : loops) std::ranges::rotate(loop, std::ranges::min_element(loop, {}, rankOf));
  std::ranges::stable_sort(loops, {}, [&](const auto& loop) { return ranks[loop.front()]; });
}

// Reads either precision, only two-dimensional meshes of triangles, and the .cli if it exists. Throws InputError.
Grid readTelemac(const std::string& path, const Crs& unsaid) {
  Grid grid;
  FortranReader file(path);
  const Ranks ranks = readGeometry(file, grid);
  const std::vector<BoundaryRole> roles = readConditions(conditionsBeside(path), ranks, grid);
  auto loops = boundaryLoops(grid);
  sortByRank(loops, ranks);
  grid.crs = readPrjBeside(path, unsaid);
  // An edge is open if both its nodes are; between two kinds of opening it has the kind of the second.
  grid.boundaries = cutLoops(grid, loops, [&](std::uint32_t from, std::uint32_t to) {
    return BoundaryKind{roles[from] == BoundaryRole::Land ? BoundaryRole::Land : roles[to]};
  });
  return grid;
}

// The boundary's nodes in TELEMAC's order, with their roles, loop by loop.
struct BoundaryNodes {
  std::vector<std::uint32_t> nodes;
  std::vector<BoundaryRole> roles;
  std::vector<std::size_t> ends;  // of the loops
};

// Outer loops before islands, each from its south-western node, as TELEMAC itself numbers them.
std::vector<std::vector<std::uint32_t>> orderedLoops(const Grid& grid) {
  std::vector<std::vector<std::uint32_t>> loops = boundaryLoops(grid);
  const auto southWest = [&](std::uint32_t node) { return grid.nodes[node].x + grid.nodes[node].y; };
  for (auto& loop : loops) std::ranges::rotate(loop, std::ranges::min_element(loop, {}, southWest));
  std::ranges::stable_partition(
      loops, [&](const auto& loop) { return roleOfLoop(grid.nodes, loop, grid.crs) == BoundaryRole::Land; });
  return loops;
}

// A node between two kinds of opening has the kind of the edge before it; one at the end of an opening belongs to it.
BoundaryNodes boundaryNodesOf(const Grid& grid, const std::string& path) {
  const EdgeKinds kinds(grid);
  const auto roleOf = [&](std::uint32_t from, std::uint32_t to) {
    const BoundaryKind* const kind = kinds.find(from, to);
    return kind != nullptr ? kind->role : BoundaryRole::Land;
  };
  BoundaryNodes boundary;
  std::vector<bool> seen(grid.nodes.size(), false);
  for (const auto& loop : orderedLoops(grid)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t node = loop[i];
      if (seen[node])
        throw OutputError("cannot write '" + path + "': the mesh touches itself in the node at " +
                          std::to_string(grid.nodes[node].x) + ", " + std::to_string(grid.nodes[node].y) +
                          ", which TELEMAC's files cannot hold; repair it with --target telemac");
      seen[node] = true;
      const BoundaryRole before = roleOf(loop[(i + loop.size() - 1) % loop.size()], node);
      const BoundaryRole after = roleOf(node, loop[(i + 1) % loop.size()]);
      boundary.nodes.push_back(node);
      boundary.roles.push_back(isOpening(before) ? before : isOpening(after) ? after : BoundaryRole::Land);
    }
    boundary.ends.push_back(boundary.nodes.size());
  }
  return boundary;
}

std::string padded(std::string_view text, std::size_t width) {
  std::string out(text.substr(0, width));
  out.resize(width, ' ');
  return out;
}

// The names of the grid's attributes, each once: what would be a second friction has a name of its own.
std::vector<std::string> namesOfFields(const Grid& grid) {
  std::vector<std::string> names{"BOTTOM"};
  const auto isTaken = [&](const std::string& name) { return std::ranges::find(names, name) != names.end(); };
  for (const NodeField& field : grid.node_fields) {
    std::string name = field.component == 0 ? telemacFieldName(field.name) : telemacWord(wordOf(field));
    if (isTaken(name)) name = telemacWord(wordOf(field));
    const std::string start = name.substr(0, 12);
    for (int i = 2; isTaken(name); ++i) name = start + ' ' + std::to_string(i);
    names.push_back(std::move(name));
  }
  names.erase(names.begin());
  return names;
}

void writeGeometry(const Grid& grid, const BoundaryNodes& boundary, const std::string& path, const ItemLoop& loop) {
  FortranWriter file(path);
  file.text(padded(grid.title, 72) + "SERAFIND");
  file.integers(std::array<std::int32_t, 2>{1 + static_cast<std::int32_t>(grid.node_fields.size()), 0});
  file.text(padded("BOTTOM", 16) + padded("M", 16));
  const std::vector<std::string> names = namesOfFields(grid);
  for (std::size_t k = 0; k < names.size(); ++k) file.text(padded(names[k], 16) + padded(grid.node_fields[k].unit, 16));
  file.integers(std::array<std::int32_t, 10>{1});
  const auto nodes = static_cast<std::int32_t>(grid.nodes.size());
  file.integers(std::array{static_cast<std::int32_t>(grid.triangles.size()), nodes, 3, 1});
  file.integers(loop, 3 * grid.triangles.size(),
                [&](std::size_t i) { return static_cast<std::int32_t>(grid.triangles[i / 3][i % 3]) + 1; });
  Ranks ranks(grid.nodes.size(), 0);
  for (std::size_t i = 0; i < boundary.nodes.size(); ++i) ranks[boundary.nodes[i]] = static_cast<std::int32_t>(i) + 1;
  file.integers(loop, ranks.size(), [&](std::size_t i) { return ranks[i]; });
  file.doubles(loop, grid.nodes.size(), [&](std::size_t i) { return grid.nodes[i].x; });
  file.doubles(loop, grid.nodes.size(), [&](std::size_t i) { return grid.nodes[i].y; });
  file.doubles(std::array{0.0});  // the time
  file.doubles(loop, grid.nodes.size(), [&](std::size_t i) { return grid.z.empty() ? 0.0 : grid.z[i]; });
  for (const NodeField& field : grid.node_fields)
    file.doubles(loop, field.values.size(), [&field](std::size_t i) { return field.values[i]; });
  file.close();
}

void writeConditions(const BoundaryNodes& boundary, const std::string& path) {
  TextWriter file(path);
  for (std::size_t i = 0; i < boundary.nodes.size(); ++i) {
    const BoundaryRole role = boundary.roles[i];
    const bool liquid = isOpening(role);
    file << (role == BoundaryRole::Open ? "5 4 4"
             : liquid                   ? "4 5 5"
                                        : "2 2 2")
         << " 0.000 0.000 0.000 0.000 " << (liquid ? '4' : '2') << " 0.000 0.000 0.000 " << boundary.nodes[i] + 1 << ' '
         << i + 1 << '\n';
  }
  file.close();
}

// The number of TELEMAC's liquid boundary that holds each node, 0 on shores, as its subroutine FRONT2 counts them: they
// begin where codes change, in the order of the .cli. If a loop's first edge is liquid, the boundary there is its
// first, and what comes before that edge belongs to it too.
std::vector<std::size_t> liquidNumbers(std::size_t nodes, const BoundaryNodes& boundary) {
  std::vector<std::size_t> number(nodes, 0);
  const auto liquid = [&](std::size_t i) { return isOpening(boundary.roles[i]); };
  const auto numberAt = [&](std::size_t i) -> std::size_t& { return number[boundary.nodes[i]]; };
  std::size_t last = 0, first = 0;  // in `boundary`: the loop's first node
  for (const std::size_t end : boundary.ends) {
    const std::size_t before = last;
    const bool begins = liquid(first) && liquid(first + 1);
    if (begins) numberAt(first) = ++last;
    for (std::size_t i = first + 1; i < end; ++i) {
      if (!liquid(i)) continue;
      if (!liquid(i - 1) || boundary.roles[i - 1] != boundary.roles[i]) ++last;
      numberAt(i) = last;
    }
    if (!begins && liquid(first)) numberAt(first) = last;
    if (begins && liquid(end - 1) && last > before + 1) {
      for (std::size_t i = end; numberAt(i - 1) == last; --i) numberAt(i - 1) = before + 1;
      --last;
    }
    first = end;
  }
  return number;
}

std::string liquidBoundariesText(const Grid& grid, const std::string& path) {
  const auto liquid = [](const Boundary& boundary) { return isOpening(boundary.role); };
  if (std::ranges::count_if(grid.boundaries, liquid) < 2) return {};
  const std::vector<std::size_t> number = liquidNumbers(grid.nodes.size(), boundaryNodesOf(grid, path));
  std::map<std::size_t, std::string> names;
  for (const Boundary& boundary : grid.boundaries) {
    if (!liquid(boundary)) continue;
    std::string& name = names[number[boundary.nodes.back()]];
    if (name.empty()) name = openingName(boundary, grid);  // several of the same codes in a row are one
  }
  if (names.size() < 2) return {};
  std::vector<std::string> numbered;
  for (const auto& [at, name] : names) numbered.push_back(std::to_string(at) + ' ' + name);
  return "liquid boundaries of '" + withEnding(path, ".cli") +
         "', in TELEMAC's order: " + listed(numbered, kMostOpenings);
}

// Writes TELEMAC's SELAFIN geometry in double precision (SERAFIND) with the variable BOTTOM, elevation in metres, one
// for each nodal attribute, such as BOTTOM FRICTION, and beside it the boundary conditions, `lake.slf` with `lake.cli`,
// and the CRS in a .prj. Shores are walls (2 2 2), open boundaries levels (5 4 4), rivers discharges (4 5 5). The file
// has codes for nodes only: a shore of a single edge between two openings becomes open. Throws OutputError, also if a z
// is unknown or the mesh touches itself in a node.
void writeTelemac(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  requireFields(grid, path);
  const BoundaryNodes boundary = boundaryNodesOf(grid, path);
  writeGeometry(grid, boundary, path, loop);
  writeConditions(boundary, withEnding(path, ".cli"));
  writePrjBeside(path, grid.crs);
}

}  // namespace

FormatRecord telemacFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{path, withEnding(path, ".cli")}, {}, prjBeside(path)};
  };
  return {{.name = "telemac",
           .endings = {".slf"},
           .description = "TELEMAC's SELAFIN and .cli, elevation positive up",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Title, GridPart::Rivers, GridPart::NodeFields},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true,
           .marked = MarkedNodes::OfOpenAndRivers},
          {.write = writeTelemac, .read = readTelemac, .files = files, .openings = liquidBoundariesText}};
}

}  // namespace coastmesh
