#include "gis/write_gmsh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "gis/boundary_chains.hpp"
#include "gis/grid_formats.hpp"
#include "gis/prj_file.hpp"
#include "gis/read_gmsh.hpp"
#include "gis/text_writer.hpp"

namespace coastmesh {
namespace {

constexpr int kLine = 1, kTriangle = 2;  // element types

// Curves are tagged from 1 in the order of the boundaries, surfaces go on after them in the order of the features;
// physical groups have the tags of their entities.
struct Layout {
  std::size_t curves = 0;
  std::size_t surfaces = 1;
  std::vector<std::vector<NodePair>> lines;           // one a curve
  std::vector<std::vector<std::uint32_t>> triangles;  // one a surface
  std::size_t line_count = 0;

  std::size_t surfaceTag(std::size_t surface) const { return curves + surface + 1; }
};

std::size_t surfaceOf(const Grid& grid, std::size_t triangle) {
  return grid.feature_of.empty() ? 0 : grid.feature_of[triangle];
}

Layout layoutOf(const Grid& grid) {
  Layout layout;
  layout.curves = grid.boundaries.size();
  layout.surfaces = grid.feature_of.empty() ? 1 : grid.features.size();
  for (const Boundary& boundary : grid.boundaries) {
    layout.lines.push_back(edgesOf(boundary));
    layout.line_count += layout.lines.back().size();
  }
  layout.triangles.resize(layout.surfaces);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) layout.triangles[surfaceOf(grid, t)].push_back(t);
  return layout;
}

void writePhysicalNames(TextWriter& file, const Grid& grid, const Layout& layout) {
  file << "$PhysicalNames\n" << layout.curves + layout.surfaces << '\n';
  for (std::size_t c = 0; c < layout.curves; ++c)
    file << "1 " << c + 1 << " \"" << toString(grid.boundaries[c].role) << ' ' << c + 1 << "\"\n";
  std::map<std::int64_t, std::size_t> times;  // names have to differ where sources share a fid
  for (std::size_t s = 0; s < layout.surfaces; ++s) {
    file << "2 " << layout.surfaceTag(s) << " \"";
    if (grid.feature_of.empty()) {
      file << "domain";
    } else {
      const std::int64_t fid = grid.features[s].fid;
      file << "feature " << fid;
      if (const std::size_t n = ++times[fid]; n > 1) file << " (" << n << ')';
    }
    file << "\"\n";
  }
  file << "$EndPhysicalNames\n";
}

void writeNodeData(TextWriter& file, const Grid& grid) {
  if (grid.z.empty()) return;
  const auto known = std::ranges::count_if(grid.z, [](double z) { return !std::isnan(z); });
  file << "$NodeData\n1\n\"z\"\n1\n0\n3\n0\n1\n" << known << '\n';
  for (std::size_t i = 0; i < grid.z.size(); ++i)
    if (!std::isnan(grid.z[i])) file << i + 1 << ' ' << grid.z[i] << '\n';
  file << "$EndNodeData\n";
}

struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(const Point& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

TextWriter& operator<<(TextWriter& file, const Box& box) {
  return file << box.low.x << ' ' << box.low.y << " 0 " << box.high.x << ' ' << box.high.y << " 0";
}

// The curves along each surface.
std::vector<std::set<std::size_t>> curvesAlong(const Grid& grid, const Layout& layout) {
  std::vector<std::set<std::size_t>> along(layout.surfaces);
  if (layout.surfaces == 1) {
    for (std::size_t c = 0; c < layout.curves; ++c) along[0].insert(c);
    return along;
  }
  std::vector<std::pair<NodePair, std::size_t>> curve_of;
  for (std::size_t c = 0; c < layout.curves; ++c)
    for (const NodePair& edge : layout.lines[c]) curve_of.emplace_back(edge, c);
  std::ranges::sort(curve_of);
  std::vector<bool> on_curve(grid.nodes.size(), false);
  for (const auto& [edge, c] : curve_of) on_curve[edge[0]] = on_curve[edge[1]] = true;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& v = grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const NodePair edge{v[i], v[next3(i)]};
      if (!on_curve[edge[0]] || !on_curve[edge[1]]) continue;
      const auto at = std::ranges::lower_bound(curve_of, edge, {}, &std::pair<NodePair, std::size_t>::first);
      if (at != curve_of.end() && at->first == edge) along[surfaceOf(grid, t)].insert(at->second);
    }
  }
  return along;
}

void writeEntities(TextWriter& file, const Grid& grid, const Layout& layout) {
  file << "$Entities\n0 " << layout.curves << ' ' << layout.surfaces << " 0\n";
  for (std::size_t c = 0; c < layout.curves; ++c) {
    Box box;
    for (std::uint32_t node : grid.boundaries[c].nodes) box.add(grid.nodes[node]);
    file << c + 1 << ' ' << box << " 1 " << c + 1 << " 0\n";
  }
  const std::vector<std::set<std::size_t>> along = curvesAlong(grid, layout);
  for (std::size_t s = 0; s < layout.surfaces; ++s) {
    Box box;
    for (std::uint32_t t : layout.triangles[s])
      for (std::uint32_t node : grid.triangles[t]) box.add(grid.nodes[node]);
    file << layout.surfaceTag(s) << ' ' << box << " 1 " << layout.surfaceTag(s) << ' ' << along[s].size();
    for (std::size_t c : along[s]) file << ' ' << c + 1;
    file << '\n';
  }
  file << "$EndEntities\n";
}

