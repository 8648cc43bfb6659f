#include <algorithm>
#include <iterator>
#include <map>

#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/grid/marked_edges.hpp"

namespace coastmesh {
namespace {

struct NodeString {
  std::vector<std::int64_t> nodes;
  std::int64_t id = 0;
};

struct Cards {
  std::vector<std::int64_t> node_ids;
  std::vector<std::int64_t> corners;     // of all elements
  std::vector<std::uint8_t> corners_of;  // their number in each element: three or four
  std::vector<std::int64_t> materials;
  std::vector<NodeString> strings;
  std::map<std::int64_t, std::string> material_names;
};

// A node string may continue over several lines until a node with a minus sign ends it.
void readNodeString(TextReader& file, Cards& cards, bool& unfinished) {
  if (!unfinished) cards.strings.emplace_back();
  unfinished = true;
  NodeString& string = cards.strings.back();
  while (file.hasWord()) {
    const std::int64_t node = file.integer();
    string.nodes.push_back(node < 0 ? -node : node);
    if (node >= 0) continue;
    unfinished = false;
    if (file.hasWord()) string.id = file.integer();
    return;
  }
}

// MAT id "name"
void readMaterialName(TextReader& file, Cards& cards) {
  const std::int64_t id = file.integer();
  const std::string_view line = file.line();
  const std::size_t open = line.find('"'), close = line.rfind('"');
  if (open != std::string_view::npos && close > open)
    cards.material_names[id] = std::string(line.substr(open + 1, close - open - 1));
}

Cards readCards(TextReader& file, Grid& grid) {
  Cards cards;
  bool unfinished = false;
  while (file.nextLine()) {
    const std::string_view card = file.word();
    if (card == "E3T" || card == "E4Q") {
      file.integer();
      cards.corners_of.push_back(card == "E3T" ? 3 : 4);
      for (unsigned i = 0; i < cards.corners_of.back(); ++i) cards.corners.push_back(file.integer());
      cards.materials.push_back(file.hasWord() ? file.integer() : 1);
    } else if (card == "ND") {
      cards.node_ids.push_back(file.integer());
      const double x = file.number(), y = file.number();
      grid.nodes.push_back({x, y});
      grid.z.push_back(file.hasWord() ? file.number() : 0.0);
    } else if (card == "NS") {
      readNodeString(file, cards, unfinished);
    } else if (card == "MAT") {
      readMaterialName(file, cards);
    } else if (card == "E6T" || card == "E8Q" || card == "E9Q") {
      file.fail("an element of kind " + std::string(card) +
                "; only triangles (E3T) and quadrilaterals (E4Q) can be read");
    }
  }
  if (unfinished) throw InputError("'" + file.path() + "': the last node string (NS) has no end");
  return cards;
}

void readMaterials(const Cards& cards, Grid& grid) {
  std::vector<std::int64_t> known = cards.materials;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  const auto named = [&](std::int64_t material) { return cards.material_names.contains(material); };
  if (known.size() < 2 && std::ranges::none_of(known, named)) return;
  for (const std::int64_t material : known)
    grid.features.push_back(named(material) ? featureOfLabel(cards.material_names.at(material), material)
                                            : GridFeature{material, {}, {}});
  for (const std::int64_t material : cards.materials)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, material) - known.begin()));
  giveToHalves(Elements(grid), grid);
}

std::vector<std::uint32_t> nodesOf(const NodeString& string, const IdMap& node_index, const TextReader& file) {
  std::vector<std::uint32_t> nodes;
  for (const std::int64_t id : string.nodes) {
    nodes.push_back(node_index.indexOf(id));
    if (nodes.back() == kNone)
      throw InputError("'" + file.path() + "': a node string (NS) names node " + std::to_string(id) +
                       ", which is not there");
  }
  return nodes;
}

// Reads boundaries and lines inside the mesh. In files of other programs, strings or parts of them that do not run
// along the boundary are lines.
void readStrings(const Cards& cards, const IdMap& node_index, const TextReader& file, Grid& grid) {
  std::vector<std::int64_t> ids;
  for (const NodeString& string : cards.strings) ids.push_back(string.id);
  const std::vector<MarkerKind> kinds = kindsOfMarkers(ids);
  std::vector<std::vector<NodePair>> groups;
  for (std::size_t s = 0; s < cards.strings.size(); ++s) {
    std::vector<std::uint32_t> nodes = nodesOf(cards.strings[s], node_index, file);
    auto& edges = groups.emplace_back();
    if (const LineKind* const kind = std::get_if<LineKind>(&kinds[s])) {
      if (nodes.size() > 1) grid.lines.push_back(lineOfNodes(*kind, {}, std::move(nodes)));
      continue;
    }
    for (std::size_t i = 1; i < nodes.size(); ++i) edges.push_back({nodes[i - 1], nodes[i]});
  }
  const std::vector<std::vector<NodePair>> inner = keepBoundaryEdges(grid.triangles, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Boundary& chain : chainEdges(groups[g])) {
      if (const BoundaryRole* const role = std::get_if<BoundaryRole>(&kinds[g])) {
        chain.role = *role;
      } else if (chain.closed) {
        chain.role = roleOfLoop(grid.nodes, chain.nodes, grid.crs);
      }
      grid.boundaries.push_back(std::move(chain));
    }
    std::ranges::move(chainLines(inner[g], LineKind::Constraint, {}), std::back_inserter(grid.lines));
  }
}

