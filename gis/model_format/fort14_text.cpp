#include "gis/model_format/fort14_text.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/file/list_reader.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/ibtype.hpp"

namespace coastmesh {
namespace {

constexpr std::string_view kNoTitle = "coastmesh";
constexpr std::string_view kNameMark = ": ";  // before the name of a boundary, in the comment on its number of nodes

// A segment of nodes as the file has it.
struct Segment {
  std::vector<std::uint32_t> nodes;
  int type = 0;
  const Boundary* weir = nullptr;
  std::string name;
};

// ADCIRC would misread a weir's number without heights: the role's own number is written instead. It would close a part
// of an island's shore across the water.
int adcircType(const Boundary& boundary) {
  const Ibtype* const known = findIbtype(boundary.ibtype);
  if (known == nullptr || isBareWeir(boundary)) return ibtypeOf(boundary.role, boundary.closed);
  return isPartOfIsland(boundary) ? mainlandType(known->number) : known->number;
}

int typeOf(const Boundary& boundary, Fort14Kind kind) {
  if (kind == Fort14Kind::Adcirc) return adcircType(boundary);
  return boundary.role == BoundaryRole::Island && boundary.closed ? 1 : 0;
}

bool isOpen(const Boundary& boundary, Fort14Kind kind) {
  return boundary.role == BoundaryRole::Open || (kind == Fort14Kind::Schism && boundary.role == BoundaryRole::River);
}

std::vector<Segment> segmentsOf(const Grid& grid, Fort14Kind kind, bool open) {
  std::vector<Segment> segments;
  for (const Boundary& boundary : grid.boundaries) {
    if (isOpen(boundary, kind) != open || boundary.nodes.empty()) continue;
    const int type = open ? 0 : typeOf(boundary, kind);
    const bool weir = kind == Fort14Kind::Adcirc && !open && !boundary.weir.empty();
    const bool closes_itself = !open && findIbtype(type)->closesItself();
    if (!boundary.closed || closes_itself || weir) {
      segments.push_back({boundary.nodes, type, weir ? &boundary : nullptr, boundary.name});
      continue;
    }
    const auto begin = boundary.nodes.begin(), end = boundary.nodes.end(), middle = begin + (end - begin) / 2;
    segments.push_back({{begin, middle + 1}, type, nullptr, boundary.name});
    segments.push_back({{middle, end}, type, nullptr, boundary.name});
    segments.back().nodes.push_back(boundary.nodes.front());
  }
  return segments;
}

void writeSegments(TextWriter& file, const Grid& grid, Fort14Kind kind, bool open) {
  const std::vector<Segment> segments = segmentsOf(grid, kind, open);
  std::size_t nodes = 0;
  for (const Segment& segment : segments)
    nodes += segment.nodes.size() * (segment.weir != nullptr && !segment.weir->back_nodes.empty() ? 2 : 1);
  const char* const what = open ? "open boundaries" : "land boundaries";
  file << segments.size() << " = number of " << what << '\n' << nodes << " = number of nodes on " << what << '\n';
  std::size_t number = 0;
  for (const Segment& segment : segments) {
    file << segment.nodes.size();
    // ADCIRC reads a second number here, SCHISM only for land.
    if (!open || kind == Fort14Kind::Adcirc) file << ' ' << segment.type;
    file << " = number of nodes of " << (open ? "open" : "land") << " boundary " << ++number;
    if (!segment.name.empty()) file << kNameMark << oneLine(segment.name);
    file << '\n';
    for (std::size_t i = 0; i < segment.nodes.size(); ++i) {
      file << segment.nodes[i] + 1;
      if (segment.weir != nullptr) {
        const Boundary& weir = *segment.weir;
        if (!weir.back_nodes.empty()) file << ' ' << weir.back_nodes[i] + 1;
        const std::size_t values = weir.weir.size() / weir.nodes.size();
        for (std::size_t k = 0; k < values; ++k) file << ' ' << weir.weir[i * values + k];
      }
      file << '\n';
    }
  }
}

std::string oneLine(std::string title) {
  std::ranges::replace_if(
      title, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  const std::size_t first = title.find_first_not_of(" \t,"), last = title.find_last_not_of(" \t,");
  return first == std::string::npos ? std::string(kNoTitle) : title.substr(first, last - first + 1);
}

// Title, nodes with `valueAt(i)`, and elements.
template <typename ValueAt>
void writeMesh(TextWriter& file, const Grid& grid, std::span<const Point> places, Fort14Kind kind, const ItemLoop& loop,
               const ValueAt& valueAt) {
  // ADCIRC has triangles only.
  const std::optional<Elements> elements = kind == Fort14Kind::Schism ? std::optional<Elements>(grid) : std::nullopt;
  const std::size_t count = elements ? elements->size() : grid.triangles.size();
  file << oneLine(grid.title) << '\n' << count << ' ' << grid.nodes.size() << '\n';
  file.rows(loop, places.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << places[i].x << ' ' << places[i].y << ' ' << valueAt(i) << '\n';
  });
  file.rows(loop, count, [&](TextBlock& text, std::size_t i) {
    if (elements && elements->isQuad(i)) {
      const auto& [a, b, c, d] = elements->nodesOf(i).v;
      text << i + 1 << " 4 " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << ' ' << d + 1 << '\n';
      return;
    }
    const auto& [a, b, c] = grid.triangles[elements ? elements->triangleOf(i) : i];
    text << i + 1 << " 3 " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
  });
}

}  // namespace

void writeFort14(TextWriter& file, const Grid& grid, std::span<const Point> places, Fort14Kind kind,
                 const ItemLoop& loop) {
  writeMesh(file, grid, places, kind, loop,
            [&](std::size_t i) { return grid.z.empty() ? 0.0 : 0.0 - grid.z[i]; });  // never -0
  writeSegments(file, grid, kind, true);
  writeSegments(file, grid, kind, false);
}

void writeGr3Values(TextWriter& file, const Grid& grid, std::span<const double> values, const ItemLoop& loop) {
  writeMesh(file, grid, grid.nodes, Fort14Kind::Schism, loop, [&](std::size_t i) { return 0.0 + values[i]; });
}

namespace {

// The first line is the title even if it is blank; then, and if it stands for none, returns an empty text.
std::string readTitle(ListReader& file) {
  TextReader& text = file.text();
  return text.nextPhysicalLine() && text.hasWord() && text.line() != kNoTitle ? std::string(text.line())
                                                                              : std::string();
}

// The first number of a line, which may be followed by a comment. Nullopt at the end of the file.
std::optional<std::uint64_t> countLine(ListReader& file) {
  if (!file.nextStatement()) return std::nullopt;
  return file.count();
}

std::uint64_t needCountLine(ListReader& file) {
  file.needStatement();
  return file.count();
}

class NodeNumbers {
 public:
  NodeNumbers(std::vector<std::int64_t> ids, const ListReader& file) : index_(std::move(ids), file.text(), "node") {}

