#include <netcdf.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/tri_mesh.hpp"
#include "gis/error.hpp"
#include "gis/file/netcdf_file.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

constexpr double kEarthRadiusM = 6371220.0;  // the sphere of MPAS
constexpr const char* kOpenCell = "openBoundaryCell";
constexpr const char* kBoundaryCell = "boundaryCell";

// The circumcentre of a triangle in a plane.
SphereVector circumcentreInPlane(const SphereVector& a, const SphereVector& b, const SphereVector& c) {
  const double bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
  const double twice = 2.0 * (bx * cy - by * cx), bb = bx * bx + by * by, cc = cx * cx + cy * cy;
  return {a[0] + (cy * bb - by * cc) / twice, a[1] + (bx * cc - cx * bb) / twice, 0.0};
}

std::vector<SphereVector> cellsOf(const Grid& grid) {
  std::vector<SphereVector> cells;
  if (grid.crs.isPlane()) {
    for (const Point& p : grid.nodes) cells.push_back({p.x, p.y, 0.0});
  } else {
    for (const Point& place : geographicNodes(grid)) cells.push_back(scaled(onSphere(asLonLat(place)), kEarthRadiusM));
  }
  return cells;
}

std::vector<SphereVector> verticesOf(const Grid& grid, const std::vector<SphereVector>& cells, const std::string& path,
                                     const ItemLoop& loop) {
  std::vector<SphereVector> vertices(grid.triangles.size());
  forEachByStretches(loop, vertices.size(), [&](std::size_t t) {
    const SphereVector &a = cells[grid.triangles[t][0]], &b = cells[grid.triangles[t][1]],
                       &c = cells[grid.triangles[t][2]];
    vertices[t] =
        grid.crs.isPlane() ? circumcentreInPlane(a, b, c) : scaled(circumcentreOnSphere(a, b, c), kEarthRadiusM);
  });
  for (std::size_t t = 0; t < vertices.size(); ++t) {
    if (std::ranges::all_of(vertices[t], [](double x) { return std::isfinite(x); })) continue;
    const Point& place = grid.nodes[grid.triangles[t][0]];
    throw OutputError("cannot write '" + path + "': the triangle at " + std::to_string(place.x) + ", " +
                      std::to_string(place.y) + " has no area, and so no corner of MPAS' cells");
  }
  return vertices;
}

// MPAS' mesh density, relative to the shortest edges: the fourth power of the shortest length over the local length.
std::vector<double> densitiesOf(const Grid& grid) {
  std::vector<double> densities(grid.nodes.size(), 1.0);
  double shortest = std::numeric_limits<double>::infinity();
  for (const double size : grid.size_m)
    if (size > 0.0) shortest = std::min(shortest, size);
  for (std::size_t i = 0; i < grid.size_m.size(); ++i)
    if (grid.size_m[i] > 0.0) densities[i] = std::pow(shortest / grid.size_m[i], 4.0);
  return densities;
}

template <typename ValueOf>
void define(NetcdfWriter& file, const std::string& name, int type, const std::vector<int>& dimensions,
            std::size_t count, const ValueOf& value_of) {
  file.putLater(file.variable(name, type, dimensions), count, value_of);
}

// Triangles as input of MPAS' mesh converter: MPAS' cells are the nodes, its vertices the circumcentres of triangles,
// `cellsOnVertex` the corners, counted from 1. On a sphere of 6371.22 km with unchanged latitudes, or in the plane. In
// addition, `bottomDepth` (positive down) if there are depths, `boundaryCell` if the mesh has a boundary and
// `openBoundaryCell` if parts of it are open; the converter leaves these out. Throws OutputError, also if some depths
// are unknown.
void writeMpas(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const bool sphere = !grid.crs.isPlane();
  const std::vector<SphereVector> cells = cellsOf(grid), vertices = verticesOf(grid, cells, path, loop);
  const std::vector<double> densities = densitiesOf(grid);
  std::vector<std::int32_t> on_boundary(grid.nodes.size(), 0), open(grid.nodes.size(), 0);
  for (const auto& nodes : boundaryLoops(grid, loop))
    for (const std::uint32_t node : nodes) on_boundary[node] = 1;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open)
      for (const std::uint32_t node : boundary.nodes) open[node] = 1;
  constexpr std::size_t kLargest = 4'000'000'000;  // bytes of an array in a 64-bit offset file, with a margin
  NetcdfWriter file(path, std::max(cells.size() * 8, vertices.size() * 12) > kLargest);
  file.attribute(NC_GLOBAL, "on_a_sphere", sphere ? "YES" : "NO");
  file.attribute(NC_GLOBAL, "sphere_radius", sphere ? kEarthRadiusM : 0.0);
  file.attribute(NC_GLOBAL, "is_periodic", "NO");
  file.attribute(NC_GLOBAL, "source", "coastmesh");
  const int cell = file.dimension("nCells", cells.size()), vertex = file.dimension("nVertices", vertices.size());
  const int corner = file.dimension("vertexDegree", 3);
  constexpr std::array kAxes{"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string axis = kAxes[k];
    define(file, axis + "Cell", NC_DOUBLE, {cell}, cells.size(), [&cells, k](std::size_t i) { return cells[i][k]; });
    define(file, axis + "Vertex", NC_DOUBLE, {vertex}, vertices.size(),
           [&vertices, k](std::size_t t) { return vertices[t][k]; });
  }
  define(file, "cellsOnVertex", NC_INT, {vertex, corner}, 3 * vertices.size(),
         [&grid](std::size_t i) { return static_cast<std::int32_t>(grid.triangles[i / 3][i % 3]) + 1; });
  define(file, "meshDensity", NC_DOUBLE, {cell}, cells.size(), [&densities](std::size_t i) { return densities[i]; });
  if (!grid.z.empty())
    define(file, "bottomDepth", NC_DOUBLE, {cell}, cells.size(), [&grid](std::size_t i) { return 0.0 - grid.z[i]; });
  if (std::ranges::count(on_boundary, 1) > 0)
    define(file, kBoundaryCell, NC_INT, {cell}, cells.size(), [&](std::size_t i) { return on_boundary[i]; });
  if (std::ranges::count(open, 1) > 0)
    define(file, kOpenCell, NC_INT, {cell}, cells.size(), [&open](std::size_t i) { return open[i]; });
  file.endDefinitions();
  file.close(loop);
}

