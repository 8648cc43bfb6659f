#include "gis/format/read_ugrid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <span>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/bulk_list.hpp"
#include "gis/crs/length_unit.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/depth_names.hpp"
#include "gis/file/netcdf_file.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/lower_case.hpp"
#include "gis/rounded_depth.hpp"

namespace coastmesh {
namespace {

using namespace std::string_view_literals;

// Some programs write the number as text.
bool isOfFaces(const NetcdfReader& file, const std::string& mesh) {
  const std::string text = file.text(mesh, "topology_dimension");
  std::istringstream words(text);
  double dimension = 0.0;
  return file.number(mesh, "topology_dimension") == 2.0 || (words >> dimension && dimension == 2.0);
}

std::string findMesh(const NetcdfReader& file) {
  for (const std::string& name : file.variables()) {
    if (file.text(name, "cf_role") == "mesh_topology" && isOfFaces(file, name)) return name;
  }
  file.fail("there is no UGRID mesh of dimension 2 in it (a variable with cf_role \"mesh_topology\")");
}

// By the standard_name, or by what else CF tells coordinates apart.
bool isNorthing(const NetcdfReader& file, const std::string& variable) {
  const std::string name = file.text(variable, "standard_name");
  if (!name.empty()) return name == "latitude" || name == "projection_y_coordinate";
  const std::string axis = file.text(variable, "axis"), units = file.text(variable, "units");
  constexpr std::array kDegreesNorth{"degrees_north"sv, "degree_north"sv, "degrees_N"sv,
                                     "degree_N"sv,      "degreesN"sv,     "degreeN"sv};
  return axis == "Y" || std::ranges::count(kDegreesNorth, units) > 0;
}

std::pair<std::string, std::string> coordinateNames(const NetcdfReader& file, const std::string& mesh) {
  std::istringstream words(file.text(mesh, "node_coordinates"));
  std::string first, second;
  if (!(words >> first >> second)) file.fail("\"" + mesh + "\" does not name two node_coordinates");
  if (!file.hasVariable(first) || !file.hasVariable(second))
    file.fail("there is no variable \"" + (file.hasVariable(first) ? second : first) + "\", which \"" + mesh +
              "\" names");
  if (isNorthing(file, first)) std::swap(first, second);
  return {first, second};
}

Crs crsOf(const NetcdfReader& file, const std::string& variable, const std::string& text) {
  try {
    return parseCrs(text);
  } catch (const InputError& error) {
    file.fail("\"" + variable + "\": " + error.what());
  }
}

Crs readCrs(const NetcdfReader& file, const std::string& x) {
  constexpr std::string_view kNoCode = "EPSG:0";  // D-FlowFM's code for none
  std::string variable = file.text(x, "grid_mapping");
  for (const char* name : {"projected_coordinate_system", "wgs84"})
    if (!file.hasVariable(variable)) variable = name;
  if (file.hasVariable(variable)) {
    for (const char* name : {"EPSG_code", "crs_wkt", "spatial_ref", "wkt"}) {
      const std::string text = file.text(variable, name);
      if (!text.empty() && text != kNoCode) return crsOf(file, variable, text);
    }
    const double epsg = file.number(variable, "epsg").value_or(0.0);
    if (epsg > 0.0 && epsg < 1e9) return crsOf(file, variable, "EPSG:" + std::to_string(std::lround(epsg)));
  }
  const bool longitudes = file.text(x, "standard_name") == "longitude" || file.text(x, "units").starts_with("degree");
  return longitudes ? wgs84() : Crs{};
}

// The number of the first node. Files of FVCOM count from 1 without saying so: then no entry is 0, and one may be the
// number of nodes.
std::int64_t startIndex(const NetcdfReader& file, const std::string& variable, std::span<const std::int64_t> values,
                        std::size_t nodes) {
  if (const auto said = file.number(variable, "start_index")) return std::llround(*said);
  const auto isLast = [&](std::int64_t value) { return std::cmp_equal(value, nodes); };
  return std::ranges::none_of(values, [](std::int64_t value) { return value == 0; }) &&
                 std::ranges::any_of(values, isLast)
             ? 1
             : 0;
}

// Rows of node indices; kNone for the fill value. `columns` receives the length of a row.
std::vector<std::uint32_t> readConnectivity(const NetcdfReader& file, const std::string& variable, bool transposed,
                                            std::size_t nodes, std::size_t& columns) {
  const std::vector<std::size_t> shape = file.shape(variable);
  if (shape.size() != 2) file.fail("\"" + variable + "\" does not have two dimensions");
  const std::vector<std::int64_t> values = file.indices(variable);
  const std::size_t rows = shape[transposed ? 1 : 0];
  columns = shape[transposed ? 0 : 1];
  const std::int64_t start = startIndex(file, variable, values, nodes);
  std::vector<std::uint32_t> out;
  out.reserve(values.size());
  for (std::size_t r = 0; r < rows; ++r) {
    for (std::size_t c = 0; c < columns; ++c) {
      const std::int64_t value = values[transposed ? c * rows + r : r * columns + c];
      if (value == NetcdfReader::kMissing) {
        out.push_back(kNone);
        continue;
      }
      // Unsigned, since the difference of any two numbers fits.
      const std::uint64_t node = static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(start);
      if (value < start || node >= nodes)
        file.fail("row " + std::to_string(r + 1) + " of \"" + variable + "\" names node " + std::to_string(value) +
                  ", which is not there");
      out.push_back(static_cast<std::uint32_t>(node));
    }
  }
  return out;
}

// What turns the file's coordinates into degrees, or into the unit of a CRS in metres.
double coordinateFactor(const NetcdfReader& file, const std::string& x, const Crs& crs) {
  const std::string units = file.text(x, "units");
  if (crs.geographic) return units.starts_with("radian") ? 180.0 / std::numbers::pi : 1.0;
  if (!crs.isPlane() && toOgr(crs).GetLinearUnits() != 1.0) return 1.0;
  return metresInUnit(units).value_or(1.0);
}

// In the CRS of the grid.
void readNodes(const NetcdfReader& file, const std::string& x_name, const std::string& y_name, Grid& grid) {
  std::vector<double> x = file.doubles(x_name), y = file.doubles(y_name);
  if (const double factor = coordinateFactor(file, x_name, grid.crs); factor != 1.0)
    for (std::vector<double>* const values : {&x, &y})
      for (double& value : *values) value *= factor;
  if (x.size() != y.size()) file.fail("\"" + x_name + "\" and \"" + y_name + "\" differ in length");
  grid.nodes.resize(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      file.fail("node " + std::to_string(i + 1) + " has no finite coordinates");
    grid.nodes[i] = {x[i], y[i]};
  }
}

// True if a column of the variable, not a row, is a face: by the face_dimension, or if there is none, by three or four
// rows, as in the output of FVCOM.
bool isTransposed(const NetcdfReader& file, const std::string& variable, const std::string& face_dimension) {
  const std::vector<std::string> dimensions = file.dimensionsOf(variable);
  const std::vector<std::size_t> shape = file.shape(variable);
  if (shape.size() != 2) return false;
  if (!face_dimension.empty()) return dimensions[0] != face_dimension && dimensions[1] == face_dimension;
  return (shape[0] == 3 || shape[0] == 4) && shape[1] > 4;
}

void readFaces(const NetcdfReader& file, const std::string& mesh, Grid& grid) {
  const std::string variable = file.text(mesh, "face_node_connectivity");
  if (!file.hasVariable(variable)) file.fail("\"" + mesh + "\" names no face_node_connectivity");
  const bool transposed = isTransposed(file, variable, file.text(mesh, "face_dimension"));
  std::size_t columns = 0;
  const std::vector<std::uint32_t> rows = readConnectivity(file, variable, transposed, grid.nodes.size(), columns);
  if (columns < 3) file.fail("\"" + variable + "\" has fewer than three nodes a face");
  for (std::size_t at = 0; at < rows.size(); at += columns) {
    const auto isThere = [](std::uint32_t node) { return node != kNone; };
    const auto row = std::span(rows).subspan(at, columns);
    const auto corners = static_cast<std::size_t>(std::ranges::count_if(row, isThere));
    if (corners < 3 || corners > 4 || !std::ranges::all_of(row.first(corners), isThere))
      file.fail("face " + std::to_string(at / columns + 1) + " has " + std::to_string(corners) +
                " nodes; only triangles and quadrilaterals can be read");
    addElement(grid, row.first(corners));
  }
}

struct DepthVariable {
  std::string name;
  bool down = false;      // depths, positive down; else elevations
  std::size_t times = 0;  // for which it has values; 0 if they are of no time
};

constexpr std::array kAltitudes{"altitude"sv, "surface_altitude"sv, "bedrock_altitude"sv};
constexpr std::array kDepths{"depth"sv, "depth_below_geoid"sv};  // and any that starts with sea_floor_depth

// In lower case, without the name of the mesh in front.
std::string bareName(const std::string& name, const std::string& mesh) {
  return lowerCase(name.starts_with(mesh + "_") ? name.substr(mesh.size() + 1) : name);
}

// In output of models these names mean the surface of the water if their values change.
constexpr std::array kOfSurface{"elevation"sv, "z"sv, "h"sv};

enum class Rank { Altitude, Depth, ElevationName, DepthName, None };

Rank rankOf(const NetcdfReader& file, const std::string& name, const std::string& mesh) {
  std::string standard = file.text(name, "standard_name");
  std::ranges::replace(standard, ' ', '_');  // as ADCIRC writes it
  if (std::ranges::count(kAltitudes, standard) > 0) return Rank::Altitude;
  if (standard.starts_with("sea_floor_depth") || std::ranges::count(kDepths, standard) > 0) return Rank::Depth;
  if (!standard.empty()) return Rank::None;
  const DepthName known = depthNameOf(bareName(name, mesh));
  if (known == DepthName::None) return Rank::None;
  return known == DepthName::Elevation ? Rank::ElevationName : Rank::DepthName;
}

// True for the dimension of times: by its name, or by its variable's unit, such as "hours since 2000-01-01".
bool isTime(const NetcdfReader& file, const std::string& dimension) {
  const std::string name = lowerCase(dimension);
  return name == "time" || name.ends_with("_time") ||
         (file.hasVariable(dimension) && file.text(dimension, "units").find(" since ") != std::string::npos);
}

// For how many times a variable has a value at each of the places of `at`: 0 if they are of no time, nullopt if the
// variable has other dimensions, of layers for example, or no time at all.
std::optional<std::size_t> timesOf(const NetcdfReader& file, const std::string& name, const std::string& at) {
  std::vector<std::string> dimensions = file.dimensionsOf(name);
  std::vector<std::size_t> shape = file.shape(name);
  std::size_t times = 0;
  if (dimensions.size() == 2 && (shape.front() == 1 || isTime(file, dimensions.front()))) {
    times = shape.front();
    if (times == 0) return std::nullopt;
    dimensions.erase(dimensions.begin());
    shape.erase(shape.begin());
  }
  if (dimensions != file.dimensionsOf(at) || shape != file.shape(at)) return std::nullopt;  // a name may be repeated
  return times;
}

// The variables with depths or elevations of the bed at the nodes, the most reliable first: those of no time before
// those of several; of these with the standard_name of an altitude, then with that of a depth of the sea floor, then
// with no standard_name but a name that models use (FVCOM's `h`, SCHISM's `depth`, D-Flow FM's `mesh2d_node_z`). For
// the direction, an attribute `positive` takes precedence over names. What is in no unit of length is no depth.
std::vector<DepthVariable> depthVariables(const NetcdfReader& file, const std::string& mesh, const std::string& x) {
  std::vector<std::pair<Rank, DepthVariable>> found;
  const auto isOrUnsaid = [&](const std::string& name, const char* attribute, const std::string& value) {
    const std::string said = file.text(name, attribute);
    return said.empty() || said == value;
  };
  for (const std::string& name : file.variables()) {
    const std::optional<std::size_t> times = timesOf(file, name, x);
    if (!times) continue;
    if (!isOrUnsaid(name, "mesh", mesh) || !isOrUnsaid(name, "location", "node")) continue;
    if (!file.text(name, "nodal_attribute").empty()) continue;
    const Rank rank = rankOf(file, name, mesh);
    if (rank == Rank::None || !metresInUnit(file.text(name, "units"))) continue;
    const bool by_name = rank == Rank::ElevationName || rank == Rank::DepthName;
    if (*times > 0 && by_name && std::ranges::count(kOfSurface, bareName(name, mesh)) > 0) continue;
    const bool depth = rank == Rank::Depth || rank == Rank::DepthName;
    const std::string positive = file.text(name, "positive");
    found.push_back({rank, {name, positive.empty() ? depth : positive == "down", *times}});
  }
  std::ranges::stable_sort(found, {}, [](const auto& of) { return std::pair(of.second.times > 0, of.first); });
  std::vector<DepthVariable> variables;
  for (auto& [rank, variable] : found) variables.push_back(std::move(variable));
  return variables;
}

// The most reliable variable with depths or elevations of the bed on the faces, in quotes; empty if there is none.
std::string depthsOnFaces(const NetcdfReader& file, const std::string& mesh) {
  const std::string faces = file.text(mesh, "face_node_connectivity");
  if (!file.hasVariable(faces)) return {};
  const bool transposed = isTransposed(file, faces, file.text(mesh, "face_dimension"));
  const std::vector<std::string> of_faces = file.dimensionsOf(faces);
  if (of_faces.size() != 2) return {};
  std::string found;
  std::pair best{true, Rank::None};  // of several times, rank
  for (const std::string& name : file.variables()) {
    const std::vector<std::string> dimensions = file.dimensionsOf(name);
    if (dimensions.empty() || dimensions.back() != of_faces[transposed ? 1 : 0]) continue;
    const bool of_times = dimensions.size() == 2 && isTime(file, dimensions.front());
    if (dimensions.size() != 1 && !of_times) continue;
    const Rank rank = rankOf(file, name, mesh);
    const bool by_name = rank == Rank::ElevationName || rank == Rank::DepthName;
    if (rank == Rank::None || (of_times && by_name) || !metresInUnit(file.text(name, "units"))) continue;
    if (const std::pair here{of_times, rank}; here < best) {
      best = here;
      found = '"' + name + '"';
    }
  }
  return found;
}

void readElevation(const NetcdfReader& file, const std::string& mesh, const std::string& x, Grid& grid) {
  const std::vector<DepthVariable> known = depthVariables(file, mesh, x);
  if (known.empty()) return;
  const auto& [name, down, times] = known.front();
  grid.z = file.knownDoubles(name, times > 0 ? std::optional<std::size_t>(0) : std::nullopt);
  const double metres = *metresInUnit(file.text(name, "units"));
  const bool computed = metres != 1.0 || file.number(name, "scale_factor") || file.number(name, "add_offset");
  for (double& z : grid.z) {
    if (down) z = 0.0 - z;
    if (computed) z = roundedDepth(z * metres);
  }
}

// Nodal attributes as we write them.
void readFields(const NetcdfReader& file, Grid& grid) {
  for (const std::string& variable : file.variables()) {
    NodeField field{file.text(variable, "nodal_attribute"), file.text(variable, "units")};
    if (field.name.empty() || file.shape(variable) != std::vector{grid.nodes.size()}) continue;
    const double component = file.number(variable, "nodal_attribute_value").value_or(0.0);
    if (!(component >= 0.0 && component <= 1000.0)) file.fail("\"" + variable + "\" is no value of an attribute");
    field.component = static_cast<std::uint32_t>(component);
    if (findField(grid, field.name, field.component) != nullptr)
      file.fail("\"" + variable + "\" is the attribute " + titleOf(field) + " once more");
    field.usual = file.number(variable, "nodal_attribute_default").value_or(field.usual);
    field.values = file.knownDoubles(variable);
    grid.node_fields.push_back(std::move(field));
  }
}

std::vector<double> readFaceData(const NetcdfReader& file, const std::string& name, std::size_t faces) {
  if (!file.hasVariable(name) || file.shape(name) != std::vector{faces}) return {};
  return file.doubles(name);
}

// Gives features their names and sources. `fids`: of each face, if the features have their numbers as fids; else empty.
void nameFeatures(const NetcdfReader& file, const std::string& mesh, const std::vector<double>& fids, Grid& grid) {
  if (fids.empty()) return;
  const auto textsOf = [&](const std::string& name) {
    return file.hasVariable(mesh + name) ? file.texts(mesh + name) : std::vector<std::string>();
  };
  const std::vector<std::string> names = textsOf("_feature_name"), sources = textsOf("_feature_source");
  for (GridFeature& feature : grid.features) {
    const auto at = static_cast<std::size_t>(std::max<std::int64_t>(0, feature.fid - 1));
    if (at < names.size() && !names[at].empty()) feature.attributes.emplace_back("name", names[at]);
    if (at < sources.size()) feature.source = sources[at];
  }
  constexpr double kExact = 9007199254740992.0;  // 2^53
  for (std::size_t face = 0; face < grid.feature_of.size(); ++face)
    if (std::abs(fids[face]) <= kExact) grid.features[grid.feature_of[face]].fid = std::llround(fids[face]);
}

void readFaceArrays(const NetcdfReader& file, const std::string& mesh, Grid& grid) {
  const Elements elements(grid);
  const std::size_t faces = elements.size();
  const auto readInto = [&](BulkList<double>& values, const char* name) {
    const std::vector<double> read = readFaceData(file, mesh + name, faces);
    values.assign(read.begin(), read.end());
  };
  readInto(grid.min_angle_deg, "_min_angle");
  readInto(grid.area_m2, "_area");
  const std::string region_name = mesh + "_region_name";
  const std::vector<double> fids = readFaceData(file, mesh + "_feature", faces);
  const std::vector<double> numbers = readFaceData(file, mesh + "_feature_number", faces);
  addFeatures(numbers.empty() ? fids : numbers,
              file.hasVariable(region_name) ? readFaceData(file, mesh + "_region", faces) : std::vector<double>(),
              file.hasVariable(region_name) ? file.texts(region_name) : std::vector<std::string>(), grid);
  nameFeatures(file, mesh, numbers.empty() ? std::vector<double>() : fids, grid);
  for (const double piece : readFaceData(file, mesh + "_piece", faces))
    grid.piece_of.push_back(piece >= 1.0 ? static_cast<std::uint32_t>(std::min(piece, 4e9)) - 1 : 0);
  for (const double part : readFaceData(file, mesh + "_partition", faces))
    grid.part_of.push_back(part >= 0.0 ? static_cast<std::uint32_t>(std::min(part, 4e9)) : 0);
  giveToHalves(elements, grid);
}

void readBoundaries(const NetcdfReader& file, const std::string& mesh, Grid& grid) {
  const std::string variable = file.text(mesh, "boundary_node_connectivity");
  const std::string number_name = mesh + "_boundary_number", role_name = mesh + "_boundary_role";
  if (!file.hasVariable(variable) || !file.hasVariable(number_name) || !file.hasVariable(role_name)) return;
  std::size_t columns = 0;
  const std::vector<std::uint32_t> nodes = readConnectivity(file, variable, false, grid.nodes.size(), columns);
  const std::vector<std::int64_t> number = file.integers(number_name), role = file.integers(role_name);
  if (columns != 2 || std::ranges::find(nodes, kNone) != nodes.end() || 2 * number.size() != nodes.size() ||
      role.size() != number.size())
    file.fail("\"" + variable + "\", \"" + number_name + "\" and \"" + role_name + "\" do not go together");
  const std::string type_name = mesh + "_boundary_ibtype";
  const std::vector<std::int64_t> type =
      file.hasVariable(type_name) ? file.integers(type_name) : std::vector<std::int64_t>(number.size(), -1);
  if (type.size() != number.size()) file.fail("\"" + type_name + "\" has another length than \"" + number_name + "\"");
  const std::string names_name = mesh + "_boundary_name";
  const std::vector<std::string> names =
      file.hasVariable(names_name) ? file.texts(names_name) : std::vector<std::string>();
  std::vector<std::vector<NodePair>> groups;
  std::vector<std::string> name_of;
  std::vector<BoundaryRole> roles;
  std::vector<int> types;
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (e == 0 || number[e] != number[e - 1]) {
      if (role[e] < 0 || role[e] >= static_cast<std::int64_t>(kBoundaryRoles.size()))
        file.fail("\"" + role_name + "\" holds " + std::to_string(role[e]));
      groups.emplace_back();
      name_of.push_back(number[e] >= 1 && number[e] <= std::ssize(names)
                            ? names[static_cast<std::size_t>(number[e]) - 1]
                            : std::string());
      roles.push_back(static_cast<BoundaryRole>(role[e]));
      types.push_back(static_cast<int>(std::clamp<std::int64_t>(type[e], -1, 1000)));
    }
    groups.back().push_back({nodes[2 * e], nodes[2 * e + 1]});
  }
  keepBoundaryEdges(grid.triangles, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Boundary& chain : chainEdges(groups[g])) {
      chain.role = roles[g];
      chain.ibtype = types[g];
      chain.name = name_of[g];
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

void readLines(const NetcdfReader& file, const std::string& mesh, Grid& grid) {
  const std::string number_name = mesh + "_edge_line", kind_name = mesh + "_line_kind", names = mesh + "_line_name";
  const std::string edges_name = file.text(mesh, "edge_node_connectivity");
  for (const std::string& needed : {number_name, kind_name, names, edges_name})
    if (!file.hasVariable(needed)) return;
  std::size_t columns = 0;
  const std::vector<std::uint32_t> nodes = readConnectivity(file, edges_name, false, grid.nodes.size(), columns);
  const std::vector<std::int64_t> number = file.integers(number_name), kind = file.integers(kind_name);
  const std::vector<std::string> name = file.texts(names);
  if (columns != 2 || 2 * number.size() != nodes.size() || name.size() != kind.size())
    file.fail("\"" + number_name + "\", \"" + kind_name + "\" and \"" + names + "\" do not go together");
  std::vector<std::vector<NodePair>> edges_of(kind.size());
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (number[e] < 1) continue;
    if (static_cast<std::uint64_t>(number[e]) > kind.size() || nodes[2 * e] == kNone || nodes[2 * e + 1] == kNone)
      file.fail("edge " + std::to_string(e + 1) + " names line " + std::to_string(number[e]) + ", which is not there");
    edges_of[static_cast<std::size_t>(number[e]) - 1].push_back({nodes[2 * e], nodes[2 * e + 1]});
  }
  for (std::size_t i = 0; i < kind.size(); ++i) {
    if (kind[i] < 0 || kind[i] >= static_cast<std::int64_t>(kLineKinds.size()))
      file.fail("\"" + kind_name + "\" holds " + std::to_string(kind[i]));
    std::ranges::move(chainLines(std::move(edges_of[i]), static_cast<LineKind>(kind[i]), name[i]),
                      std::back_inserter(grid.lines));
  }
}

}  // namespace

std::string depthRemark(const std::string& path) {
  const NetcdfReader file(path);
  const std::string mesh = findMesh(file);
  const std::vector<DepthVariable> known = depthVariables(file, mesh, coordinateNames(file, mesh).first);
  if (known.empty()) {
    const std::string faces = depthsOnFaces(file, mesh);
    return faces.empty() ? faces
                         : "'" + path + "': it has depths on faces, " + faces +
                               ", and none at nodes: the mesh has no depths; interpolate them to the nodes, or give a "
                               "raster with --bathymetry";
  }
  if (known.size() == 1 && known.front().times < 2) return {};
  std::string text = "'" + path + "': depths are taken from \"" + known.front().name + '"';
  if (known.front().times > 1) text += " at the first of its " + std::to_string(known.front().times) + " times";
  for (std::size_t i = 1; i < known.size(); ++i) text += (i > 1 ? ", \"" : ", not from \"") + known[i].name + '"';
  return text;
}

Grid readUgrid(const std::string& path, const Crs& unsaid) {
  const NetcdfReader file(path);
  const std::string mesh = findMesh(file);
  Grid grid;
  grid.title = file.globalText("title");
  const auto [x, y] = coordinateNames(file, mesh);
  grid.crs = readCrs(file, x);
  if (grid.crs.isPlane()) grid.crs = unsaid;
  readNodes(file, x, y, grid);
  readFaces(file, mesh, grid);
  readElevation(file, mesh, x, grid);
  if (const std::string name = mesh + "_node_size";
      file.hasVariable(name) && file.shape(name) == std::vector{grid.nodes.size()})
    grid.size_m = file.doubles(name);
  readFields(file, grid);
  readFaceArrays(file, mesh, grid);
  readBoundaries(file, mesh, grid);
  readLines(file, mesh, grid);
  return grid;
}

}  // namespace coastmesh
