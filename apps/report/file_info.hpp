#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/input/job_input.hpp"
#include "core/quality.hpp"
#include "gis/grid/grid.hpp"
#include "gis/model/time_step.hpp"

namespace coastmesh {

// The bounding box of coordinates as in the file.
struct Extent {
  Point low;
  Point high;
};

// Of the quadrilaterals of a mesh.
struct QuadFigures {
  std::uint64_t count = 0;
  double min_angle_deg = 180.0;
  double max_angle_deg = 0.0;
  std::uint64_t reflex = 0;  // with an angle of 180 degrees or more
};

// Of a nodal attribute.
struct FieldInfo {
  std::string name;
  double least = 0.0;
  double greatest = 0.0;
  std::uint64_t unknown = 0;  // nodes without a value
};

struct MeshInfo {
  std::string crs;
  std::uint64_t nodes = 0;
  std::uint64_t triangles = 0;  // without the halves of quadrilaterals
  QuadFigures quads;
  std::uint64_t pieces = 0;  // parts that share no node
  std::uint64_t features = 0;
  std::map<std::string, std::uint64_t> boundaries;  // by role
  Extent extent;
  bool has_z = false;     // at any node
  double lowest_z = 0.0;  // metres
  double highest_z = 0.0;
  std::uint64_t nodes_without_z = 0;  // NaN, if the file has z
  std::vector<FieldInfo> fields;
  double area_m2 = 0.0;
  MeshQuality quality;     // of triangles: lengths and areas on the surface
  std::string surface;     // on which angles are measured; "mixed" if pieces differ
  bool closed = true;      // no boundary edges
  std::int64_t euler = 0;  // nodes minus edges plus triangles: 2 for each piece that is a whole globe
  StepReport step;         // the shortest edge, on the ellipsoid, and the time step
  double longest_edge_m = 0.0;
  bool plane = false;
};

struct CoastlineInfo {
  std::string crs;
  std::uint64_t features = 0;
  std::map<std::string, std::uint64_t> sources;  // files, or layers of one, with their features
  std::uint64_t groups = 0;                      // of features that touch one another
  std::uint64_t rings = 0;
  std::uint64_t holes = 0;
  std::uint64_t lines = 0;  // open ones
  std::uint64_t points = 0;
  std::uint64_t skipped_empty = 0;
  std::uint64_t skipped_points = 0;
  Extent extent;
  double shortest_edge_m = 0.0;  // of edges longer than 0
  double longest_edge_m = 0.0;
  std::uint64_t zero_edges = 0;  // between two equal points
  double area_m2 = 0.0;
  std::vector<std::string> warnings;
};

struct PolyInfo {
  std::uint64_t points = 0;
  std::uint64_t segments = 0;
  std::uint64_t holes = 0;
  Extent extent;
  double shortest_edge = 0.0;  // plane units
  double longest_edge = 0.0;
};

MeshInfo describeMesh(const Grid& grid, SurfaceKind surface = SurfaceKind::Auto);
CoastlineInfo describeCoastline(const JobInput& input);
PolyInfo describePoly(const Pslg& pslg);

// As JSON text, and as lines for people.
std::string toJson(const MeshInfo& info);
std::string toJson(const CoastlineInfo& info);
std::string toJson(const PolyInfo& info);
std::string toText(const MeshInfo& info);
std::string toText(const CoastlineInfo& info);
std::string toText(const PolyInfo& info);

}  // namespace coastmesh
