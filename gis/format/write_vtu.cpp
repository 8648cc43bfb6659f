#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>

#include "gis/elements/elements.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/format/read_vtu.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

constexpr std::uint8_t kVtkTriangle = 5, kVtkQuad = 9;

// The blocks of the appended section: for each array its length in bytes, then its bytes.
class Appendix {
 public:
  explicit Appendix(TextWriter& file) : file_(file) {}

  // `tuples`: the number of values of an array that belongs to neither nodes nor cells; else 0.
  void declare(const char* type, const std::string& name, int components, std::uint64_t bytes,
               std::uint64_t tuples = 0) {
    file_ << R"(<DataArray type=")" << type << R"(" Name=")" << name << '"';
    if (tuples > 0) file_ << R"( NumberOfTuples=")" << tuples << '"';
    if (components > 1) file_ << R"( NumberOfComponents=")" << components << '"';
    file_ << R"( format="appended" offset=")" << offset_ << "\"/>\n";
    offset_ += sizeof(bytes) + bytes;
  }

  template <typename T, typename Allocator>
  void write(const std::vector<T, Allocator>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    file_.raw(&bytes, sizeof(bytes));
    file_.raw(values.data(), bytes);
  }

  // Writes `value(i)` for every i below `count`: numbers or arrays of numbers, made by the threads of `loop`.
  template <typename Value>
  void write(const ItemLoop& loop, std::size_t count, const Value& value) {
    const std::uint64_t bytes = count * sizeof(value(std::size_t{0}));
    file_.raw(&bytes, sizeof(bytes));
    file_.rows(loop, count, [&value](TextBlock& block, std::size_t i) {
      const auto one = value(i);
      block.raw(&one, sizeof(one));
    });
  }

 private:
  TextWriter& file_;
  std::uint64_t offset_ = 0;
};

// The nodes of boundaries or lines one after another, the end of each among them, and its role or kind as in the enum.
struct ChainArrays {
  std::vector<std::int64_t> nodes, ends;
  std::vector<std::uint8_t> kinds, closed;

  template <typename Chain, typename Kind>
  void add(const Chain& chain, Kind kind) {
    nodes.insert(nodes.end(), chain.nodes.begin(), chain.nodes.end());
    ends.push_back(static_cast<std::int64_t>(nodes.size()));
    kinds.push_back(static_cast<std::uint8_t>(kind));
    closed.push_back(chain.closed ? 1 : 0);
  }

  void declare(Appendix& appendix, const std::string& of, const std::string& what) const {
    const std::uint64_t count = ends.size(), length = nodes.size();
    appendix.declare("Int64", of + "_nodes", 1, length * 8, length);
    appendix.declare("Int64", of + "_ends", 1, count * 8, count);
    appendix.declare("UInt8", of + '_' + what, 1, count, count);
    appendix.declare("UInt8", of + "_closed", 1, count, count);
  }

  void write(Appendix& appendix) const {
    appendix.write(nodes);
    appendix.write(ends);
    appendix.write(kinds);
    appendix.write(closed);
  }
};

// Arrays that belong to neither nodes nor cells. Texts are bytes, each ended by a zero, since many readers support only
// numbers and reject arrays of texts.
struct FieldArrays {
  ChainArrays boundaries, lines;
  std::vector<std::int64_t> ibtypes;
  std::vector<std::uint8_t> boundary_names, line_names, region_names;

  FieldArrays(const Grid& grid, const std::vector<std::string>& regions) {
    for (const Boundary& boundary : grid.boundaries) {
      boundaries.add(boundary, boundary.role);
      ibtypes.push_back(boundary.ibtype);
      addText(boundary.name, boundary_names);
    }
    if (boundary_names.size() == grid.boundaries.size()) boundary_names.clear();  // all are empty
    if (std::ranges::none_of(ibtypes, [](std::int64_t type) { return type >= 0; })) ibtypes.clear();
    for (const GridLine& line : grid.lines) {
      lines.add(line, line.kind);
      addText(line.name, line_names);
    }
    for (const std::string& region : regions) addText(region, region_names);
  }

  bool any() const { return !boundaries.ends.empty() || !lines.ends.empty() || !region_names.empty(); }

