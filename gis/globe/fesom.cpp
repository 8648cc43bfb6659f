#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/globe/fesom_levels.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/geographic_nodes.hpp"

namespace coastmesh {
namespace {

constexpr std::string_view kNodeEnding = "nod2d.out";

std::string fileOfSet(const std::string& path, const char* which) {
  std::string base = path;
  if (base.ends_with(kNodeEnding)) {
    base.resize(base.size() - kNodeEnding.size());
  } else {
    base = std::filesystem::path(path).replace_extension().string() + '_';
  }
  return base.append(which).append(".out");
}

// Kind of a node. FESOM2 recomputes it; AWI's other models read it.
enum NodeTag : std::int64_t { kInside = 0, kCoast = 1, kOpenWater = 2 };

std::vector<NodeTag> tagsOf(const Grid& grid, const ItemLoop& loop) {
  std::vector<NodeTag> tags(grid.nodes.size(), kInside);
  for (const auto& boundary : boundaryLoops(grid, loop))
    for (const std::uint32_t node : boundary) tags[node] = kCoast;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open)
      for (const std::uint32_t node : boundary.nodes) tags[node] = kOpenWater;
  return tags;
}

// FESOM2's mesh: `nod2d.out` (longitudes and latitudes in degrees, and the kind of each node), `elem2d.out`,
// `aux3d.out` (level depths, then the depth at each node, negative under water). FESOM2 takes positive values for
// depths too, and makes no water column shallower than its fifth level, so nodes above water are written with depth 0.
// `path` is the first file; if it does not end in "nod2d.out", it gives the name of the set. Throws OutputError, also
// if a depth is unknown and for a mesh in a plane.
void writeFesom(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const std::vector<Point> places = requireGeographicNodes(grid, path, "FESOM2", loop);
  const std::vector<NodeTag> tags = tagsOf(grid, loop);
  TextWriter nodes(fileOfSet(path, "nod2d"));
  nodes << places.size() << '\n';
  nodes.rows(loop, places.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << places[i].x << ' ' << places[i].y << ' ' << static_cast<std::int64_t>(tags[i]) << '\n';
  });
  nodes.close();
  TextWriter elements(fileOfSet(path, "elem2d"));
  elements << grid.triangles.size() << '\n';
  elements.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  });
  elements.close();
  TextWriter depths(fileOfSet(path, "aux3d"));
  const std::vector<int> levels = fesomLevelDepths();
  depths << levels.size() << '\n';
  for (const int level : levels) depths << -level << '\n';
  depths.rows(loop, places.size(), [&](TextBlock& text, std::size_t i) {
    const bool below = !grid.z.empty() && grid.z[i] < 0.0;
    text << (below ? grid.z[i] : 0.0) << '\n';
  });
  depths.close();
}

std::vector<std::int64_t> readNodes(const std::string& path, Grid& grid) {
  TextReader file(path);
  file.needLine();
  const std::uint64_t count = file.count();
  std::vector<std::int64_t> tags;
  std::uint64_t misnumbered = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    misnumbered += file.integer() != static_cast<std::int64_t>(i) + 1;
    const double lon = file.number(), lat = file.number();
    grid.nodes.push_back({lon, lat});
    tags.push_back(file.integer());
  }
  // FESOM2 numbers nodes by the order of the lines.
  if (misnumbered > 0)
    grid.notes.push_back(std::to_string(misnumbered) + forCount(misnumbered, " node has another number than its line",
                                                                " nodes have another number than their line"));
  return tags;
}

void readElements(const std::string& path, Grid& grid) {
  TextReader file(path);
  file.needLine();
  const std::uint64_t count = file.count();
  for (std::uint64_t t = 0; t < count; ++t) {
    file.needLine();
    auto& triangle = grid.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) {
      const std::int64_t id = file.integer();
      if (id < 1 || id > static_cast<std::int64_t>(grid.nodes.size()))
        file.fail("there is no node " + std::to_string(id));
      corner = static_cast<std::uint32_t>(id - 1);
    }
    // In meshes with quads, FESOM2 writes a triangle with its first corner again as the fourth.
    if (file.hasWord() && file.integer() != static_cast<std::int64_t>(triangle[0]) + 1)
      file.fail("an element of four nodes; only triangles can be read");
  }
}

// The next number, on this line or a later one.
double nextNumber(TextReader& file) {
  while (!file.hasWord()) file.needLine();
  return file.number();
}

void readDepths(const std::string& path, Grid& grid) {
  if (!std::filesystem::exists(path)) return;
  TextReader file(path);
  file.needLine();
  const std::uint64_t levels = file.count();
  for (std::uint64_t k = 0; k < levels; ++k) nextNumber(file);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(0.0 - std::abs(nextNumber(file)));
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
}

// Reads the set; aux3d.out is optional, and its level depths are ignored. The CRS is `unsaid` if that is geographic,
// else WGS 84. Throws InputError.
Grid readFesom(const std::string& path, const Crs& unsaid) {
  Grid grid;
  grid.crs = unsaid.geographic ? unsaid : wgs84();
  const std::vector<std::int64_t> tags = readNodes(fileOfSet(path, "nod2d"), grid);
  readElements(fileOfSet(path, "elem2d"), grid);
  readDepths(fileOfSet(path, "aux3d"), grid);
  std::vector<bool> is_open;
  for (const std::int64_t tag : tags) is_open.push_back(tag == kOpenWater);
  grid.boundaries = boundariesOfOpenNodes(grid, is_open);
  return grid;
}

}  // namespace

FormatRecord fesomFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{fileOfSet(path, "nod2d"), fileOfSet(path, "elem2d"), fileOfSet(path, "aux3d")}, {}, {}};
  };
  return {{.name = "fesom",
           .endings = {kNodeEnding},
           .description = "FESOM2's nod2d.out, elem2d.out and aux3d.out, longitudes and latitudes",
           .readable = true,
           .writable = true,
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::Geographic,
           .of_water = true},
          {writeFesom, readFesom, files}};
}

}  // namespace coastmesh
