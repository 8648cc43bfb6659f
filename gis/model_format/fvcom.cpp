#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "gis/crs/geodesy.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/fields/sponge_fields.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/lower_case.hpp"
#include "gis/places.hpp"

namespace coastmesh {
namespace {

constexpr std::string_view kGridEnding = "_grd.dat";
constexpr int kOpenNodeType = 1;  // prescribed elevation

// LAKE_GRD.DAT has its LAKE_DEP.DAT.
std::string fileOfSet(const std::string& path, const std::string& which) {
  const std::string ending = "_" + which + ".dat";
  if (path.ends_with(kGridEnding)) return path.substr(0, path.size() - kGridEnding.size()) + ending;
  if (path.ends_with(upperCase(kGridEnding)))
    return path.substr(0, path.size() - kGridEnding.size()) + upperCase(ending);
  return std::filesystem::path(path).replace_extension().string() + ending;
}

// Nodes of open boundaries, in order along each boundary, each node once.
std::vector<std::uint32_t> openNodes(const Grid& grid) {
  std::vector<std::uint32_t> nodes;
  std::vector<bool> seen(grid.nodes.size(), false);
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::Open) continue;
    for (const std::uint32_t node : boundary.nodes) {
      if (!seen[node]) nodes.push_back(node);
      seen[node] = true;
    }
  }
  return nodes;
}

// A node of the sponge, in which FVCOM damps currents: next to the node with all of the coefficient, at its radius no
// longer.
struct SpongeNode {
  std::uint32_t node = 0;
  double radius_m = 0.0, coefficient = 0.0;
};

bool hasSponge(const Grid& grid) {
  return std::ranges::any_of(kSpongeFields, [&](const char* name) { return findField(grid, name) != nullptr; });
}

// A value of the sponge at an open node. Throws OutputError if there is no such attribute, and if it is unknown or
// negative.
double spongeValue(const Grid& grid, const char* name, std::uint32_t node, const std::string& path) {
  const NodeField* const field = findField(grid, name);
  if (field == nullptr)
    throw OutputError("cannot write '" + path + "': a sponge needs " + name + " too; give --attribute " + name +
                      "=VALUE");
  const double value = field->values[node];
  if (!(value >= 0.0))
    throw OutputError("cannot write '" + path + "': " + name + (std::isnan(value) ? " is unknown" : " is negative") +
                      " at node " + std::to_string(node + 1) + " at " + pointText(grid.nodes[node]) +
                      ", on an open boundary");
  return value;
}

// The open nodes that have a radius and a coefficient above 0.
std::vector<SpongeNode> spongeOf(const Grid& grid, const std::string& path) {
  std::vector<SpongeNode> sponge;
  if (!hasSponge(grid)) return sponge;
  for (const std::uint32_t node : openNodes(grid)) {
    const SpongeNode one{node, spongeValue(grid, kSpongeFields[0], node, path),
                         spongeValue(grid, kSpongeFields[1], node, path)};
    if (one.radius_m > 0.0 && one.coefficient > 0.0) sponge.push_back(one);
  }
  return sponge;
}

// The value that a file has for each node.
using NodeValue = std::function<double(std::size_t node)>;

NodeValue latitudesOf(const Grid& grid) {
  if (grid.crs.isPlane()) return [](std::size_t) { return 0.0; };
  return [&grid, map = GeographicMap(grid.crs)](std::size_t i) { return map.forward(grid.nodes[i]).lat; };
}

void writeNodeFile(const Grid& grid, const NodeValue& value, const std::string& path, const ItemLoop& loop) {
  TextWriter file(path);
  file << "Node Number = " << grid.nodes.size() << '\n';
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' ' << value(i) << '\n';
  });
  file.close();
}

void writeCells(const Grid& grid, const NodeValue& depth, const std::string& path, const ItemLoop& loop) {
  TextWriter file(path);
  file << "Node Number = " << grid.nodes.size() << "\nCell Number = " << grid.triangles.size() << '\n';
  file.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << t + 1 << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1 << " 1\n";
  });
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' ' << depth(i) << '\n';
  });
  file.close();
}

// A grid without openings gets an empty sponge, since FVCOM always reads one. A grid with openings and no sponge gets
// none: that is for its user to decide.
void writeSponge(const Grid& grid, bool has_openings, const std::string& path) {
  if (has_openings && !hasSponge(grid)) return;
  const std::vector<SpongeNode> sponge = spongeOf(grid, path);
  TextWriter file(path);
  file << "Sponge Node Number = " << sponge.size() << '\n';
  for (const SpongeNode& one : sponge) file << one.node + 1 << ' ' << one.radius_m << ' ' << one.coefficient << '\n';
  file.close();
}