  void declare(Appendix& appendix) const {
    if (!boundaries.ends.empty()) boundaries.declare(appendix, "boundary", "roles");
    if (!ibtypes.empty()) appendix.declare("Int64", "boundary_ibtypes", 1, ibtypes.size() * 8, ibtypes.size());
    if (!boundary_names.empty())
      appendix.declare("UInt8", "boundary_names", 1, boundary_names.size(), boundary_names.size());
    if (!lines.ends.empty()) lines.declare(appendix, "line", "kinds");
    if (!line_names.empty()) appendix.declare("UInt8", "line_names", 1, line_names.size(), line_names.size());
    if (!region_names.empty()) appendix.declare("UInt8", "region_names", 1, region_names.size(), region_names.size());
  }

  void write(Appendix& appendix) const {
    if (!boundaries.ends.empty()) boundaries.write(appendix);
    if (!ibtypes.empty()) appendix.write(ibtypes);
    if (!boundary_names.empty()) appendix.write(boundary_names);
    if (!lines.ends.empty()) lines.write(appendix);
    if (!line_names.empty()) appendix.write(line_names);
    if (!region_names.empty()) appendix.write(region_names);
  }

 private:
  static void addText(const std::string& text, std::vector<std::uint8_t>& bytes) {
    bytes.insert(bytes.end(), text.begin(), text.end());
    bytes.push_back(0);
  }
};

// Where nodes lie in space, and their longitudes and latitudes if these are not the first two coordinates.
struct VtuPlaces {
  std::function<std::array<double, 3>(std::size_t node)> place;
  std::function<LonLat(std::size_t node)> geographic;  // null: as in `place`
};

// The arrays of cells: their nodes, the end of each among them, and their types.
void writeCells(const Grid& grid, const Elements& elements, const ItemLoop& loop, Appendix& appendix) {
  const std::size_t cells = elements.size();
  if (elements.quads() == 0) {
    appendix.write(loop, cells, [&](std::size_t t) {
      const auto& [a, b, c] = grid.triangles[t];
      return std::array<std::int64_t, 3>{a, b, c};
    });
    appendix.write(loop, cells, [](std::size_t t) { return 3 * (static_cast<std::int64_t>(t) + 1); });
    appendix.write(loop, cells, [](std::size_t) { return kVtkTriangle; });
    return;
  }
  std::vector<std::int64_t> nodes, ends;
  std::vector<std::uint8_t> types;
  for (std::size_t e = 0; e < cells; ++e) {
    const Elements::Nodes of_cell = elements.nodesOf(e);
    nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
    ends.push_back(static_cast<std::int64_t>(nodes.size()));
    types.push_back(of_cell.count == 4 ? kVtkQuad : kVtkTriangle);
  }
  appendix.write(nodes);
  appendix.write(ends);
  appendix.write(types);
}

