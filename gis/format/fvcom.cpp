#include <algorithm>
#include <filesystem>
#include <functional>

#include "gis/crs/geographic_map.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
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

// Writes FVCOM's set: `lake_grd.dat` (cells and nodes), `lake_dep.dat` (depth, positive down), `lake_obc.dat` (nodes of
// open boundaries, type 1) and `lake_cor.dat` (latitudes; in a plane 0, which means no rotation), with the CRS in a
// .prj. `path` is the first of them; if it does not end in "_grd.dat", it names the set without its extension. Rivers
// are written as shore, since FVCOM has them in its namelist. Throws OutputError, also if a depth is unknown.
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
  return grid;
}

// Rivers in the order of the grid: FVCOM's namelists name each by one of its nodes.
std::string riverNodesText(const Grid& grid, const std::string& path) {
  constexpr std::size_t kMostNamed = 12;
  std::string text;
  std::size_t rivers = 0;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::River || ++rivers > kMostNamed) continue;
    const std::uint32_t middle = boundary.nodes[boundary.nodes.size() / 2];
    text += (rivers > 1 ? ", " : "") + (boundary.name.empty() ? "without a name" : "'" + boundary.name + "'") + ": " +
            std::to_string(middle + 1) + " near " + pointText(grid.nodes[middle]);
  }
  if (rivers == 0) return {};
  if (rivers > kMostNamed) text += ", and " + std::to_string(rivers - kMostNamed) + " more";
  return "rivers by a node of '" + fileOfSet(path, "grd") + "', for RIVER_GRID_LOCATION: " + text;
}

}  // namespace

FormatRecord fvcomFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    OutputFiles all;
    for (const char* which : {"grd", "dep", "obc", "cor"}) all.targets.push_back(fileOfSet(path, which));
    all.prj = prjBeside(fileOfSet(path, "grd"));
    return all;
  };
  return {
      {.name = "fvcom",
       .endings = {std::string_view(kGridEnding)},
       .description = "FVCOM's _grd, _dep, _obc and _cor.dat, depth positive down",
       .readable = true,
       .writable = true,
       .says_depth = true,
       .needs_depths = true,
       .places = NodePlaces::OneTurn,
       .lengths_in_metres = true,
       .marks_nodes = true},
      {.write = writeFvcom, .read = readFvcom, .files = files, .remark = openNodesRemark, .openings = riverNodesText}};
}

}  // namespace coastmesh
