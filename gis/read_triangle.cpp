#include "gis/read_triangle.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <variant>

#include "gis/boundary_chains.hpp"
#include "gis/error.hpp"
#include "gis/grid_lines.hpp"
#include "gis/prj_file.hpp"
#include "gis/text_reader.hpp"

namespace coastmesh {
namespace {

constexpr char kComment = '#';

std::string withEnding(const std::string& path, const char* ending) {
  return std::filesystem::path(path).replace_extension(ending).string();
}

IdMap readNodes(const std::string& path, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  const std::uint64_t count = file.count();
  if (file.count() != 2) file.fail("the nodes are not in two dimensions");
  const std::uint64_t attributes = file.hasWord() ? file.count() : 0;
  std::vector<std::int64_t> ids;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    ids.push_back(file.integer());
    const double x = file.number(), y = file.number();
    grid.nodes.push_back({x, y});
    if (attributes == 1) grid.z.push_back(file.number());
  }
  return IdMap(std::move(ids), file, "node");
}

// Features by the triangles' attribute, ascending; none where it is not a whole number throughout.
void readFeatures(const std::vector<double>& attribute, Grid& grid) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const auto isWhole = [](double value) { return value == std::floor(value) && std::abs(value) <= kExact; };
  if (attribute.empty() || !std::ranges::all_of(attribute, isWhole)) return;
  std::vector<double> known = attribute;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (const double fid : known) grid.features.push_back({static_cast<std::int64_t>(fid), {}, {}});
  for (const double fid : attribute)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, fid) - known.begin()));
}

void readElements(const std::string& path, const IdMap& node_index, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  const std::uint64_t count = file.count();
  if (file.count() != 3) file.fail("only triangles of three nodes can be read");
  const std::uint64_t attributes = file.hasWord() ? file.count() : 0;
  std::vector<double> attribute;
  for (std::uint64_t t = 0; t < count; ++t) {
    file.needLine();
    file.integer();
    auto& triangle = grid.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) {
      const std::int64_t id = file.integer();
      corner = node_index.indexOf(id);
      if (corner == kNone) file.fail("there is no node " + std::to_string(id));
    }
    if (attributes > 0) attribute.push_back(file.number());
  }
  readFeatures(attribute, grid);
}

// Segments of one marker that follow one another.
struct MarkedSegments {
  std::int64_t marker = 0;
  std::variant<BoundaryRole, LineKind> kind;
  std::vector<NodePair> edges;
};

// Segments in the order and with the markers that `writeTriangle` gives them; others tell no roles and are left out.
void readSegments(const std::string& path, const IdMap& node_index, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  if (file.count() != 0) return;  // a .poly with vertices of its own is no companion of the .node
  file.needLine();
  const std::uint64_t count = file.count();
  if (!file.hasWord() || file.count() == 0) return;
  std::vector<MarkedSegments> marked;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    NodePair edge{};
    for (std::uint32_t& end : edge) {
      const std::int64_t id = file.integer();
      end = node_index.indexOf(id);
      if (end == kNone) file.fail("there is no node " + std::to_string(id));
    }
    const std::int64_t marker = file.integer();
    if (marked.empty() || marker != marked.back().marker) {
      if (const auto role = roleOfMarker(marker, marked.size())) {
        marked.push_back({marker, *role, {}});
      } else if (const auto kind = lineKindOfMarker(marker, marked.size())) {
        marked.push_back({marker, *kind, {}});
      } else {
        return;
      }
    }
    marked.back().edges.push_back(edge);
  }
  std::vector<std::vector<NodePair>> groups;
  for (MarkedSegments& segments : marked) {
    auto& edges = groups.emplace_back();
    if (const LineKind* const kind = std::get_if<LineKind>(&segments.kind)) {
      std::ranges::move(linesAlong(segments.edges, *kind, {}), std::back_inserter(grid.lines));
    } else {
      edges = std::move(segments.edges);
    }
  }
  keepRimEdges(grid.triangles, groups);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (Boundary& chain : chainEdges(groups[g])) {
      chain.role = std::get<BoundaryRole>(marked[g].kind);
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

}  // namespace

Grid readTriangle(const std::string& path) {
  Grid grid;
  const IdMap node_index = readNodes(withEnding(path, ".node"), grid);
  readElements(withEnding(path, ".ele"), node_index, grid);
  const std::string poly = withEnding(path, ".poly");
  if (std::filesystem::exists(poly)) readSegments(poly, node_index, grid);
  grid.crs = readPrjBeside(path);
  return grid;
}

}  // namespace coastmesh