void writeFile(const Grid& grid, const VtuPlaces& places, const std::string& path, const ItemLoop& loop) {
  const Elements elements(grid);
  const std::uint64_t nodes = grid.nodes.size(), cells = elements.size(), corners = 3 * cells + elements.quads();
  TextWriter file(path);
  Appendix appendix(file);
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  const std::vector<std::string> regions = grid.feature_of.empty() ? std::vector<std::string>() : regionNames(grid);
  const FieldArrays fields(grid, regions);
  if (fields.any()) {
    file << "<FieldData>\n";
    fields.declare(appendix);
    file << "</FieldData>\n";
  }
  file << "<Piece NumberOfPoints=\"" << nodes << "\" NumberOfCells=\"" << cells << "\">\n";
  file << "<Points>\n";
  appendix.declare("Float64", "Points", 3, nodes * 24);
  file << "</Points>\n<Cells>\n";
  appendix.declare("Int64", "connectivity", 1, corners * 8);
  appendix.declare("Int64", "offsets", 1, cells * 8);
  appendix.declare("UInt8", "types", 1, cells);
  file << "</Cells>\n<PointData>\n";
  if (!grid.z.empty()) appendix.declare("Float64", "z", 1, nodes * 8);
  for (const NodeField& field : grid.node_fields) appendix.declare("Float64", variableWordOf(field), 1, nodes * 8);
  if (places.geographic) {
    appendix.declare("Float64", kVtuLongitude, 1, nodes * 8);
    appendix.declare("Float64", kVtuLatitude, 1, nodes * 8);
  }
  file << "</PointData>\n<CellData>\n";
  if (!grid.min_angle_deg.empty()) appendix.declare("Float64", "min_angle", 1, cells * 8);
  if (!grid.area_m2.empty()) appendix.declare("Float64", "area_m2", 1, cells * 8);
  if (!grid.feature_of.empty()) appendix.declare("Int64", "src_fid", 1, cells * 8);
  if (!regions.empty()) appendix.declare("Int64", "region", 1, cells * 8);
  file << "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  fields.write(appendix);
  appendix.write(loop, nodes, places.place);
  writeCells(grid, elements, loop, appendix);
  if (!grid.z.empty()) appendix.write(grid.z);
  for (const NodeField& field : grid.node_fields) appendix.write(field.values);
  if (places.geographic) {
    appendix.write(loop, nodes, [&](std::size_t i) { return places.geographic(i).lon; });
    appendix.write(loop, nodes, [&](std::size_t i) { return places.geographic(i).lat; });
  }
  if (!grid.min_angle_deg.empty())
    appendix.write(loop, cells, [&](std::size_t e) { return grid.min_angle_deg[elements.triangleOf(e)]; });
  if (!grid.area_m2.empty())
    appendix.write(loop, cells, [&](std::size_t e) { return elements.sumOver(e, grid.area_m2); });
  const auto featureOf = [&](std::size_t e) { return grid.feature_of[elements.triangleOf(e)]; };
  if (!grid.feature_of.empty())
    appendix.write(loop, cells, [&](std::size_t e) { return std::int64_t{grid.features[featureOf(e)].fid}; });
  if (!regions.empty()) {
    const std::vector<int> numbers = regionNumbers(grid, regions);
    appendix.write(loop, cells, [&](std::size_t e) { return std::int64_t{numbers[featureOf(e)]}; });
  }
  file << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
}

// Writes VTK's unstructured grid, appended raw, for ParaView: nodes at the coordinates of the CRS, z and attributes as
// node data, smallest angle, area, source fid and region as cell data, boundaries, lines and names as field data. VTK
// cannot hold a CRS: it is written to a .prj. Throws OutputError.
void writeVtu(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const auto place = [&grid](std::size_t i) { return std::array<double, 3>{grid.nodes[i].x, grid.nodes[i].y, 0.0}; };
  writeFile(grid, {place, nullptr}, path, loop);
  writePrjBeside(path, grid.crs);
}

// The same on a globe: nodes in metres from the centre of a sphere, latitudes unchanged, with longitudes and latitudes
// of WGS 84 as node data. Throws OutputError, also for a mesh in a plane.
void writeVtuGlobe(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  constexpr double kRadiusM = 6371220.0;
  const std::vector<Point> nodes = requireGeographicNodes(grid, path, "a globe", loop);
  const auto place = [&nodes](std::size_t i) {
    std::array<double, 3> at = onSphere(asLonLat(nodes[i]));
    for (double& x : at) x *= kRadiusM;
    return at;
  };
  writeFile(grid, {place, [&nodes](std::size_t i) { return asLonLat(nodes[i]); }}, path, loop);
}

constexpr GridParts kParts{GridPart::NodeFields, GridPart::Quads,       GridPart::Features,     GridPart::Regions,
                           GridPart::Lines,      GridPart::LineNames,   GridPart::Rivers,       GridPart::Ibtypes,
                           GridPart::BareWeirs,  GridPart::PartIslands, GridPart::BoundaryNames};

}  // namespace

FormatRecord vtuGlobeFormat() {
  return {{.name = "vtu3d",
           .endings = {"_globe.vtu"},
           .description = "the same on a globe, in metres from its middle",
           .readable = true,
           .writable = true,
           .holds = kParts,
           .places = NodePlaces::Geographic},
          {writeVtuGlobe, readVtu, nullptr}};
}

FormatRecord vtuFormat() {
  return {{.name = "vtu",
           .endings = {".vtu"},
           .description = "VTK unstructured grid for ParaView",
           .readable = true,
           .writable = true,
           .holds = kParts,
           .places = NodePlaces::OneTurn},
          {writeVtu, readVtu, withPrjBeside}};
}

}  // namespace coastmesh