  std::uint32_t read(ListReader& file) const {
    const std::int64_t id = file.integer();
    const std::uint32_t node = index_.indexOf(id);
    if (node == kNone) file.fail("there is no node " + std::to_string(id));
    return node;
  }

 private:
  IdMap index_;
};

NodeNumbers readNodes(ListReader& file, std::uint64_t count, Grid& grid, std::vector<std::int64_t>* given_ids) {
  std::vector<std::int64_t> ids;
  bool in_order = true;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needStatement();
    ids.push_back(file.integer());
    in_order = in_order && ids.back() == static_cast<std::int64_t>(i) + 1;
    const double x = file.number(), y = file.number();
    grid.nodes.push_back({x, y});
    grid.z.push_back(0.0 - file.number());
  }
  if (!in_order) grid.notes.emplace_back("nodes are not numbered from 1 in their order");
  if (std::ranges::all_of(grid.z, [](double z) { return z == 0.0; })) grid.z.clear();
  if (given_ids != nullptr) *given_ids = ids;
  return {std::move(ids), file};
}

void readElements(ListReader& file, std::uint64_t count, const NodeNumbers& numbers, Grid& grid) {
  bool in_order = true;
  for (std::uint64_t t = 0; t < count; ++t) {
    file.needStatement();
    const std::int64_t id = file.integer();
    in_order = in_order && id == static_cast<std::int64_t>(t) + 1;
    const std::int64_t corners = file.integer();
    if (corners != 3 && corners != 4)
      file.fail("an element of " + std::to_string(corners) + forCount(corners, " node", " nodes") +
                "; only triangles and quadrilaterals can be read");
    std::array<std::uint32_t, 4> nodes;
    for (std::int64_t i = 0; i < corners; ++i) nodes[static_cast<std::size_t>(i)] = numbers.read(file);
    addElement(grid, std::span(nodes).first(static_cast<std::size_t>(corners)));
  }
  if (!in_order) grid.notes.emplace_back("elements are not numbered from 1 in their order");
}

void readNodesOf(ListReader& file, std::uint64_t count, const NodeNumbers& numbers, const Ibtype& type,
                 Boundary& boundary) {
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needStatement();
    boundary.nodes.push_back(numbers.read(file));
    if (type.has_back_nodes) boundary.back_nodes.push_back(numbers.read(file));
    for (std::size_t k = 0; k < type.values; ++k) boundary.weir.push_back(file.number());
  }
}

