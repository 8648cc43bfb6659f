#include "gis/format/read_gmsh.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

using Tag = std::int64_t;

template <std::size_t Corners>
struct Element {
  Tag tag = 0;
  Tag physical = 0;
  Tag entity = 0;
  Tag part = 0;  // from 1; 0: none
  std::array<Tag, Corners> nodes{};
};

struct Contents {
  std::map<std::pair<int, Tag>, std::string> names;  // of physical groups, by dimension and tag
  std::map<std::pair<int, Tag>, Tag> physical_of;    // of entities, by dimension and tag
  struct Origin {
    Tag entity = 0;
    Tag part = 0;
  };
  std::map<std::pair<int, Tag>, Origin> origin_of;  // of partitioned entities, by dimension and tag
  std::vector<Tag> node_tags;
  std::vector<std::array<double, 3>> places;
  std::vector<Element<2>> lines;
  std::vector<Element<4>> faces;  // a triangle has kNoNode as its fourth node
  std::vector<std::pair<Tag, double>> z;
};

constexpr int kPointType = 15;
constexpr Tag kNoNode = std::numeric_limits<Tag>::min();

void readPhysicalNames(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t count = file.count();
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    const int dimension = static_cast<int>(file.integer());
    const Tag tag = file.integer();
    const std::string_view line = file.line();
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == std::string_view::npos || close <= open) file.fail("a name in quotes is expected");
    contents.names[{dimension, tag}] = std::string(line.substr(open + 1, close - open - 1));
  }
}

void readEntities(TextReader& file, Contents& contents) {
  file.needLine();
  const std::array<std::uint64_t, 3> counts{file.count(), file.count(), file.count()};
  for (int dimension = 0; dimension < 3; ++dimension) {
    for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      file.needLine();
      const Tag tag = file.integer();
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) file.number();
      if (file.count() > 0) contents.physical_of[{dimension, tag}] = std::abs(file.integer());
    }
  }
}

// An entity between parts lists several of them; the first counts.
void readPartitionedEntities(TextReader& file, Contents& contents) {
  file.needLine();
  file.count();  // parts
  file.needLine();
  const std::uint64_t ghosts = file.count();
  for (std::uint64_t i = 0; i < ghosts; ++i) file.needLine();
  file.needLine();
  const std::array<std::uint64_t, 3> counts{file.count(), file.count(), file.count()};
  for (int dimension = 0; dimension < 3; ++dimension) {
    for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) {
      file.needLine();
      const Tag tag = file.integer();
      const std::int64_t parent_dimension = file.integer();
      const Tag parent = file.integer();
      const std::uint64_t parts = file.count();
      Tag part = 0;
      for (std::uint64_t k = 0; k < parts; ++k) {
        const Tag next = file.integer();
        if (k == 0) part = next;
      }
      for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) file.number();
      if (file.count() > 0) contents.physical_of[{dimension, tag}] = std::abs(file.integer());
      contents.origin_of[{dimension, tag}] = {parent_dimension == dimension ? parent : tag, part};
    }
  }
}

void addNode(TextReader& file, Tag tag, Contents& contents) {
  contents.node_tags.push_back(tag);
  const double x = file.number(), y = file.number(), z = file.number();
  contents.places.push_back({x, y, z});
}

void readNodes41(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t blocks = file.count();
  std::vector<Tag> tags;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    file.needLine();
    file.integer();
    file.integer();
    file.integer();
    const std::uint64_t count = file.count();
    tags.clear();
    for (std::uint64_t i = 0; i < count; ++i) {
      file.needLine();
      tags.push_back(file.integer());
    }
    for (const Tag tag : tags) {
      file.needLine();
      addNode(file, tag, contents);
    }
  }
}

void readNodes22(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t count = file.count();
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    const Tag tag = file.integer();
    addNode(file, tag, contents);
  }
}

