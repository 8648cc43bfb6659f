#include "gis/write_vtu.hpp"

#include <bit>
#include <cstdint>

#include "gis/grid_formats.hpp"
#include "gis/prj_file.hpp"
#include "gis/read_vtu.hpp"
#include "gis/text_writer.hpp"

namespace coastmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says LittleEndian");

constexpr std::uint8_t kVtkTriangle = 5;

// The blocks of the appended section: each is its length in bytes, then its bytes.
class Appendix {
 public:
  explicit Appendix(TextWriter& file) : file_(file) {}

  // `tuples`: of an array that belongs to neither nodes nor cells.
  void declare(const char* type, const std::string& name, int components, std::uint64_t bytes,
               std::uint64_t tuples = 0) {
    file_ << R"(<DataArray type=")" << type << R"(" Name=")" << name << '"';
    if (tuples > 0) file_ << R"( NumberOfTuples=")" << tuples << '"';
    if (components > 1) file_ << R"( NumberOfComponents=")" << components << '"';
    file_ << R"( format="appended" offset=")" << offset_ << "\"/>\n";
    offset_ += sizeof(bytes) + bytes;
  }

  template <typename T>
  void write(const std::vector<T>& values) {
    const std::uint64_t bytes = values.size() * sizeof(T);
    file_.raw(&bytes, sizeof(bytes));
    file_.raw(values.data(), bytes);
  }

 private:
  TextWriter& file_;
  std::uint64_t offset_ = 0;
};

// The boundaries' nodes one after another, where each ends among them, and its role as in BoundaryRole.
struct BoundaryArrays {
  std::vector<std::int64_t> nodes, ends;
  std::vector<std::uint8_t> roles, closed;
};

BoundaryArrays boundaryArrays(const Grid& grid) {
  BoundaryArrays arrays;
  for (const Boundary& boundary : grid.boundaries) {
    arrays.nodes.insert(arrays.nodes.end(), boundary.nodes.begin(), boundary.nodes.end());
    arrays.ends.push_back(static_cast<std::int64_t>(arrays.nodes.size()));
    arrays.roles.push_back(static_cast<std::uint8_t>(boundary.role));
    arrays.closed.push_back(boundary.closed ? 1 : 0);
  }
  return arrays;
}

}  // namespace

void writeVtu(const Grid& grid, const std::string& path) {
  const std::uint64_t nodes = grid.nodes.size(), cells = grid.triangles.size();
  TextWriter file(path);
  Appendix appendix(file);
  file << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  const BoundaryArrays boundaries = boundaryArrays(grid);
  if (!boundaries.ends.empty()) {
    const std::uint64_t count = boundaries.ends.size(), length = boundaries.nodes.size();
    file << "<FieldData>\n";
    appendix.declare("Int64", "boundary_nodes", 1, length * 8, length);
    appendix.declare("Int64", "boundary_ends", 1, count * 8, count);
    appendix.declare("UInt8", "boundary_roles", 1, count, count);
    appendix.declare("UInt8", "boundary_closed", 1, count, count);
    file << "</FieldData>\n";
  }
  file << "<Piece NumberOfPoints=\"" << nodes << "\" NumberOfCells=\"" << cells << "\">\n";
  file << "<Points>\n";
  appendix.declare("Float64", "Points", 3, nodes * 24);
  file << "</Points>\n<Cells>\n";
  appendix.declare("Int64", "connectivity", 1, cells * 24);
  appendix.declare("Int64", "offsets", 1, cells * 8);
  appendix.declare("UInt8", "types", 1, cells);
  file << "</Cells>\n<PointData>\n";
  if (!grid.z.empty()) appendix.declare("Float64", "z", 1, nodes * 8);
  file << "</PointData>\n<CellData>\n";
  if (!grid.min_angle_deg.empty()) appendix.declare("Float64", "min_angle", 1, cells * 8);
  if (!grid.area_m2.empty()) appendix.declare("Float64", "area_m2", 1, cells * 8);
  if (!grid.feature_of.empty()) appendix.declare("Int64", "src_fid", 1, cells * 8);
  file << "</CellData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";

  if (!boundaries.ends.empty()) {
    appendix.write(boundaries.nodes);
    appendix.write(boundaries.ends);
    appendix.write(boundaries.roles);
    appendix.write(boundaries.closed);
  }
  std::vector<double> places;
  places.reserve(3 * nodes);
  for (const Point& p : grid.nodes) places.insert(places.end(), {p.x, p.y, 0.0});
  appendix.write(places);
  std::vector<std::int64_t> connectivity, offsets, fids;
  connectivity.reserve(3 * cells);
  offsets.reserve(cells);
  for (const auto& corners : grid.triangles) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  appendix.write(connectivity);
  appendix.write(offsets);
  appendix.write(std::vector<std::uint8_t>(cells, kVtkTriangle));
  if (!grid.z.empty()) appendix.write(grid.z);
  if (!grid.min_angle_deg.empty()) appendix.write(grid.min_angle_deg);
  if (!grid.area_m2.empty()) appendix.write(grid.area_m2);
  if (!grid.feature_of.empty()) {
    for (const std::uint32_t feature : grid.feature_of) fids.push_back(grid.features[feature].fid);
    appendix.write(fids);
  }
  file << "\n</AppendedData>\n</VTKFile>\n";
  file.close();
  writePrjBeside(path, grid.crs);
}

FormatRecord vtuFormat() {
  return {{"vtu", {".vtu"}, "VTK unstructured grid for ParaView", true, true}, {writeVtu, readVtu, withPrjBeside}};
}

}  // namespace coastmesh