// The name after the number of a boundary, as `writeFort14` has it: "3 = number of nodes of open boundary 2: Thames".
std::string nameInComment(std::string_view line) {
  constexpr std::string_view kBefore = " boundary ";
  const std::size_t before = line.find(kBefore), mark = line.find(kNameMark);
  if (before == line.npos || mark == line.npos || mark < before + kBefore.size()) return {};
  const std::string_view number = line.substr(before + kBefore.size(), mark - before - kBefore.size());
  if (number.empty() || number.find_first_not_of("0123456789") != number.npos) return {};
  const std::string_view name = line.substr(mark + kNameMark.size());
  return std::string(name.substr(0, name.find_last_not_of(" \t\r") + 1));
}

void closeLoop(Boundary& boundary) {
  const bool repeats = boundary.nodes.size() > 1 && boundary.nodes.front() == boundary.nodes.back();
  boundary.closed = boundary.weir.empty() && (repeats || boundary.role == BoundaryRole::Island);
  boundary.repeats_first = repeats;
  if (boundary.closed && repeats) boundary.nodes.pop_back();
}

void readOpenSegments(ListReader& file, std::uint64_t count, const NodeNumbers& numbers, Grid& grid) {
  const std::uint64_t said = needCountLine(file);
  std::uint64_t nodes = 0;
  for (std::uint64_t s = 0; s < count; ++s) {
    Boundary boundary{BoundaryRole::Open, false, {}};
    const std::uint64_t length = needCountLine(file);
    boundary.name = nameInComment(file.text().line());
    readNodesOf(file, length, numbers, {}, boundary);
    nodes += length;
    closeLoop(boundary);
    grid.boundaries.push_back(std::move(boundary));
  }
  if (nodes != said)
    grid.notes.push_back("NETA is " + std::to_string(said) + ", but the open segments have " + std::to_string(nodes) +
                         " nodes");
}

void readLandSegments(ListReader& file, std::uint64_t count, const NodeNumbers& numbers, Grid& grid) {
  const std::uint64_t said = needCountLine(file);
  std::uint64_t nodes = 0;
  for (std::uint64_t s = 0; s < count; ++s) {
    const std::uint64_t length = needCountLine(file);
    const std::int64_t number = file.integer();
    const Ibtype* const type = number < 0 || number > 200 ? nullptr : findIbtype(static_cast<int>(number));
    if (type == nullptr) file.fail("ADCIRC has no boundary type " + std::to_string(number));
    Boundary boundary{type->role, false, {}, type->number};
    boundary.name = nameInComment(file.text().line());
    readNodesOf(file, length, numbers, *type, boundary);
    nodes += length + boundary.back_nodes.size();
    closeLoop(boundary);
    grid.boundaries.push_back(std::move(boundary));
  }
  if (nodes != said)
    grid.notes.push_back("NVEL is " + std::to_string(said) + ", but the land segments have " + std::to_string(nodes) +
                         " nodes");
}

}  // namespace

std::vector<double> readGr3Values(const std::string& path, const Grid& grid) {
  ListReader file(path);
  readTitle(file);
  const std::size_t own_elements = Elements(grid).size();
  file.needStatement();
  if (const std::uint64_t elements = file.count(), nodes = file.count();
      elements != own_elements || nodes != grid.nodes.size())
    throw InputError("'" + path + "' has " + std::to_string(elements) + forCount(elements, " element", " elements") +
                     " and " + std::to_string(nodes) + " nodes, but the mesh beside it has " +
                     std::to_string(own_elements) + " and " + std::to_string(grid.nodes.size()) +
                     ": give it another name if it belongs to another mesh");
  std::vector<double> values;
  values.reserve(grid.nodes.size());
  while (values.size() < grid.nodes.size()) {
    file.needStatement();
    file.integer();
    file.number(), file.number();
    values.push_back(file.number());
  }
  return values;
}

std::string openRingsText(const Grid& grid, const std::string& path) {
  const auto isOpenRing = [](const Boundary& boundary) {
    return boundary.closed && boundary.role == BoundaryRole::Open;
  };
  const auto rings = std::ranges::count_if(grid.boundaries, isOpenRing);
  if (rings == 0) return {};
  return std::to_string(rings) +
         forCount(static_cast<std::uint64_t>(rings), " open boundary is a ring, which '",
                  " open boundaries are rings, each of which '") +
         path + "' holds as two that share their ends";
}

Grid readFort14(const std::string& path, Crs crs, std::vector<std::int64_t>* ids) {
  ListReader file(path);
  Grid grid;
  grid.crs = std::move(crs);
  grid.title = readTitle(file);
  file.needStatement();
  const std::uint64_t elements = file.count(), nodes = file.count();
  const NodeNumbers numbers = readNodes(file, nodes, grid, ids);
  readElements(file, elements, numbers, grid);
  if (const auto open = countLine(file)) {
    readOpenSegments(file, *open, numbers, grid);
    if (const auto land = countLine(file)) readLandSegments(file, *land, numbers, grid);
  }
  return grid;
}

}  // namespace coastmesh