// Reads SMS .2dm of triangles and quadrilaterals, with the CRS of a .prj beside it. Materials become features if there
// are several or one is named. Node strings that follow the mesh's boundary become boundaries: those with our numbers
// keep their role; others are open, or land or an island if closed. Throws InputError with file and line.
Grid read2dm(const std::string& path, const Crs& unsaid) {
  TextReader file(path);
  file.needLine();
  if (file.word() != "MESH2D") file.fail("a 2dm file starts with MESH2D");
  Grid grid;
  const Cards cards = readCards(file, grid);
  const IdMap node_index(cards.node_ids, file, "node");
  grid.crs = readPrjBeside(path, unsaid);
  std::vector<std::uint32_t> nodes;
  auto next = cards.corners.begin();
  for (std::size_t e = 0; e < cards.corners_of.size(); ++e) {
    nodes.clear();
    for (unsigned i = 0; i < cards.corners_of[e]; ++i) {
      const std::int64_t corner = *next++;
      nodes.push_back(node_index.indexOf(corner));
      if (nodes.back() == kNone)
        throw InputError("'" + path + "': element " + std::to_string(e + 1) + " names node " + std::to_string(corner) +
                         ", which is not there");
    }
    addElement(grid, nodes);
  }
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  readMaterials(cards, grid);
  readStrings(cards, node_index, file, grid);
  return grid;
}

constexpr std::size_t kNodesPerLine = 10;

void writeNodeString(TextWriter& file, std::vector<std::uint32_t> nodes, bool closed, std::int64_t id) {
  if (closed) nodes.push_back(nodes.front());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (i % kNodesPerLine == 0) file << (i == 0 ? "NS" : "\nNS");
    file << (i + 1 == nodes.size() ? " -" : " ") << nodes[i] + 1;
  }
  file << ' ' << id << '\n';
}

// True if the numbers of materials define the features completely: fids count from 1, and there are no regions.
bool numbersSayAll(const Grid& grid) {
  for (std::size_t f = 0; f < grid.features.size(); ++f)
    if (grid.features[f].fid != static_cast<std::int64_t>(f) + 1 || !grid.features[f].region.empty()) return false;
  return true;
}

// SMS stores names of materials among the assignments of its models.
void writeMaterialNames(TextWriter& file, const Grid& grid) {
  if (grid.feature_of.empty() || numbersSayAll(grid)) return;
  const std::vector<std::string> labels = featureLabels(grid);
  file << "BEG2DMBC\n";
  for (std::size_t f = 0; f < labels.size(); ++f) file << "MAT " << f + 1 << " \"" << labels[f] << "\"\n";
  file << "END2DMBC\n";
}

// Writes SMS .2dm with a .prj beside it. z is elevation, positive up, 0 if the grid has none; the material is the
// number of the feature; boundaries and lines are node strings that repeat the first node if closed, numbered by
// `boundaryMarker` and `lineMarker`. Throws OutputError.
void write2dm(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  TextWriter file(path);
  file << "MESH2D\n";
  const Elements elements(grid);
  file.rows(loop, elements.size(), [&](TextBlock& text, std::size_t e) {
    const std::uint32_t material = grid.feature_of.empty() ? 1 : grid.feature_of[elements.triangleOf(e)] + 1;
    text << (elements.isQuad(e) ? "E4Q " : "E3T ") << e + 1;
    for (const std::uint32_t node : elements.nodesOf(e)) text << ' ' << node + 1;
    text << ' ' << material << '\n';
  });
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << "ND " << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' '
         << (grid.z.empty() ? 0.0 : grid.z[i]) << '\n';
  });
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

}  // namespace

FormatRecord sms2dmFormat() {
  return {{.name = "2dm",
           .endings = {".2dm"},
           .description = "SMS 2dm for QGIS and TUFLOW, z positive up",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Quads, GridPart::Features, GridPart::Regions, GridPart::Lines, GridPart::Rivers},
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true},
          {write2dm, read2dm, withPrjBeside}};
}

}  // namespace coastmesh
