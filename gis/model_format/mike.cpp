#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/crs/crs_from_ogr.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/places.hpp"

// DHI, "The Mesh File Specification". A first line of item, unit, number of nodes and projection (before 2012 without
// item and unit), the nodes with x, y, z and a code, then the elements.
namespace coastmesh {
namespace {

constexpr std::int64_t kBathymetry = 100079;          // the item
constexpr std::int64_t kTriangles = 21, kMixed = 25;  // what elements there are

bool isCount(std::string_view word) {
  return !word.empty() && std::ranges::all_of(word, [](char c) { return c >= '0' && c <= '9'; });
}

// Codes of nodes. The code of a boundary's edge follows from those of its nodes.
constexpr std::int64_t kWater = 0, kLand = 1, kFirstOpen = 2, kMostCode = 999'999;

// Models name boundaries by their codes: a boundary that was read is called "code 3", and keeps that in all edits.
constexpr std::string_view kCodeName = "code ";

std::optional<std::int64_t> codeInName(std::string_view name) {
  constexpr std::size_t kMostDigits = 6;  // of kMostCode
  if (!name.starts_with(kCodeName)) return std::nullopt;
  const std::string_view digits = name.substr(kCodeName.size());
  if (!isCount(digits) || digits.size() > kMostDigits) return std::nullopt;
  const std::int64_t code = std::stoll(std::string(digits));
  return code < kFirstOpen ? std::nullopt : std::optional(code);
}

// DHI's numbers of units.
struct LengthUnit {
  std::int64_t number;
  double metres;
};
constexpr std::array<LengthUnit, 3> kUnits{{{1000, 1.0}, {1003, 0.3048}, {1014, 1200.0 / 3937.0}}};

constexpr std::string_view kGeographic = "LONG/LAT", kPlane = "NON-UTM", kUtm = "UTM-";
constexpr int kUtmZones = 60;

// The EPSG code of WGS 84 in a UTM zone of the northern hemisphere.
std::string utmCode(int zone) { return "EPSG:326" + std::string(zone < 10 ? "0" : "") + std::to_string(zone); }

std::string projectionText(const Grid& grid, const std::string& path) {
  const Crs& crs = grid.crs;
  if (crs.isPlane()) return std::string(kPlane);
  if (crs.geographic && sameCrs(crs, wgs84())) return std::string(kGeographic);
  for (int zone = 1; zone <= kUtmZones; ++zone)
    if (crs.authority == utmCode(zone)) return std::string(kUtm) + std::to_string(zone);
  return esriWkt(crs, path, "for the first line of a .mesh");
}

// The number of a text's UTM zone; nullopt if it names none.
std::optional<int> utmZoneOf(std::string_view text) {
  if (!text.starts_with(kUtm)) return std::nullopt;
  const std::string_view digits = text.substr(kUtm.size());
  if (!isCount(digits) || digits.size() > 2) return std::nullopt;
  const int zone = std::stoi(std::string(digits));
  return zone >= 1 && zone <= kUtmZones ? std::optional(zone) : std::nullopt;
}

Crs readProjection(TextReader& file, std::string_view text, const Crs& unsaid) {
  if (text.empty() || text == kPlane) return unsaid;
  if (text == kGeographic) return wgs84();
  if (const std::optional<int> zone = utmZoneOf(text)) return parseCrs(utmCode(*zone));
  if (const std::optional<Crs> crs = crsFromWkt(std::string(text), "'" + file.path() + "'")) return *crs;
  if (!unsaid.isPlane()) return unsaid;
  file.fail("the projection '" + std::string(text) + "' is neither " + std::string(kGeographic) + ", " +
            std::string(kUtm) + "33, " + std::string(kPlane) + " nor WKT; give --assume-crs");
}

struct Header {
  std::size_t nodes = 0;
  double metres = 1.0;  // a unit of z
  Crs crs;
};

Header readHeader(TextReader& file, const Crs& unsaid) {
  file.needLine();
  const std::string_view first = file.word();
  if (!isCount(first)) file.fail("a .mesh of MIKE starts with numbers, not with '" + std::string(first) + "'");
  Header header;
  // A projection is no number.
  const std::string_view second = file.word();
  std::string_view last = first, projection_from = second;
  if (isCount(second)) {
    if (file.integerIn(first) != kBathymetry)
      file.fail("the values of the nodes are item " + std::string(first) + ", not bathymetry (" +
                std::to_string(kBathymetry) + ")");
    const auto* const unit = std::ranges::find(kUnits, file.integerIn(second), &LengthUnit::number);
    if (unit == kUnits.end())
      file.fail("z is in unit " + std::string(second) + "; metres (1000) and feet (1003, 1014) can be read");
    header.metres = unit->metres;
    last = file.word();
    projection_from = file.word();
  }
  header.nodes = file.countIn(last);
  if (!projection_from.empty()) {
    const auto at = static_cast<std::size_t>(projection_from.data() - file.line().data());
    header.crs = readProjection(file, trimmed(file.line().substr(at)), unsaid);
  } else {
    header.crs = unsaid;
  }
  return header;
}

// The codes of the boundaries: land's, or those of openings. An opening takes the code that its name gives; others take
// the next ones above these, so that none gets the code of an opening that was cut away.
std::vector<std::int64_t> boundaryCodes(const Grid& grid) {
  std::int64_t next = kFirstOpen;
  for (const Boundary& boundary : grid.boundaries)
    if (isOpening(boundary.role)) next = std::max(next, codeInName(boundary.name).value_or(kLand) + 1);
  std::vector<std::int64_t> codes;
  for (const Boundary& boundary : grid.boundaries) {
    const std::optional<std::int64_t> named = codeInName(boundary.name);
    codes.push_back(!isOpening(boundary.role) ? kLand : named ? *named : next++);
  }
  return codes;
}

// The code of each node. At a node of two openings it is that of the one which ends there, in the direction with the
// mesh to the left: MIKE takes an edge's code from its second node.
std::vector<std::int64_t> nodeCodes(const Grid& grid, const ItemLoop& loop) {
  std::vector<std::int64_t> codes(grid.nodes.size(), kWater);
  const std::vector<std::vector<std::uint32_t>> loops = boundaryLoops(grid, loop);
  for (const std::vector<std::uint32_t>& ring : loops)
    for (const std::uint32_t node : ring) codes[node] = kLand;
  const std::vector<std::int64_t> code_of = boundaryCodes(grid);
  const EdgeKinds kinds(grid);
  for (const std::vector<std::uint32_t>& ring : loops) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::uint32_t from = ring[i], to = ring[(i + 1) % ring.size()];
      const BoundaryKind* const kind = kinds.find(from, to);
      if (kind == nullptr || !isOpening(*kind)) continue;
      codes[to] = code_of[kind->segment];
      if (codes[from] == kLand) codes[from] = code_of[kind->segment];
    }
  }
  return codes;
}

