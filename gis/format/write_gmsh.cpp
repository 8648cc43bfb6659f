#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "gis/elements/elements.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/format/read_gmsh.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_lines.hpp"

namespace coastmesh {
namespace {

constexpr int kLine = 1, kTriangle = 2, kQuadrilateral = 3;  // element types

constexpr GridParts kParts22{GridPart::Quads,       GridPart::Features,     GridPart::Regions, GridPart::Lines,
                             GridPart::LineNames,   GridPart::Rivers,       GridPart::Ibtypes, GridPart::BareWeirs,
                             GridPart::PartIslands, GridPart::BoundaryNames};

// Curves are tagged from 1 in the order of the boundaries, then of the lines; surfaces continue in the order of the
// features. Physical groups have the tags of their entities; lines of the same kind and name are one group.
struct Layout {
  struct Curve {
    const std::vector<std::uint32_t>* nodes = nullptr;
    std::vector<NodePair> edges;
    std::size_t group = 0;  // tag
    bool inside = false;    // a line
  };
  std::vector<Curve> curves;
  std::vector<std::pair<std::size_t, std::string>> curve_groups;  // tag and name
  Elements elements;
  std::vector<std::vector<std::uint32_t>> members;  // elements of each surface
  std::size_t line_count = 0;

  explicit Layout(const Grid& grid) : elements(grid) {}
  std::size_t surfaces() const { return members.size(); }
  std::size_t surfaceTag(std::size_t surface) const { return curves.size() + surface + 1; }
};

std::size_t surfaceOf(const Grid& grid, std::size_t triangle) {
  return grid.feature_of.empty() ? 0 : grid.feature_of[triangle];
}

std::string groupName(const Boundary& boundary, std::size_t tag) {
  std::string name = std::string(toString(boundary.role)) + ' ' + std::to_string(tag);
  if (!boundary.name.empty()) name += ' ' + quotable(boundary.name);
  if (boundary.ibtype >= 0) name += std::string(kIbtypeMark) + std::to_string(boundary.ibtype);
  return name;
}

std::string groupName(const GridLine& line) {
  const std::string kind(toString(line.kind)), name = quotable(line.name);
  return name.empty() ? kind : kind + ' ' + name;
}

Layout layoutOf(const Grid& grid) {
  Layout layout(grid);
  const auto addCurve = [&](const auto& chain, std::size_t group, bool inside) {
    layout.curves.push_back({&chain.nodes, edgesOf(chain), group, inside});
    layout.line_count += layout.curves.back().edges.size();
  };
  for (const Boundary& boundary : grid.boundaries) {
    const std::size_t tag = layout.curves.size() + 1;
    layout.curve_groups.emplace_back(tag, groupName(boundary, tag));
    addCurve(boundary, tag, false);
  }
  std::map<std::string, std::size_t> group_of;
  for (const GridLine& line : grid.lines) {
    const auto [group, added] = group_of.try_emplace(groupName(line), layout.curves.size() + 1);
    if (added) layout.curve_groups.emplace_back(group->second, group->first);
    addCurve(line, group->second, true);
  }
  layout.members.resize(grid.feature_of.empty() ? 1 : grid.features.size());
  for (std::uint32_t e = 0; e < layout.elements.size(); ++e)
    layout.members[surfaceOf(grid, layout.elements.triangleOf(e))].push_back(e);
  return layout;
}

void writePhysicalNames(TextWriter& file, const Grid& grid, const Layout& layout) {
  file << "$PhysicalNames\n" << layout.curve_groups.size() + layout.surfaces() << '\n';
  for (const auto& [tag, name] : layout.curve_groups) file << "1 " << tag << " \"" << name << "\"\n";
  const std::vector<std::string> labels =
      grid.feature_of.empty() ? std::vector<std::string>{"domain"} : featureLabels(grid);
  for (std::size_t s = 0; s < layout.surfaces(); ++s)
    file << "2 " << layout.surfaceTag(s) << " \"" << labels[s] << "\"\n";
  file << "$EndPhysicalNames\n";
}

// Writes values in the order of the nodes in the file: some readers rely on it and ignore the tags.
void writeNodeData(TextWriter& file, const Grid& grid, const std::vector<std::uint32_t>& order, const ItemLoop& loop) {
  if (grid.z.empty()) return;
  const auto known = std::ranges::count_if(grid.z, [](double z) { return !std::isnan(z); });
  file << "$NodeData\n1\n\"z\"\n1\n0\n3\n0\n1\n" << known << '\n';
  file.rows(loop, order.size(), [&](TextBlock& text, std::size_t i) {
    if (const double z = grid.z[order[i]]; !std::isnan(z)) text << order[i] + 1 << ' ' << z << '\n';
  });
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

// The curves that bound each surface; a line does if there is another surface across it.
std::vector<std::set<std::size_t>> curvesAlong(const Grid& grid, const Layout& layout) {
  std::vector<std::set<std::size_t>> along(layout.surfaces());
  if (layout.surfaces() == 1) {
    for (std::size_t c = 0; c < layout.curves.size(); ++c)
      if (!layout.curves[c].inside) along[0].insert(c);
    return along;
  }
  struct Side {
    NodePair edge;
    std::size_t curve;
    std::size_t surface = kNone;  // to the left
  };
  std::vector<Side> sides;
  for (std::size_t c = 0; c < layout.curves.size(); ++c) {
    for (const auto& [a, b] : layout.curves[c].edges) {
      sides.push_back({{a, b}, c});
      if (layout.curves[c].inside) sides.push_back({{b, a}, c});
    }
  }
  std::ranges::sort(sides, {}, &Side::edge);
  std::vector<bool> on_curve(grid.nodes.size(), false);
  for (const Side& side : sides) on_curve[side.edge[0]] = on_curve[side.edge[1]] = true;
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& v = grid.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      const NodePair edge{v[i], v[next3(i)]};
      if (!on_curve[edge[0]] || !on_curve[edge[1]]) continue;
      for (Side& side : std::ranges::equal_range(sides, edge, {}, &Side::edge)) side.surface = surfaceOf(grid, t);
    }
  }
  const auto beyond = [&](const Side& side) {
    const NodePair back{side.edge[1], side.edge[0]};
    const auto at = std::ranges::lower_bound(sides, back, {}, &Side::edge);
    return at != sides.end() && at->edge == back ? at->surface : kNone;
  };
  for (const Side& side : sides)
    if (side.surface != kNone && beyond(side) != side.surface) along[side.surface].insert(side.curve);
  return along;
}

void writeEntities(TextWriter& file, const Grid& grid, const Layout& layout) {
  file << "$Entities\n0 " << layout.curves.size() << ' ' << layout.surfaces() << " 0\n";
  for (std::size_t c = 0; c < layout.curves.size(); ++c) {
    Box box;
    for (std::uint32_t node : *layout.curves[c].nodes) box.add(grid.nodes[node]);
    file << c + 1 << ' ' << box << " 1 " << layout.curves[c].group << " 0\n";
  }
  const std::vector<std::set<std::size_t>> along = curvesAlong(grid, layout);
  for (std::size_t s = 0; s < layout.surfaces(); ++s) {
    Box box;
    for (const std::uint32_t element : layout.members[s])
      for (const std::uint32_t node : layout.elements.nodesOf(element)) box.add(grid.nodes[node]);
    file << layout.surfaceTag(s) << ' ' << box << " 1 " << layout.surfaceTag(s) << ' ' << along[s].size();
    for (std::size_t c : along[s]) file << ' ' << c + 1;
    file << '\n';
  }
  file << "$EndEntities\n";
}

// The elements of one type of an entity, or of its share in one part of a partitioned mesh.
struct Block {
  int dimension = 0;
  std::size_t tag = 0;
  std::size_t entity = 0;              // its tag; differs from `tag` if the mesh is partitioned
  std::uint32_t part = 0;              // the part, from 0, if the mesh is partitioned
  std::vector<std::uint32_t> members;  // indices into `linesOf`, or elements
  int type = kLine;                    // of the elements
};

// The edges of all curves, one curve after another.
std::vector<NodePair> linesOf(const Layout& layout) {
  std::vector<NodePair> lines;
  for (const Layout::Curve& curve : layout.curves) lines.insert(lines.end(), curve.edges.begin(), curve.edges.end());
  return lines;
}

// The part of each line: that of the triangle to its left, or to its right if there is none.
std::vector<std::uint32_t> partsOfLines(const Grid& grid, const std::vector<NodePair>& lines) {
  std::vector<std::pair<NodePair, std::size_t>> sides;
  std::vector<bool> on_line(grid.nodes.size(), false);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    sides.emplace_back(lines[i], i);
    on_line[lines[i][0]] = on_line[lines[i][1]] = true;
  }
  std::ranges::sort(sides);
  std::vector<std::uint32_t> parts(lines.size(), 0);
  std::vector<bool> left(lines.size(), false);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][next3(i)];
      if (!on_line[a] || !on_line[b]) continue;
      for (const bool is_left : {true, false}) {
        const NodePair edge = is_left ? NodePair{a, b} : NodePair{b, a};
        for (const auto& side : std::ranges::equal_range(sides, edge, {}, &std::pair<NodePair, std::size_t>::first)) {
          if (left[side.second]) continue;
          parts[side.second] = grid.part_of[t];
          left[side.second] = is_left;
        }
      }
    }
  }
  return parts;
}

