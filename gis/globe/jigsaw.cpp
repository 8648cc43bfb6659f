#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/bulk_list.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/marked_edges.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr std::string_view kRadii = "RADII=6371;6371;6371\n";  // km; latitudes are taken as those of this sphere
constexpr char kComment = '#';
constexpr std::string_view kBetween = " \t\r;=";

void writeEdges(const Grid& grid, TextWriter& file) {
  const std::vector<MarkedEdge> edges = markedEdges(grid);
  if (edges.empty()) return;
  file << "EDGE2=" << edges.size() << '\n';
  for (const auto& [nodes, marker] : edges) file << nodes[0] << ';' << nodes[1] << ';' << marker << '\n';
}

// JIGSAW's mesh. For a geographic CRS an ELLIPSOID-MESH, which JIGSAW reads as geometry and as an initial mesh:
// longitudes and latitudes in radians, the radii of a sphere in kilometres. For others a EUCLIDEAN-MESH with unchanged
// coordinates. Boundaries and lines are edges with markers (`markedEdges`) as tags; z is the VALUE at a point. The
// radii come last, because MPAS-Tools takes whatever precedes the points for part of them. The CRS goes into a .prj.
// Throws OutputError, also if some z are unknown.
void writeJigsaw(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const double unit = grid.crs.geographic ? kDegree : 1.0;
  TextWriter file(path);
  file << "# written by coastmesh\nMSHID=3;" << (grid.crs.geographic ? "ELLIPSOID" : "EUCLIDEAN") << "-MESH\nNDIMS=2\n"
       << "POINT=" << grid.nodes.size() << '\n';
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << grid.nodes[i].x * unit << ';' << grid.nodes[i].y * unit << ";0\n";
  });
  if (!grid.z.empty()) {
    file << "VALUE=" << grid.z.size() << ";1\n";
    file.rows(loop, grid.z.size(), [&](TextBlock& text, std::size_t i) { text << grid.z[i] << '\n'; });
  }
  writeEdges(grid, file);
  file << "TRIA3=" << grid.triangles.size() << '\n';
  file.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << a << ';' << b << ';' << c << ";0\n";
  });
  if (grid.crs.geographic) file << kRadii;
  file.close();
  writePrjBeside(path, grid.crs);
}

// The contents of a file, unconverted.
struct Contents {
  bool ellipsoid = false;
  std::uint64_t dimensions = 0;
  std::vector<std::array<double, 3>> points;
  std::vector<double> values;
  std::vector<MarkedEdge> edges;
  BulkList<std::array<std::uint32_t, 3>> triangles;
};

template <std::size_t Corners>
std::array<std::uint32_t, Corners> readCorners(TextReader& file, const Contents& contents) {
  std::array<std::uint32_t, Corners> nodes{};
  for (std::uint32_t& node : nodes) {
    const std::int64_t index = file.integer();
    if (index < 0 || index >= static_cast<std::int64_t>(contents.points.size()))
      file.fail("there is no point " + std::to_string(index) + " before it");
    node = static_cast<std::uint32_t>(index);
  }
  return nodes;
}

void readKind(TextReader& file, Contents& contents) {
  file.count();  // the version
  const std::string_view kind = file.hasWord() ? file.word() : "EUCLIDEAN-MESH";
  contents.ellipsoid = kind == "ELLIPSOID-MESH";
  if (!contents.ellipsoid && kind != "EUCLIDEAN-MESH") file.fail("\"" + std::string(kind) + "\" is not a mesh");
}

void readPoints(TextReader& file, Contents& contents) {
  const std::uint64_t count = file.count();
  if (contents.dimensions != 2 && contents.dimensions != 3) file.fail("NDIMS of 2 or 3 is expected before it");
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    std::array<double, 3> point{};
    for (std::size_t k = 0; k < contents.dimensions; ++k) point[k] = file.number();
    contents.points.push_back(point);
  }
}

