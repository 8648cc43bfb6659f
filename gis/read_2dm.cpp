#include "gis/read_2dm.hpp"

#include <algorithm>

#include "gis/boundary_chains.hpp"
#include "gis/error.hpp"
#include "gis/prj_file.hpp"
#include "gis/text_reader.hpp"

namespace coastmesh {
namespace {

struct NodeString {
  std::vector<std::int64_t> nodes;
  std::int64_t id = 0;
};

struct Cards {
  std::vector<std::int64_t> node_ids;
  std::vector<std::array<std::int64_t, 3>> corners;
  std::vector<std::int64_t> materials;
  std::vector<NodeString> strings;
};

// A node string goes on over several lines until a node with a minus sign ends it.
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

Cards readCards(TextReader& file, Grid& grid) {
  Cards cards;
  bool unfinished = false;
  while (file.nextLine()) {
    const std::string_view card = file.word();
    if (card == "E3T") {
      file.integer();
      auto& corners = cards.corners.emplace_back();
      for (std::int64_t& corner : corners) corner = file.integer();
      cards.materials.push_back(file.hasWord() ? file.integer() : 1);
    } else if (card == "ND") {
      cards.node_ids.push_back(file.integer());
      const double x = file.number(), y = file.number();
      grid.nodes.push_back({x, y});
      grid.z.push_back(file.hasWord() ? file.number() : 0.0);
    } else if (card == "NS") {
      readNodeString(file, cards, unfinished);
    } else if (card == "E4Q" || card == "E6T" || card == "E8Q" || card == "E9Q") {
      file.fail("an element of kind " + std::string(card) + "; only meshes of triangles (E3T) can be read");
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
  if (known.size() < 2) return;
  for (const std::int64_t material : known) grid.features.push_back({material, {}, {}});
  for (const std::int64_t material : cards.materials)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, material) - known.begin()));
}

void readBoundaries(const Cards& cards, const IdMap& node_index, const TextReader& file, Grid& grid) {
  std::vector<std::vector<NodePair>> groups;
  bool ours = true;
  for (const NodeString& string : cards.strings) {
    ours = ours && roleOfMarker(string.id, groups.size());
    auto& edges = groups.emplace_back();
    for (std::size_t i = 0; i < string.nodes.size(); ++i) {
      const std::uint32_t node = node_index.indexOf(string.nodes[i]);
      if (node == kNone)
        throw InputError("'" + file.path() + "': a node string (NS) names node " + std::to_string(string.nodes[i]) +
                         ", which is not there");
      if (i > 0) edges.back()[1] = node;
      if (i + 1 < string.nodes.size()) edges.push_back({node, node});
    }
  }
  keepRimEdges(grid.triangles, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Boundary& chain : chainEdges(groups[g])) {
      if (ours) {
        chain.role = *roleOfMarker(cards.strings[g].id, g);
      } else if (chain.closed) {
        chain.role = roleOfLoop(grid.nodes, chain.nodes);
      }
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

}  // namespace

Grid read2dm(const std::string& path) {
  TextReader file(path);
  file.needLine();
  if (file.word() != "MESH2D") file.fail("a 2dm file starts with MESH2D");
  Grid grid;
  const Cards cards = readCards(file, grid);
  const IdMap node_index(cards.node_ids, file, "node");
  for (const auto& corners : cards.corners) {
    auto& triangle = grid.triangles.emplace_back();
    for (unsigned i = 0; i < 3; ++i) {
      triangle[i] = node_index.indexOf(corners[i]);
      if (triangle[i] == kNone)
        throw InputError("'" + path + "': triangle " + std::to_string(grid.triangles.size()) + " names node " +
                         std::to_string(corners[i]) + ", which is not there");
    }
  }
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  readMaterials(cards, grid);
  readBoundaries(cards, node_index, file, grid);
  grid.crs = readPrjBeside(path);
  return grid;
}

}  // namespace coastmesh