// All elements, entity by entity; in a partitioned mesh part by part within each entity, with tags after those of the
// entities.
std::vector<Block> blocksOf(const Grid& grid, const Layout& layout) {
  std::vector<Block> blocks;
  const bool partitioned = !grid.part_of.empty();
  std::size_t next_tag = layout.surfaceTag(layout.surfaces());
  const auto add = [&](int type, std::size_t entity, std::vector<std::uint32_t> members, auto&& partOf) {
    const int dimension = type == kLine ? 1 : 2;
    if (!partitioned) {
      blocks.push_back({dimension, entity, entity, 0, std::move(members), type});
      return;
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> by_part;
    for (const std::uint32_t member : members) by_part[partOf(member)].push_back(member);
    for (auto& [part, some] : by_part) blocks.push_back({dimension, next_tag++, entity, part, std::move(some), type});
  };
  const std::vector<std::uint32_t> line_parts =
      partitioned ? partsOfLines(grid, linesOf(layout)) : std::vector<std::uint32_t>();
  std::uint32_t line = 0;
  for (std::size_t c = 0; c < layout.curves.size(); ++c) {
    std::vector<std::uint32_t> members(layout.curves[c].edges.size());
    for (std::uint32_t& member : members) member = line++;
    add(kLine, c + 1, std::move(members), [&](std::uint32_t l) { return line_parts[l]; });
  }
  const Elements& elements = layout.elements;
  for (std::size_t s = 0; s < layout.surfaces(); ++s) {
    std::vector<std::uint32_t> triangles = layout.members[s], quads;
    if (elements.quads() > 0) {
      const auto rest = std::ranges::stable_partition(triangles, [&](std::uint32_t e) { return !elements.isQuad(e); });
      quads.assign(rest.begin(), rest.end());
      triangles.erase(rest.begin(), rest.end());
    }
    const auto partOf = [&](std::uint32_t e) { return grid.part_of[elements.triangleOf(e)]; };
    if (!triangles.empty() || quads.empty()) add(kTriangle, layout.surfaceTag(s), std::move(triangles), partOf);
    if (!quads.empty()) add(kQuadrilateral, layout.surfaceTag(s), std::move(quads), partOf);
  }
  return blocks;
}

// Writes which part of which entity each block is, which Gmsh calls a partitioned entity; parts count from 1.
void writePartitionedEntities(TextWriter& file, const Grid& grid, const Layout& layout,
                              const std::vector<NodePair>& lines, const std::vector<Block>& blocks) {
  if (grid.part_of.empty()) return;
  const std::vector<std::set<std::size_t>> along = curvesAlong(grid, layout);
  std::map<std::pair<std::size_t, std::uint32_t>, std::size_t> curve_part;  // curve and part -> tag
  for (const Block& block : blocks)
    if (block.dimension == 1) curve_part[{block.entity - 1, block.part}] = block.tag;
  file << "$PartitionedEntities\n" << std::ranges::max(grid.part_of) + 1 << "\n0\n";
  file << "0 " << curve_part.size() << ' ' << blocks.size() - curve_part.size() << " 0\n";
  for (const Block& block : blocks) {
    Box box;
    for (const std::uint32_t member : block.members) {
      if (block.dimension == 1) {
        for (const std::uint32_t node : lines[member]) box.add(grid.nodes[node]);
      } else {
        for (const std::uint32_t node : layout.elements.nodesOf(member)) box.add(grid.nodes[node]);
      }
    }
    const std::size_t group = block.dimension == 1 ? layout.curves[block.entity - 1].group : block.entity;
    file << block.tag << ' ' << block.dimension << ' ' << block.entity << " 1 " << block.part + 1 << ' ' << box << " 1 "
         << group;
    std::vector<std::size_t> around;
    if (block.dimension == 2) {
      for (const std::size_t c : along[block.entity - layout.curves.size() - 1])
        if (const auto found = curve_part.find({c, block.part}); found != curve_part.end())
          around.push_back(found->second);
    }
    file << ' ' << around.size();
    for (const std::size_t tag : around) file << ' ' << tag;
    file << '\n';
  }
  file << "$EndPartitionedEntities\n";
}

// Writes every node in the first block of its first entity, curves before surfaces, and unused nodes in the first
// surface's block. Returns their order.
std::vector<std::uint32_t> writeNodes(TextWriter& file, const Grid& grid, const Elements& elements,
                                      const std::vector<NodePair>& lines, const std::vector<Block>& blocks,
                                      const ItemLoop& loop) {
  std::vector<std::vector<std::uint32_t>> nodes_of(blocks.size());
  std::vector<bool> placed(grid.nodes.size(), false);
  const auto place = [&](std::size_t block, std::uint32_t node) {
    if (!placed[node]) nodes_of[block].push_back(node);
    placed[node] = true;
  };
  std::size_t first_surface = blocks.size();
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (blocks[b].dimension == 2) first_surface = std::min(first_surface, b);
    const bool continues = b > 0 && blocks[b].dimension == 2 && blocks[b - 1].tag == blocks[b].tag;
    for (const std::uint32_t member : blocks[b].members) {
      if (blocks[b].dimension == 1) {
        for (const std::uint32_t node : lines[member]) place(b, node);
      } else {
        for (const std::uint32_t node : elements.nodesOf(member)) place(continues ? b - 1 : b, node);
      }
    }
  }
  for (std::uint32_t node = 0; node < grid.nodes.size(); ++node) place(first_surface, node);
  const auto filled = std::ranges::count_if(nodes_of, [](const auto& nodes) { return !nodes.empty(); });
  std::vector<std::uint32_t> order;
  order.reserve(grid.nodes.size());
  file << "$Nodes\n" << filled << ' ' << grid.nodes.size() << " 1 " << grid.nodes.size() << '\n';
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    std::vector<std::uint32_t>& nodes = nodes_of[b];
    if (nodes.empty()) continue;
    std::ranges::sort(nodes);
    order.insert(order.end(), nodes.begin(), nodes.end());
    file << blocks[b].dimension << ' ' << blocks[b].tag << " 0 " << nodes.size() << '\n';
    file.rows(loop, nodes.size(), [&](TextBlock& text, std::size_t i) { text << nodes[i] + 1 << '\n'; });
    file.rows(loop, nodes.size(), [&](TextBlock& text, std::size_t i) {
      text << grid.nodes[nodes[i]].x << ' ' << grid.nodes[nodes[i]].y << " 0\n";
    });
  }
  file << "$EndNodes\n";
  return order;
}