// REQUIRES: the next words of the line are the nodes of the element.
void addElement(TextReader& file, std::int64_t type, Tag tag, Tag physical, Contents::Origin of, Contents& contents) {
  if (type == 1) {
    const Tag a = file.integer(), b = file.integer();
    contents.lines.push_back({tag, physical, of.entity, of.part, {a, b}});
  } else if (type == 2) {
    const Tag a = file.integer(), b = file.integer(), c = file.integer();
    contents.faces.push_back({tag, physical, of.entity, of.part, {a, b, c, kNoNode}});
  } else if (type == 3) {
    const Tag a = file.integer(), b = file.integer(), c = file.integer(), d = file.integer();
    contents.faces.push_back({tag, physical, of.entity, of.part, {a, b, c, d}});
  } else if (type != kPointType) {
    file.fail("an element of type " + std::to_string(type) +
              "; only triangles with three nodes and quadrilaterals with four can be read");
  }
}

void readElements41(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t blocks = file.count();
  for (std::uint64_t b = 0; b < blocks; ++b) {
    file.needLine();
    const int dimension = static_cast<int>(file.integer());
    const Tag entity = file.integer();
    const std::int64_t type = file.integer();
    const std::uint64_t count = file.count();
    const auto physical = contents.physical_of.find({dimension, entity});
    const auto origin = contents.origin_of.find({dimension, entity});
    const Contents::Origin of = origin == contents.origin_of.end() ? Contents::Origin{entity, 0} : origin->second;
    for (std::uint64_t i = 0; i < count; ++i) {
      file.needLine();
      const Tag tag = file.integer();
      addElement(file, type, tag, physical == contents.physical_of.end() ? 0 : physical->second, of, contents);
    }
  }
}

void readElements22(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t count = file.count();
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    const Tag tag = file.integer();
    const std::int64_t type = file.integer();
    const std::uint64_t tags = file.count();
    Tag physical = 0, entity = 0;
    for (std::uint64_t k = 0; k < tags && file.hasWord(); ++k) {
      const Tag value = file.integer();
      if (k == 0) physical = value;
      if (k == 1) entity = value;
    }
    addElement(file, type, tag, physical, {entity, 0}, contents);
  }
}

void readNodeData(TextReader& file, Contents& contents) {
  file.needLine();
  const std::uint64_t strings = file.count();
  std::string name;
  for (std::uint64_t i = 0; i < strings; ++i) {
    file.needLine();
    if (i == 0) name = std::string(file.word());
  }
  file.needLine();
  const std::uint64_t reals = file.count();
  for (std::uint64_t i = 0; i < reals; ++i) file.needLine();
  file.needLine();
  const std::uint64_t integers = file.count();
  std::vector<std::int64_t> values;
  for (std::uint64_t i = 0; i < integers; ++i) {
    file.needLine();
    values.push_back(file.integer());
  }
  if (name != "\"z\"" || !contents.z.empty() || values.size() < 3 || values[1] != 1) return;
  for (std::int64_t i = 0; i < values[2]; ++i) {
    file.needLine();
    const Tag tag = file.integer();
    contents.z.emplace_back(tag, file.number());
  }
}

void skipTo(TextReader& file, const std::string& end) {
  do file.needLine();
  while (!file.line().starts_with(end));
}

Contents readSections(TextReader& file) {
  Contents contents;
  enum { kUnknown, kVersion2, kVersion41 } version = kUnknown;
  while (file.nextLine()) {
    const std::string section(file.word());
    if (!section.starts_with('$')) file.fail("a section is expected, such as $Nodes");
    const std::string end = "$End" + section.substr(1);
    if (section == "$MeshFormat") {
      file.needLine();
      const std::string name(file.word());
      if (name != "4.1" && name != "2" && name != "2.0" && name != "2.1" && name != "2.2")
        file.fail("version " + name + " of Gmsh's format cannot be read; save it as 4.1 or 2.2");
      if (file.count() != 0) file.fail("a binary file; save it as ASCII");
      version = name == "4.1" ? kVersion41 : kVersion2;
    } else if (version == kUnknown && section != "$Comments") {
      file.fail("a Gmsh file starts with $MeshFormat");
    } else if (section == "$PhysicalNames") {
      readPhysicalNames(file, contents);
    } else if (section == "$Entities") {
      readEntities(file, contents);
    } else if (section == "$PartitionedEntities") {
      readPartitionedEntities(file, contents);
    } else if (section == "$Nodes" || section == "$ParametricNodes") {
      // Parameters on a curve or surface follow the coordinates.
      version == kVersion41 ? readNodes41(file, contents) : readNodes22(file, contents);
    } else if (section == "$Elements") {
      version == kVersion41 ? readElements41(file, contents) : readElements22(file, contents);
    } else if (section == "$NodeData") {
      readNodeData(file, contents);
    }
    skipTo(file, end);
  }
  return contents;
}