void readPlaces(const NetcdfReader& file, bool sphere, Grid& grid) {
  const std::vector<double> x = file.doubles("xCell"), y = file.doubles("yCell"), z = file.doubles("zCell");
  if (y.size() != x.size() || z.size() != x.size()) file.fail("xCell, yCell and zCell are not of one length");
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]) || !std::isfinite(z[i]) ||
        (sphere && x[i] == 0.0 && y[i] == 0.0 && z[i] == 0.0))
      file.fail("cell " + std::to_string(i + 1) + " has no place");
    grid.nodes.push_back(sphere ? asGeographic(placeOf({x[i], y[i], z[i]})) : Point{x[i], y[i]});
  }
}

// Reads meshes of MPAS itself too: vertices on their boundary, with fewer than three cells, are no triangles. Throws
// InputError.
Grid readMpas(const std::string& path, const Crs& unsaid) {
  const NetcdfReader file(path);
  Grid grid;
  const bool sphere = file.globalText("on_a_sphere").starts_with("YES");
  grid.crs = unsaid;
  if (sphere && !grid.crs.geographic) grid.crs = wgs84();
  readPlaces(file, sphere, grid);
  const std::vector<std::size_t> shape = file.shape("cellsOnVertex");
  if (shape.size() != 2 || shape[1] != 3) file.fail("cellsOnVertex has not three cells a vertex");
  const std::vector<std::int64_t> corners = file.integers("cellsOnVertex");
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (std::ranges::count(corners.begin() + static_cast<std::ptrdiff_t>(i),
                           corners.begin() + static_cast<std::ptrdiff_t>(i) + 3, 0) > 0)
      continue;
    auto& triangle = grid.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t cell = corners[i + k];
      if (cell < 1 || cell > static_cast<std::int64_t>(grid.nodes.size()))
        file.fail("vertex " + std::to_string(i / 3 + 1) + " names cell " + std::to_string(cell) +
                  ", which is not there");
      triangle[k] = static_cast<std::uint32_t>(cell - 1);
    }
  }
  if (file.hasVariable("bottomDepth") && file.shape("bottomDepth") == std::vector{grid.nodes.size()})
    for (const double depth : file.doubles("bottomDepth")) grid.z.push_back(0.0 - depth);
  std::vector<bool> is_open(grid.nodes.size(), false);
  if (file.hasVariable(kOpenCell) && file.shape(kOpenCell) == std::vector{grid.nodes.size()}) {
    const std::vector<std::int64_t> open = file.integers(kOpenCell);
    for (std::size_t i = 0; i < open.size(); ++i) is_open[i] = open[i] != 0;
  }
  grid.boundaries = boundariesOfOpenNodes(grid, is_open);
  return grid;
}

bool isMpas(const std::string& path) {
  try {
    const NetcdfReader file(path);
    return file.hasVariable("cellsOnVertex") && file.hasVariable("xCell");
  } catch (const InputError&) {
    return false;  // the reader of the format with this ending reports the error
  }
}

}  // namespace

FormatRecord mpasFormat() {
  return {{.name = "mpas",
           .endings = {"_mpas.nc"},
           .description = "NetCDF for MPAS' mesh converter, on a sphere",
           .readable = true,
           .writable = true,
           .needs_depths = true,
           .places = NodePlaces::Sphere,
           .marked = MarkedNodes::OfOpen},
          {writeMpas, readMpas, nullptr, isMpas}};
}

}  // namespace coastmesh
