#pragma once

#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "gis/crs/geodesy.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// For names of tests.
inline void PrintTo(const GridFormat& format, std::ostream* out) { *out << format.name; }

}  // namespace coastmesh

namespace coastmesh::testing {

// A temporary folder of a test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "coastmesh-test-XXXXXX").string();
    above_ = ::mkdtemp(name.data());
    // One format requires this name of the folder, for a grid distributed to three processes.
    path_ = above_ / "dist_3";
    std::filesystem::create_directory(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(above_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) found.push_back(entry.path().filename());
    std::sort(found.begin(), found.end());
    return found;
  }

 private:
  std::filesystem::path above_, path_;
};

// A lattice of squares, two triangles each, where `wanted(column, row)` is true. A row has columns + 1 points, at the
// positions that `place` returns.
inline TriMesh lattice(
    int columns, int rows, const std::function<bool(int, int)>& wanted,
    const std::function<Point(int, int)>& place = [](int i, int j) {
      return Point{double(i), double(j)};
    }) {
  std::vector<Point> points;
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= columns; ++i) points.push_back(place(i, j));
  const auto at = [&](int i, int j) { return static_cast<VertexId>(j * (columns + 1) + i); };
  std::vector<std::array<VertexId, 3>> corners;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      if (!wanted(i, j)) continue;
      corners.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      corners.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  std::vector<EdgeConflict> conflicts;
  return linkTriangles({points.begin(), points.end()}, corners, conflicts);
}

// Two lakes, the first with an island and an open boundary, with full mantissas in all coordinates. Lies around
// `origin`, with cells of `size` in the units of `crs`.
inline Grid sampleGrid(const Crs& crs, Point origin, double size, int cells = 6) {
  std::mt19937_64 random(20240229);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  const int columns = 2 * cells + 1;
  const auto wanted = [&](int i, int j) {
    const bool island = i == cells / 2 && j == cells / 2;
    return i != cells && !island;  // the column between the lakes is dry
  };
  const TriMesh mesh = lattice(columns, cells, wanted, [&](int i, int j) {
    return Point{origin.x + size * (i + shift(random)), origin.y + size * (j + shift(random))};
  });
  Grid grid;
  grid.title = "Two lakes & an island";
  grid.crs = crs;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (const Point& p : grid.nodes) grid.z.push_back(-3.0 - std::abs(p.x) / 7.0 + shift(random));
  grid.features = {{-7, "lakes.gpkg|lakes", {{"name", "Lake \"One\", süß"}}},
                   {41, "lakes.gpkg|lakes", {{"name", "Lake Two"}}}};
  for (const Triangle& t : mesh.triangles)
    grid.feature_of.push_back(mesh.points[t.v[0]].x < mesh.points[cells].x + size / 2 ? 0 : 1);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) grid.min_angle_deg.push_back(30.0 + 10.0 * shift(random));
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, crs);
  for (Boundary& boundary : findBoundaries(mesh)) {
    if (!grid.boundaries.empty()) {
      grid.boundaries.push_back(std::move(boundary));
      continue;
    }
    // The first shore begins with an open boundary, which its rest joins at both ends.
    const std::vector<std::uint32_t>& loop = boundary.nodes;
    Boundary open{BoundaryRole::Open, false, {loop.begin(), loop.begin() + cells + 1}};
    Boundary land{BoundaryRole::Land, false, {loop.begin() + cells, loop.end()}};
    land.nodes.push_back(loop.front());
    grid.boundaries.push_back(std::move(open));
    grid.boundaries.push_back(std::move(land));
  }
  return grid;
}

// The grid, randomly distributed to three processes.
inline Grid inParts(Grid grid) {
  std::mt19937_64 random(20240301);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t)
    grid.part_of.push_back(static_cast<std::uint32_t>(random() % 3));
  for (std::size_t n = 0; n < grid.nodes.size(); ++n)
    grid.node_part_of.push_back(static_cast<std::uint32_t>(random() % 3));
  return grid;
}

}  // namespace coastmesh::testing
