#include "apps/python/from_arrays.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "apps/edit/mesh_file.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/keywords.hpp"
#include "apps/python/run.hpp"
#include "core/computable.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/linked_grid.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

Crs crsOf(const py::object& given, std::vector<std::string>& warnings) {
  std::string text;
  OptionTable options("from_arrays", "");
  options.text({"--crs", "CRS of the mesh"}, text, "CRS", "CRS of the mesh; default: a plane");
  py::dict keywords;
  keywords["crs"] = given;
  setFromKeywords(options, keywords, warnings);
  if (text.empty()) return {};
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    throw OptionError(std::string("crs: ") + error.what());
  }
}

void setNodes(const py::object& points, Grid& grid) {
  for (const Point& point : pointsOf(points, "points")) {
    if (!isComputable(point.x) || !isComputable(point.y)) {
      throw InputError("points: row " + std::to_string(grid.nodes.size()) + " is not two numbers that coordinates " +
                       "can have: finite, and 0 or of a magnitude from 1e-70 to 1e70");
    }
    grid.nodes.push_back(point);
  }
}

void setTriangles(const py::object& triangles, Grid& grid) {
  const std::vector<std::uint32_t> corners = indicesOf(triangles, "triangles", 3, grid.nodes.size());
  if (corners.empty()) throw InputError("triangles: there are none");
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const std::uint32_t a = corners[i], b = corners[i + 1], c = corners[i + 2];
    if (a == b || b == c || c == a)
      throw InputError("triangles: row " + std::to_string(i / 3) + " names point " + std::to_string(b == c ? b : a) +
                       " more than once");
    grid.triangles.push_back({a, b, c});
  }
}

void setDepths(const py::object& z, Grid& grid) {
  grid.z.clear();
  if (z.is_none()) return;
  std::vector<double> depths = numbersOf(z, "z");
  if (depths.size() != grid.nodes.size())
    throw InputError("z: has " + std::to_string(depths.size()) + forCount(depths.size(), " number", " numbers") +
                     ", should have " + std::to_string(grid.nodes.size()) + ", one for each point");
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (!std::isnan(depths[i]) && !isComputable(depths[i]))
      throw InputError("z: row " + std::to_string(i) + " is neither a number of metres nor NaN, for unknown");
  }
  grid.z = std::move(depths);
}

// Where triangles are not joined; empty if they all are.
std::string conflictWarning(const Grid& grid) {
  std::vector<NodePair> edges;
  for (const EdgeConflict& conflict : linkGrid(grid).conflicts) edges.push_back(edgeKey(conflict.a, conflict.b));
  if (edges.empty()) return {};
  std::ranges::sort(edges);
  const auto repeated = std::ranges::unique(edges);
  edges.erase(repeated.begin(), repeated.end());
  return std::to_string(edges.size()) + forCount(edges.size(), " edge belongs", " edges belong") +
         " to more than two triangles, or to two of opposite direction, the first between points " +
         std::to_string(edges.front()[0]) + " and " + std::to_string(edges.front()[1]) +
         ": the triangles are not joined there";
}

}  // namespace

MeshResult meshFromArrays(const py::object& points, const py::object& triangles, const py::object& z,
                          const py::object& crs) {
  MeshResult made;
  Grid& grid = made.grid;
  setNodes(points, grid);
  setTriangles(triangles, grid);
  setDepths(z, grid);
  grid.crs = crsOf(crs, made.warnings);
  const bool says_crs = !crs.is_none();
  const py::gil_scoped_release release;
  requirePlaces(grid.nodes, grid.crs, "points");
  findMissingBoundaries(grid);
  if (!says_crs && mayBeDegrees(grid)) {
    made.warnings.emplace_back(
        "no crs is given, so points lie in a plane; all lie within ±360, ±90: if they are degrees, give "
        "crs='EPSG:4326', otherwise crs='plane'");
  }
  made.warnings.push_back(conflictWarning(grid));
  withThreads({}, [&] { made.warnings.push_back(inKeywordsOfMesh(windingWarning(grid, Recorder().loop("check")))); });
  std::erase(made.warnings, std::string());
  return made;
}

MeshResult meshWithDepths(const MeshResult& mesh, const py::object& z) {
  MeshResult made = mesh;
  setDepths(z, made.grid);
  return made;
}

}  // namespace coastmesh
