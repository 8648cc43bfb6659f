#include "gis/write_2dm.hpp"

#include "gis/boundary_chains.hpp"
#include "gis/grid_formats.hpp"
#include "gis/grid_lines.hpp"
#include "gis/grid_names.hpp"
#include "gis/prj_file.hpp"
#include "gis/read_2dm.hpp"
#include "gis/text_writer.hpp"

namespace coastmesh {
namespace {

constexpr std::size_t kNodesPerLine = 10;

void writeNodeString(TextWriter& file, std::vector<std::uint32_t> nodes, bool closed, std::int64_t id) {
  if (closed) nodes.push_back(nodes.front());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % kNodesPerLine == 0) file << (i == 0 ? "NS" : "\nNS");
    file << (i + 1 == nodes.size() ? " -" : " ") << nodes[i] + 1;
  }
  file << ' ' << id << '\n';
}

// Whether the numbers of materials say all that is known of features.
bool numbersSayAll(const Grid& grid) {
  for (std::size_t f = 0; f < grid.features.size(); ++f)
    if (grid.features[f].fid != static_cast<std::int64_t>(f) + 1 || !grid.features[f].region.empty()) return false;
  return true;
}

// SMS has the names of materials among the assignments of its models.
void writeMaterialNames(TextWriter& file, const Grid& grid) {
  if (grid.feature_of.empty() || numbersSayAll(grid)) return;
  const std::vector<std::string> labels = featureLabels(grid);
  file << "BEG2DMBC\n";
  for (std::size_t f = 0; f < labels.size(); ++f) file << "MAT " << f + 1 << " \"" << labels[f] << "\"\n";
  file << "END2DMBC\n";
}

}  // namespace

void write2dm(const Grid& grid, const std::string& path) {
  requireZ(grid, path);
  TextWriter file(path);
  file << "MESH2D\n";
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    const std::uint32_t material = grid.feature_of.empty() ? 1 : grid.feature_of[t] + 1;
    file << "E3T " << t + 1 << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1 << ' ' << material << '\n';
  }
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    file << "ND " << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' '
         << (grid.z.empty() ? 0.0 : grid.z[i]) << '\n';
  }
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b) {
    const Boundary& boundary = grid.boundaries[b];
    writeNodeString(file, boundary.nodes, boundary.closed, boundaryMarker(b, boundary.role));
  }
  for (std::size_t i = 0; i < grid.lines.size(); ++i) {
    const GridLine& line = grid.lines[i];
    writeNodeString(file, line.nodes, line.closed, lineMarker(grid.boundaries.size() + i, line.kind));
  }
  writeMaterialNames(file, grid);
  file.close();
  writePrjBeside(path, grid.crs);
}

FormatRecord sms2dmFormat() {
  return {{"2dm",
           {".2dm"},
           "SMS 2dm for QGIS and TUFLOW, z positive up",
           true,
           true,
           {GridPart::Features, GridPart::Regions, GridPart::Lines, GridPart::Rivers}},
          {write2dm, read2dm, withPrjBeside}};
}

}  // namespace coastmesh