void writeElements(TextWriter& file, const Elements& elements, const std::vector<NodePair>& lines,
                   const std::vector<Block>& blocks, const ItemLoop& loop) {
  const auto filled = std::ranges::count_if(blocks, [](const Block& block) { return !block.members.empty(); });
  const std::size_t count = lines.size() + elements.size();
  file << "$Elements\n" << filled << ' ' << count << " 1 " << count << '\n';
  for (const Block& block : blocks) {
    if (block.members.empty()) continue;
    const bool curve = block.dimension == 1;
    file << block.dimension << ' ' << block.tag << ' ' << block.type << ' ' << block.members.size() << '\n';
    file.rows(loop, block.members.size(), [&](TextBlock& text, std::size_t i) {
      const std::uint32_t member = block.members[i];
      text << (curve ? member : lines.size() + member) + 1;
      if (curve) {
        for (const std::uint32_t node : lines[member]) text << ' ' << node + 1;
      } else {
        for (const std::uint32_t node : elements.nodesOf(member)) text << ' ' << node + 1;
      }
      text << '\n';
    });
  }
  file << "$EndElements\n";
}

// Writes Gmsh .msh 4.1 (`writeGmsh22`: 2.2), ASCII, with the CRS in a .prj. Each boundary is a curve of line elements
// with a physical group ("land 1", "island 2", "open 3"), as is each line ("weir North"); each feature is a surface
// with its own ("feature 17"; "domain" if there are none). Tags of nodes and elements follow the grid's order. The
// mesh lies in the plane: z is node data, since solvers take a third coordinate for a curved surface. Throws
// OutputError.
void writeGmsh(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const Layout layout = layoutOf(grid);
  TextWriter file(path);
  file << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  writePhysicalNames(file, grid, layout);
  writeEntities(file, grid, layout);
  const std::vector<NodePair> lines = linesOf(layout);
  const std::vector<Block> blocks = blocksOf(grid, layout);
  writePartitionedEntities(file, grid, layout, lines, blocks);
  const std::vector<std::uint32_t> order = writeNodes(file, grid, layout.elements, lines, blocks, loop);
  writeElements(file, layout.elements, lines, blocks, loop);
  writeNodeData(file, grid, order, loop);
  file.close();
  writePrjBeside(path, grid.crs);
}

