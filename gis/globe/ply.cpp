#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

constexpr double kRadiusM = 6371220.0;

// PLY as text, for viewers of shapes: a geographic mesh on a sphere, in metres from its centre, with unchanged
// latitudes; other meshes with z as the third coordinate, 0 if there is none. The format holds nothing else. Throws
// OutputError, also if some z are unknown.
void writePly(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  TextWriter file(path);
  file << "ply\nformat ascii 1.0\ncomment written by coastmesh\nelement vertex " << grid.nodes.size()
       << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << grid.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    const Point& node = grid.nodes[i];
    const SphereVector place = grid.crs.geographic ? scaled(onSphere(asLonLat(node)), kRadiusM)
                                                   : SphereVector{node.x, node.y, grid.z.empty() ? 0.0 : grid.z[i]};
    text << place[0] << ' ' << place[1] << ' ' << place[2] << '\n';
  });
  file.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << "3 " << a << ' ' << b << ' ' << c << '\n';
  });
  file.close();
}

}  // namespace

FormatRecord plyFormat() {
  return {{.name = "ply",
           .endings = {".ply"},
           .description = "PLY, for viewers of shapes: longitudes and latitudes as a globe",
           .writable = true,
           .needs_depths = true,
           .places = NodePlaces::Sphere},
          {writePly, nullptr, nullptr}};
}

}  // namespace coastmesh