// Every node in the block of the first entity that it lies on, curves before surfaces.
void writeNodes(TextWriter& file, const Grid& grid, const Layout& layout) {
  std::vector<std::vector<std::uint32_t>> blocks(layout.curves + layout.surfaces);
  std::vector<bool> placed(grid.nodes.size(), false);
  const auto place = [&](std::size_t block, std::uint32_t node) {
    if (!placed[node]) blocks[block].push_back(node);
    placed[node] = true;
  };
  for (std::size_t c = 0; c < layout.curves; ++c)
    for (std::uint32_t node : grid.boundaries[c].nodes) place(c, node);
  for (std::size_t s = 0; s < layout.surfaces; ++s)
    for (std::uint32_t t : layout.triangles[s])
      for (std::uint32_t node : grid.triangles[t]) place(layout.curves + s, node);
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) place(layout.curves, node);
  const auto filled = std::ranges::count_if(blocks, [](const auto& block) { return !block.empty(); });
  file << "$Nodes\n" << filled << ' ' << grid.nodes.size() << " 1 " << grid.nodes.size() << '\n';
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].empty()) continue;
    std::ranges::sort(blocks[b]);
    file << (b < layout.curves ? 1 : 2) << ' ' << b + 1 << " 0 " << blocks[b].size() << '\n';
    for (std::uint32_t node : blocks[b]) file << node + 1 << '\n';
    for (std::uint32_t node : blocks[b]) file << grid.nodes[node].x << ' ' << grid.nodes[node].y << " 0\n";
  }
  file << "$EndNodes\n";
}

void writeElements(TextWriter& file, const Grid& grid, const Layout& layout) {
  const auto filled = [](const auto& groups) {
    return std::ranges::count_if(groups, [](const auto& group) { return !group.empty(); });
  };
  const std::size_t count = layout.line_count + grid.triangles.size();
  file << "$Elements\n" << filled(layout.lines) + filled(layout.triangles) << ' ' << count << " 1 " << count << '\n';
  std::size_t tag = 0;
  for (std::size_t c = 0; c < layout.curves; ++c) {
    if (layout.lines[c].empty()) continue;
    file << "1 " << c + 1 << ' ' << kLine << ' ' << layout.lines[c].size() << '\n';
    for (const auto& [from, to] : layout.lines[c]) file << ++tag << ' ' << from + 1 << ' ' << to + 1 << '\n';
  }
  for (std::size_t s = 0; s < layout.surfaces; ++s) {
    if (layout.triangles[s].empty()) continue;
    file << "2 " << layout.surfaceTag(s) << ' ' << kTriangle << ' ' << layout.triangles[s].size() << '\n';
    for (std::uint32_t t : layout.triangles[s]) {
      const auto& [a, b, c] = grid.triangles[t];
      file << layout.line_count + t + 1 << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
  }
  file << "$EndElements\n";
}

}  // namespace

void writeGmsh(const Grid& grid, const std::string& path) {
  const Layout layout = layoutOf(grid);
  TextWriter file(path);
  file << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  writePhysicalNames(file, grid, layout);
  writeEntities(file, grid, layout);
  writeNodes(file, grid, layout);
  writeElements(file, grid, layout);
  writeNodeData(file, grid);
  file.close();
  writePrjBeside(path, grid.crs);
}

void writeGmsh22(const Grid& grid, const std::string& path) {
  const Layout layout = layoutOf(grid);
  TextWriter file(path);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  writePhysicalNames(file, grid, layout);
  file << "$Nodes\n" << grid.nodes.size() << '\n';
  for (std::size_t i = 0; i < grid.nodes.size(); ++i)
    file << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << " 0\n";
  file << "$EndNodes\n$Elements\n" << layout.line_count + grid.triangles.size() << '\n';
  std::size_t tag = 0;
  for (std::size_t c = 0; c < layout.curves; ++c)
    for (const auto& [from, to] : layout.lines[c])
      file << ++tag << ' ' << kLine << " 2 " << c + 1 << ' ' << c + 1 << ' ' << from + 1 << ' ' << to + 1 << '\n';
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    const std::size_t surface = layout.surfaceTag(surfaceOf(grid, t));
    file << ++tag << ' ' << kTriangle << " 2 " << surface << ' ' << surface << ' ' << a + 1 << ' ' << b + 1 << ' '
         << c + 1 << '\n';
  }
  file << "$EndElements\n";
  writeNodeData(file, grid);
  file.close();
  writePrjBeside(path, grid.crs);
}

FormatRecord gmshFormat() {
  return {{"gmsh", {".msh"}, "Gmsh 4.1 for Thetis, Firedrake, SLIM and FEniCS", true, true},
          {writeGmsh, readGmsh, withPrjBeside}};
}

FormatRecord gmsh22Format() {
  return {{"gmsh22", {"_22.msh"}, "Gmsh 2.2", true, true}, {writeGmsh22, readGmsh, withPrjBeside}};
}

}  // namespace coastmesh