// Writes FVCOM's set: `lake_grd.dat` (cells and nodes), `lake_dep.dat` (depth, positive down), `lake_obc.dat` (nodes of
// open boundaries, type 1), `lake_cor.dat` (latitudes; in a plane 0, which means no rotation) and `lake_spg.dat` (the
// sponge: see `writeSponge`), with the CRS in a .prj. `path` is the first of them; if it does not end in "_grd.dat", it
// names the set without its extension. Rivers are written as shore, since FVCOM has them in its namelist. Throws
// OutputError, also if a depth is unknown.
void writeFvcom(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const NodeValue depth = [&grid](std::size_t i) { return grid.z.empty() ? 0.0 : 0.0 - grid.z[i]; };
  writeCells(grid, depth, fileOfSet(path, "grd"), loop);
  writeNodeFile(grid, depth, fileOfSet(path, "dep"), loop);
  writeNodeFile(grid, latitudesOf(grid), fileOfSet(path, "cor"), loop);
  const std::vector<std::uint32_t> open = openNodes(grid);
  TextWriter file(fileOfSet(path, "obc"));
  file << "OBC Node Number = " << open.size() << '\n';
  for (std::size_t i = 0; i < open.size(); ++i) file << i + 1 << ' ' << open[i] + 1 << ' ' << kOpenNodeType << '\n';
  file.close();
  writeSponge(grid, !open.empty(), fileOfSet(path, "spg"));
  writePrjBeside(fileOfSet(path, "grd"), grid.crs);
}

// "Node Number = 12", with or without blanks at the equals sign.
std::uint64_t readCount(TextReader& file, std::string_view what) {
  file.needLine();
  const std::string_view line = file.line();
  const std::size_t equals = line.find('=');
  if (line.substr(0, equals).find(what) == std::string_view::npos || equals == std::string_view::npos)
    file.fail("\"" + std::string(what) + " = ...\" is expected");
  const std::string_view rest = line.substr(equals + 1);
  const std::size_t begin = std::min(rest.find_first_not_of(" \t"), rest.size());
  return file.countIn(rest.substr(begin, rest.find_first_of(" \t", begin) - begin));
}

std::uint32_t readNode(TextReader& file, const Grid& grid) {
  const std::int64_t id = file.integer();
  if (id < 1 || id > static_cast<std::int64_t>(grid.nodes.size())) file.fail("there is no node " + std::to_string(id));
  return static_cast<std::uint32_t>(id - 1);
}

void readCells(const std::string& path, Grid& grid) {
  TextReader file(path);
  const std::uint64_t nodes = readCount(file, "Node Number"), cells = readCount(file, "Cell Number");
  if (nodes > file.size()) file.fail("it has fewer nodes than it says");
  grid.nodes.resize(nodes);
  for (std::uint64_t t = 0; t < cells; ++t) {
    file.needLine();
    file.integer();
    auto& triangle = grid.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) corner = readNode(file, grid);
  }
  for (Point& node : grid.nodes) {
    file.needLine();
    file.integer();
    node.x = file.number();
    node.y = file.number();
    grid.z.push_back(file.hasWord() ? 0.0 - file.number() : 0.0);
  }
}

void readDepths(const std::string& path, Grid& grid) {
  if (!std::filesystem::exists(path)) return;
  TextReader file(path);
  if (readCount(file, "Node Number") != grid.nodes.size()) file.fail("it has not as many nodes as the grid");
  for (double& z : grid.z) {
    file.needLine();
    file.number();
    file.number();
    z = 0.0 - file.number();
  }
}

std::vector<bool> readOpenNodes(const std::string& path, const Grid& grid) {
  std::vector<bool> is_open(grid.nodes.size(), false);
  if (!std::filesystem::exists(path)) return is_open;
  TextReader file(path);
  const std::uint64_t count = readCount(file, "OBC Node Number");
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    is_open[readNode(file, grid)] = true;
  }
  return is_open;
}

// Nodes without a sponge get 0 for both attributes.
void readSponge(const std::string& path, Grid& grid) {
  if (!std::filesystem::exists(path)) return;
  TextReader file(path);
  const std::uint64_t count = readCount(file, "Sponge Node Number");
  if (count == 0) return;
  std::array<NodeField, 2> fields;
  for (std::size_t i = 0; i < 2; ++i) {
    const FieldName& known = *findFieldName(kSpongeFields[i]);
    fields[i] = {std::string(known.name), std::string(known.unit), 0, known.usual, {}};
    fields[i].values.assign(grid.nodes.size(), known.usual);
  }
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    const std::uint32_t node = readNode(file, grid);
    for (NodeField& field : fields) field.values[node] = file.number();
  }
  grid.node_fields.assign(fields.begin(), fields.end());
}