void writeGmsh22(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const Layout layout = layoutOf(grid);
  TextWriter file(path);
  file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  writePhysicalNames(file, grid, layout);
  file << "$Nodes\n" << grid.nodes.size() << '\n';
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << " 0\n";
  });
  file << "$EndNodes\n$Elements\n" << layout.line_count + layout.elements.size() << '\n';
  std::size_t tag = 0;
  for (std::size_t c = 0; c < layout.curves.size(); ++c)
    for (const auto& [from, to] : layout.curves[c].edges)
      file << ++tag << ' ' << kLine << " 2 " << layout.curves[c].group << ' ' << c + 1 << ' ' << from + 1 << ' '
           << to + 1 << '\n';
  const Elements& elements = layout.elements;
  file.rows(loop, elements.size(), [&](TextBlock& text, std::size_t e) {
    const std::size_t surface = layout.surfaceTag(surfaceOf(grid, elements.triangleOf(e)));
    text << tag + e + 1 << ' ' << (elements.isQuad(e) ? kQuadrilateral : kTriangle) << " 2 " << surface << ' '
         << surface;
    for (const std::uint32_t node : elements.nodesOf(e)) text << ' ' << node + 1;
    text << '\n';
  });
  file << "$EndElements\n";
  std::vector<std::uint32_t> order(grid.nodes.size());
  std::iota(order.begin(), order.end(), 0u);
  writeNodeData(file, grid, order, loop);
  file.close();
  writePrjBeside(path, grid.crs);
}

}  // namespace

FormatRecord gmshFormat() {
  constexpr GridParts kParts41{GridPart::Quads,       GridPart::Features,  GridPart::Regions,      GridPart::Lines,
                               GridPart::LineNames,   GridPart::Rivers,    GridPart::Ibtypes,      GridPart::BareWeirs,
                               GridPart::PartIslands, GridPart::Partition, GridPart::BoundaryNames};
  return {{.name = "gmsh",
           .endings = {".msh"},
           .description = "Gmsh 4.1 for Thetis, Firedrake, SLIM and FEniCS",
           .readable = true,
           .writable = true,
           .holds = kParts41,
           .places = NodePlaces::OneTurn},
          {writeGmsh, readGmsh, withPrjBeside}};
}

FormatRecord gmsh22Format() {
  return {{.name = "gmsh22",
           .endings = {"_22.msh"},
           .description = "Gmsh 2.2",
           .readable = true,
           .writable = true,
           .holds = kParts22,
           .places = NodePlaces::OneTurn},
          {writeGmsh22, readGmsh, withPrjBeside}};
}

}  // namespace coastmesh