std::uint32_t nodeOf(const IdMap& node_index, Tag tag, const std::string& path) {
  const std::uint32_t node = node_index.indexOf(tag);
  if (node == kNone) throw InputError("'" + path + "': there is no node " + std::to_string(tag));
  return node;
}

void sortByTag(Contents& contents) {
  std::vector<std::uint32_t> order(contents.node_tags.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return contents.node_tags[i]; });
  std::vector<Tag> tags;
  std::vector<std::array<double, 3>> places;
  tags.reserve(order.size());
  places.reserve(order.size());
  for (std::uint32_t i : order) {
    tags.push_back(contents.node_tags[i]);
    places.push_back(contents.places[i]);
  }
  contents.node_tags = std::move(tags);
  contents.places = std::move(places);
  std::ranges::stable_sort(contents.faces, {}, &Element<4>::tag);
  // Sorting by tag rejoins lines that partitioning cut.
  if (!contents.origin_of.empty()) std::ranges::stable_sort(contents.lines, {}, &Element<2>::tag);
}

void readParts(const Contents& contents, Grid& grid) {
  if (std::ranges::all_of(contents.faces, [](const auto& face) { return face.part < 1; })) return;
  for (const auto& face : contents.faces)
    grid.part_of.push_back(static_cast<std::uint32_t>(std::clamp<Tag>(face.part - 1, 0, 4'000'000'000)));
}

void readZ(const Contents& contents, const IdMap& node_index, const std::string& path, Grid& grid) {
  if (!contents.z.empty()) {
    grid.z.assign(grid.nodes.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& [tag, z] : contents.z) grid.z[nodeOf(node_index, tag, path)] = z;
  } else if (std::ranges::any_of(contents.places, [](const auto& place) { return place[2] != 0.0; })) {
    for (const auto& place : contents.places) grid.z.push_back(place[2]);
  }
}

std::string nameOf(const Contents& contents, int dimension, Tag physical) {
  const auto name = contents.names.find({dimension, physical});
  return name == contents.names.end() ? std::string() : name->second;
}

void readFeatures(const Contents& contents, Grid& grid) {
  std::map<Tag, std::uint32_t> index_of;
  for (const auto& face : contents.faces) index_of.emplace(face.physical, 0);
  if (index_of.size() == 1) {
    const std::string name = nameOf(contents, 2, index_of.begin()->first);
    if (name.empty() || name == "domain") return;
  }
  for (auto& [physical, index] : index_of) {
    index = static_cast<std::uint32_t>(grid.features.size());
    grid.features.push_back(featureOfLabel(nameOf(contents, 2, physical), physical));
  }
  for (const auto& face : contents.faces) grid.feature_of.push_back(index_of[face.physical]);
}

std::optional<BoundaryRole> roleOfName(const std::string& given) {
  const std::string name = lowerCase(given);
  for (const BoundaryRole role : kBoundaryRoles)
    if (name.starts_with(toString(role))) return role;
  // "Ocean 2"; shores are told from islands by their shape.
  const auto role = roleOfWord(name.substr(0, name.find_last_not_of(" _-0123456789") + 1));
  return role == BoundaryRole::Land ? std::nullopt : role;
}

// ADCIRC's type at the end of a name that `writeGmsh` gave; -1 if there is none.
int ibtypeOfName(const std::string& name) {
  const std::size_t mark = name.rfind(kIbtypeMark);
  int type = -1;
  if (mark != std::string::npos)
    std::from_chars(name.data() + mark + kIbtypeMark.size(), name.data() + name.size(), type);
  return type;
}

// The name in one that `writeGmsh` gave: "Thames" in "river 5 Thames ibtype 52". Empty if there is none.
std::string nameInName(const std::string& name) {
  const std::size_t number = name.find(' ');
  if (number == std::string::npos) return {};
  const std::size_t end = name.find_first_not_of("0123456789", number + 1);
  if (end == std::string::npos || end == number + 1 || name[end] != ' ') return {};
  const std::size_t mark = ibtypeOfName(name) >= 0 ? name.rfind(kIbtypeMark) : name.size();
  return mark > end ? name.substr(end + 1, mark - end - 1) : std::string();
}

// "weir North" is a weir called "North"; names given by other programs are kept, and their lines are constraints.
std::pair<LineKind, std::string> lineOfName(const std::string& name) {
  for (const LineKind kind : kLineKinds) {
    const std::string_view word = toString(kind);
    if (name == word) return {kind, ""};
    if (name.starts_with(std::string(word) + ' ')) return {kind, name.substr(word.size() + 1)};
  }
  return {LineKind::Constraint, name};
}

// Makes boundaries of line elements along the mesh's boundary, by physical group, and lines of those inside, by
// physical group and curve.
void readCurves(const Contents& contents, const IdMap& node_index, const std::string& path, Grid& grid) {
  std::vector<std::pair<Tag, Tag>> keys;  // physical group and curve, in the order of their first elements
  std::map<std::pair<Tag, Tag>, std::size_t> group_of;
  std::vector<std::vector<NodePair>> groups;
  for (const auto& line : contents.lines) {
    const std::pair key{line.physical, line.entity};
    const auto [at, added] = group_of.emplace(key, groups.size());
    if (added) {
      groups.emplace_back();
      keys.push_back(key);
    }
    groups[at->second].push_back({nodeOf(node_index, line.nodes[0], path), nodeOf(node_index, line.nodes[1], path)});
  }
  const std::vector<std::vector<NodePair>> inner = keepBoundaryEdges(grid.triangles, groups);
  std::vector<std::pair<Tag, std::vector<NodePair>>>
      boundaries;  // by physical group, in the order of their first elements
  std::map<Tag, std::size_t> boundary_of;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Tag physical = keys[g].first;
    const auto [boundary, added] = boundary_of.emplace(physical, boundaries.size());
    if (added) boundaries.push_back({physical, {}});
    std::vector<NodePair>& edges = boundaries[boundary->second].second;
    edges.insert(edges.end(), groups[g].begin(), groups[g].end());
    const auto [kind, name] = lineOfName(nameOf(contents, 1, physical));
    std::ranges::move(linesAlong(inner[g], kind, name), std::back_inserter(grid.lines));
  }
  for (const auto& [physical, edges] : boundaries) {
    const std::string name = nameOf(contents, 1, physical);
    const auto role = roleOfName(name);
    for (Boundary& chain : chainEdges(edges)) {
      const BoundaryRole by_shape = chain.closed ? roleOfLoop(grid.nodes, chain.nodes, grid.crs) : BoundaryRole::Land;
      chain.role = role.value_or(by_shape);
      chain.ibtype = role ? ibtypeOfName(name) : -1;
      if (role) chain.name = nameInName(name);
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

}  // namespace

Grid readGmsh(const std::string& path, const Crs& unsaid) {
  TextReader file(path);
  Contents contents = readSections(file);
  sortByTag(contents);
  Grid grid;
  grid.crs = readPrjBeside(path, unsaid);
  const IdMap node_index(contents.node_tags, file, "node");
  for (const auto& place : contents.places) grid.nodes.push_back({place[0], place[1]});
  std::vector<std::uint32_t> nodes;
  for (const auto& face : contents.faces) {
    nodes.clear();
    for (const Tag tag : face.nodes)
      if (tag != kNoNode) nodes.push_back(nodeOf(node_index, tag, path));
    addElement(grid, nodes);
  }
  readZ(contents, node_index, path, grid);
  readFeatures(contents, grid);
  readParts(contents, grid);
  giveToHalves(Elements(grid), grid);
  readCurves(contents, node_index, path, grid);
  return grid;
}

}  // namespace coastmesh
