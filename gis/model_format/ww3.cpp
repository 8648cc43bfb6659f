#include <algorithm>
#include <fstream>

#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/boundary_kinds.hpp"

namespace coastmesh {
namespace {

constexpr std::int64_t kPoint = 15, kTriangle = 2;

std::vector<std::uint32_t> openNodes(const Grid& grid) {
  std::vector<std::uint32_t> nodes;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open) nodes.insert(nodes.end(), boundary.nodes.begin(), boundary.nodes.end());
  std::ranges::sort(nodes);
  const auto repeated = std::ranges::unique(nodes);
  nodes.erase(repeated.begin(), repeated.end());
  return nodes;
}

void needLine(TextReader& file, std::string_view wanted) {
  file.needLine();
  if (file.line() != wanted) file.fail(std::string(wanted) + " is expected");
}

// Writes Gmsh 2 ASCII for WAVEWATCH III: z is the depth, positive down; nodes of open boundaries come first, as
// elements of type 15, then the triangles with three tags. The CRS is written to a .prj. Throws OutputError, also if a
// depth is unknown.
void writeWw3(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  TextWriter file(path);
  file << "$MeshFormat\n2 0 8\n$EndMeshFormat\n$Nodes\n" << grid.nodes.size() << '\n';
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' ' << (grid.z.empty() ? 0.0 : 0.0 - grid.z[i])
         << '\n';
  });
  const std::vector<std::uint32_t> open = openNodes(grid);
  file << "$EndNodes\n$Elements\n" << open.size() + grid.triangles.size() << '\n';
  std::size_t id = 0;
  for (const std::uint32_t node : open) file << ++id << ' ' << kPoint << " 2 0 0 " << node + 1 << '\n';
  file.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << id + t + 1 << ' ' << kTriangle << " 3 0 " << t + 1 << " 0 " << a + 1 << ' ' << b + 1 << ' ' << c + 1
         << '\n';
  });
  file << "$EndElements\n";
  file.close();
  writePrjBeside(path, grid.crs);
}

// Throws InputError.
Grid readWw3(const std::string& path, const Crs& unsaid) {
  Grid grid;
  TextReader file(path);
  needLine(file, "$MeshFormat");
  file.needLine();
  if (!file.line().starts_with("2")) file.fail("WAVEWATCH III reads version 2 of Gmsh's format");
  needLine(file, "$EndMeshFormat");
  needLine(file, "$Nodes");
  file.needLine();
  const std::uint64_t nodes = file.count();
  std::vector<std::int64_t> ids;
  for (std::uint64_t i = 0; i < nodes; ++i) {
    file.needLine();
    ids.push_back(file.integer());
    const double x = file.number(), y = file.number();
    grid.nodes.push_back({x, y});
    grid.z.push_back(0.0 - file.number());
  }
  const IdMap index(std::move(ids), file, "node");
  needLine(file, "$EndNodes");
  needLine(file, "$Elements");
  file.needLine();
  const std::uint64_t elements = file.count();
  std::vector<bool> is_open(grid.nodes.size(), false);
  const auto readNode = [&] {
    const std::int64_t id = file.integer();
    const std::uint32_t node = index.indexOf(id);
    if (node == kNone) file.fail("there is no node " + std::to_string(id));
    return node;
  };
  for (std::uint64_t e = 0; e < elements; ++e) {
    file.needLine();
    file.integer();
    const std::int64_t type = file.integer();
    const std::uint64_t tags = file.count();
    for (std::uint64_t k = 0; k < tags; ++k) file.integer();
    if (type == kPoint) {
      is_open[readNode()] = true;
    } else if (type == kTriangle) {
      auto& triangle = grid.triangles.emplace_back();
      for (std::uint32_t& corner : triangle) corner = readNode();
    } else {
      file.fail("an element of type " + std::to_string(type) + ", which WAVEWATCH III does not know");
    }
  }
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  grid.crs = readPrjBeside(path, unsaid);
  grid.boundaries = boundariesOfOpenNodes(grid, is_open);
  return grid;
}

// Gmsh itself writes newer versions.
bool isOfVersion2(const std::string& path) {
  std::ifstream file(path);
  std::string first, version;
  return std::getline(file, first) && first.starts_with("$MeshFormat") && file >> version &&
         (version == "2" || version == "2.0");
}

// Other tools write these files without the ending. True if the first elements are points and a triangle, or a triangle
// as in `writeWw3`, with three tags of which the first is 0.
bool isWw3(const std::string& path) {
  if (!isOfVersion2(path)) return false;
  try {
    TextReader file(path);
    while (file.nextLine() && file.line() != "$Elements")
      if (file.line() == "$PhysicalNames") return false;
    file.nextLine();  // their number
    for (bool points = false; file.nextLine(); points = true) {
      file.word();
      const std::string_view type = file.word(), tags = file.word(), tag = file.word();
      if (type == std::to_string(kPoint)) continue;
      return type == std::to_string(kTriangle) && (points || (tags == "3" && tag == "0"));
    }
  } catch (const InputError&) {
    // The reader of the format with this ending reports the error.
  }
  return false;
}

}  // namespace

FormatRecord ww3Format() {
  return {{.name = "ww3",
           .endings = {"_ww3.msh"},
           .description = "Gmsh 2 for WAVEWATCH III, depth positive down",
           .readable = true,
           .writable = true,
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true,
           .marked = MarkedNodes::OfOpen},
          {writeWw3, readWw3, withPrjBeside, isWw3}};
}

}  // namespace coastmesh