std::string openNodesRemark(const std::string& path) {
  const std::string open = fileOfSet(path, "obc");
  if (std::filesystem::exists(open)) return {};
  return "there is no '" + open + "', so all boundaries are taken as shore";
}

// Reads the set; only the first file is required. Throws InputError.
Grid readFvcom(const std::string& path, const Crs& unsaid) {
  Grid grid;
  readCells(fileOfSet(path, "grd"), grid);
  readDepths(fileOfSet(path, "dep"), grid);
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  grid.crs = readPrjBeside(fileOfSet(path, "grd"), unsaid);
  grid.boundaries = boundariesOfOpenNodes(grid, readOpenNodes(fileOfSet(path, "obc"), grid));
  readSponge(fileOfSet(path, "spg"), grid);
  return grid;
}

// Rivers in the order of the grid: FVCOM's namelists name each by one of its nodes.
std::string riverNodesText(const Grid& grid, const std::string& path) {
  std::vector<std::string> rivers;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::River) continue;
    const std::uint32_t middle = boundary.nodes[boundary.nodes.size() / 2];
    rivers.push_back((boundary.name.empty() ? "without a name" : "'" + boundary.name + "'") + ": " +
                     std::to_string(middle + 1) + " near " + pointText(grid.nodes[middle]));
  }
  if (rivers.empty()) return {};
  return "rivers by a node of '" + fileOfSet(path, "grd") +
         "', for RIVER_GRID_LOCATION: " + listed(rivers, kMostOpenings);
}

// How far the sponge reaches, in units of the longest edge at each of its nodes: it damps nothing within an element
// whose middle is farther from the node.
std::string spongeText(const Grid& grid, const std::string& path) {
  const std::vector<SpongeNode> sponge = spongeOf(grid, path);
  if (sponge.empty()) return {};
  std::vector<double> radius_m(grid.nodes.size(), 0.0), longest_m(grid.nodes.size(), 0.0);
  for (const SpongeNode& one : sponge) radius_m[one.node] = one.radius_m;
  std::vector<std::array<std::uint32_t, 2>> edges;
  std::vector<std::vector<Point>> sides;
  for (const auto& corners : grid.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = corners[i], b = corners[next3(i)];
      if (radius_m[a] == 0.0 && radius_m[b] == 0.0) continue;
      edges.push_back({a, b});
      sides.push_back({grid.nodes[a], grid.nodes[b]});
    }
  }
  const std::vector<double> lengths = chainLengths(sides, grid.crs);
  for (std::size_t e = 0; e < edges.size(); ++e)
    for (const std::uint32_t node : edges[e]) longest_m[node] = std::max(longest_m[node], lengths[e]);
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const SpongeNode& one : sponge) {
    least = std::min(least, one.radius_m / longest_m[one.node]);
    most = std::max(most, one.radius_m / longest_m[one.node]);
  }
  return "sponge in '" + fileOfSet(path, "spg") + "': " + std::to_string(sponge.size()) +
         forCount(sponge.size(), " node, ", " nodes, ") + roundAmount(least, 2) + " to " + roundAmount(most, 2) +
         " times as wide as the longest edge there";
}

std::string openingsText(const Grid& grid, const std::string& path) {
  const std::string rivers = riverNodesText(grid, path), sponge = spongeText(grid, path);
  return rivers + (rivers.empty() || sponge.empty() ? "" : "\n") + sponge;
}

}  // namespace

FormatRecord fvcomFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    OutputFiles all;
    for (const char* which : {"grd", "dep", "obc", "cor", "spg"}) all.targets.push_back(fileOfSet(path, which));
    all.prj = prjBeside(fileOfSet(path, "grd"));
    return all;
  };
  return {
      {.name = "fvcom",
       .endings = {std::string_view(kGridEnding)},
       .description = "FVCOM's _grd, _dep, _obc, _cor and _spg.dat, depth positive down",
       .readable = true,
       .writable = true,
       .says_depth = true,
       .needs_depths = true,
       .places = NodePlaces::OneTurn,
       .lengths_in_metres = true,
       .marked = MarkedNodes::OfOpen},
      {.write = writeFvcom, .read = readFvcom, .files = files, .remark = openNodesRemark, .openings = openingsText}};
}

}  // namespace coastmesh