// Boundaries from the codes of nodes: an edge with a node of land is land, another has the code of its second node.
// Their names say the codes.
std::vector<Boundary> boundariesOfCodes(const Grid& grid, std::span<const std::int64_t> codes) {
  return cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    BoundaryKind kind;
    if (std::min(codes[from], codes[to]) < kFirstOpen) return kind;
    kind.role = BoundaryRole::Open;
    kind.name = std::string(kCodeName) + std::to_string(codes[to]);
    return kind;
  });
}

// Reads DHI's .mesh of triangles and quadrilaterals. Throws InputError with file and line.
Grid readMike(const std::string& path, const Crs& unsaid) {
  TextReader file(path);
  const Header header = readHeader(file, unsaid);
  Grid grid;
  grid.crs = header.crs;
  std::vector<std::int64_t> ids, codes;
  for (std::size_t i = 0; i < header.nodes; ++i) {
    file.needLine();
    ids.push_back(file.integer());
    const double x = file.number(), y = file.number();
    grid.nodes.push_back({x, y});
    grid.z.push_back(header.metres * file.number());
    codes.push_back(file.integer());
    if (codes.back() < 0 || codes.back() > kMostCode)
      file.fail("node " + std::to_string(ids.back()) + " has the code " + std::to_string(codes.back()));
  }
  const IdMap index(std::move(ids), file, "node");
  file.needLine();
  const std::uint64_t elements = file.count();
  std::vector<std::uint32_t> nodes;
  for (std::uint64_t e = 0; e < elements; ++e) {
    file.needLine();
    const std::int64_t id = file.integer();
    nodes.clear();
    while (file.hasWord()) {
      const std::int64_t node = file.integer();
      if (node == 0) continue;  // of a triangle among quadrilaterals
      nodes.push_back(index.indexOf(node));
      if (nodes.back() == kNone)
        file.fail("element " + std::to_string(id) + " names node " + std::to_string(node) + ", which is not there");
    }
    if (nodes.size() < 3 || nodes.size() > 4)
      file.fail("element " + std::to_string(id) + " has " + std::to_string(nodes.size()) + " nodes, not 3 or 4");
    addElement(grid, nodes);
  }
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  grid.boundaries = boundariesOfCodes(grid, codes);
  return grid;
}

// Writes DHI's .mesh: z is elevation in metres, positive up, 0 if the grid has none; codes are those of
// `boundaryCodes`. Throws OutputError, also if a z is unknown.
void writeMike(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const std::string projection = projectionText(grid, path);
  const std::vector<std::int64_t> codes = nodeCodes(grid, loop);
  const Elements elements(grid);
  const bool mixed = elements.quads() > 0;
  TextWriter file(path);
  file << kBathymetry << ' ' << kUnits.front().number << ' ' << grid.nodes.size() << ' ' << projection << '\n';
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y << ' ' << (grid.z.empty() ? 0.0 : grid.z[i])
         << ' ' << codes[i] << '\n';
  });
  file << elements.size() << ' ' << (mixed ? 4 : 3) << ' ' << (mixed ? kMixed : kTriangles) << '\n';
  file.rows(loop, elements.size(), [&](TextBlock& text, std::size_t e) {
    text << e + 1;
    for (const std::uint32_t node : elements.nodesOf(e)) text << ' ' << node + 1;
    text << (mixed && !elements.isQuad(e) ? " 0\n" : "\n");
  });
  file.close();
}

// MIKE knows boundaries by their codes only. A single one has the first.
std::string codesText(const Grid& grid, const std::string& path) {
  const std::vector<std::int64_t> codes = boundaryCodes(grid);
  std::vector<std::string> names;
  for (std::size_t b = 0; b < codes.size(); ++b) {
    Boundary boundary = grid.boundaries[b];
    if (!isOpening(boundary.role)) continue;
    if (codeInName(boundary.name)) boundary.name.clear();
    names.push_back(std::to_string(codes[b]) + ' ' + openingName(boundary, grid));
  }
  return names.size() < 2 ? "" : "codes of open boundaries in '" + path + "': " + listed(names, kMostOpenings);
}

}  // namespace

FormatRecord mikeFormat() {
  return {{.name = "mike",
           .endings = {".mesh"},
           .description = "MIKE 21 and MIKE 3 FM's .mesh, z positive up",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Quads},
           .says_depth = true,
           .needs_depths = true,
           .places = NodePlaces::OneTurn,
           .lengths_in_metres = true,
           .marked = MarkedNodes::OfOpenAndRivers,
           .holds_esri_wkt = true},
          {.write = writeMike, .read = readMike, .openings = codesText}};
}

}  // namespace coastmesh