void readSection(TextReader& file, Contents& contents) {
  const std::string_view name = file.word();
  if (name == "MSHID") return readKind(file, contents);
  if (name == "RADII") return;
  if (name == "NDIMS") {
    contents.dimensions = file.count();
    return;
  }
  if (name == "POINT") return readPoints(file, contents);
  const std::uint64_t count = file.count();
  if ((name.starts_with("QUAD") || name == "TRIA4" || name.starts_with("HEXA") || name.starts_with("WEDG") ||
       name.starts_with("PYRA")) &&
      count > 0)
    file.fail("\"" + std::string(name) + "\": only meshes of triangles can be read");
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    if (name == "EDGE2") {
      const auto nodes = readCorners<2>(file, contents);
      contents.edges.push_back({nodes, file.hasWord() ? file.integer() : 0});
    } else if (name == "TRIA3") {
      contents.triangles.push_back(readCorners<3>(file, contents));
    } else if (name == "VALUE") {
      contents.values.push_back(file.number());
    }
  }
}

// True if the points lie on a sphere around the origin, as in meshes that JIGSAW makes on spheres.
bool areOnSphere(const std::vector<std::array<double, 3>>& points) {
  constexpr double kOff = 0.01;  // of the radius: includes ellipsoids of the Earth
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const auto& p : points) {
    const double radius = std::sqrt(dot(p, p));
    least = std::min(least, radius);
    most = std::max(most, radius);
  }
  return least > 0.0 && most - least < kOff * most;
}

void placeNodes(const Contents& contents, const std::string& path, const Crs& unsaid, Grid& grid) {
  const bool flat = std::ranges::all_of(contents.points, [](const auto& point) { return point[2] == 0.0; });
  const bool in_space = !contents.ellipsoid && contents.dimensions == 3 && !flat;
  if (in_space && !areOnSphere(contents.points))
    throw InputError("'" + path + "': its points lie neither in a plane nor on a sphere");
  for (const auto& p : contents.points) {
    if (in_space) {
      grid.nodes.push_back(asGeographic(placeOf(p)));
    } else if (contents.ellipsoid) {
      grid.nodes.push_back({p[0] / kDegree, p[1] / kDegree});
    } else {
      grid.nodes.push_back({p[0], p[1]});
    }
  }
  grid.crs = readPrjBeside(path, unsaid);
  if ((in_space || contents.ellipsoid) && !grid.crs.geographic) grid.crs = wgs84();
}

// Reads what `writeJigsaw` writes, and meshes made by JIGSAW itself: in a plane, or with three coordinates on a sphere.
// Throws InputError with file and line.
Grid readJigsaw(const std::string& path, const Crs& unsaid) {
  TextReader file(path, kComment, kBetween);
  Contents contents;
  while (file.nextLine()) readSection(file, contents);
  if (contents.triangles.empty()) throw InputError("'" + path + "' has no triangles (TRIA3)");
  if (!contents.values.empty() && contents.values.size() != contents.points.size())
    throw InputError("'" + path + "' has not as many values as points");
  Grid grid;
  placeNodes(contents, path, unsaid, grid);
  grid.triangles = std::move(contents.triangles);
  grid.z = std::move(contents.values);
  takeMarkedEdges(contents.edges, grid);
  return grid;
}

bool isJigsaw(const std::string& path) {
  try {
    TextReader file(path, kComment, kBetween);
    return file.nextLine() && file.word() == "MSHID";
  } catch (const InputError&) {
    return false;  // the reader of the format with this ending reports the error
  }
}

}  // namespace

FormatRecord jigsawFormat() {
  return {{.name = "jigsaw",
           .endings = {"_jigsaw.msh"},
           .description = "JIGSAW's mesh, of the globe in radians",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Lines, GridPart::Rivers},
           .needs_depths = true,
           .places = NodePlaces::Sphere},
          {writeJigsaw, readJigsaw, withPrjBeside, isJigsaw}};
}

}  // namespace coastmesh
