#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>

#include "gis/error.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/geographic_nodes.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

using Index = std::uint32_t;
using Corners = std::array<Index, 3>;

constexpr std::string_view kMainFile = "rpart.out";
constexpr Index kMostParts = 99'999;  // files are numbered with five digits
// The size of FESOM2's arrays: MAX_NEIGHBOR_PARTITIONS.
constexpr std::size_t kMostNeighbours = 32;

// Rows of items: those of `row` are items[begin[row]] up to, not including, items[begin[row + 1]].
struct Rows {
  std::vector<std::size_t> begin;
  std::vector<Index> items;

  std::span<const Index> operator[](std::size_t row) const {
    return {items.data() + begin[row], begin[row + 1] - begin[row]};
  }
};

// The triangles around each node, ascending.
Rows trianglesRound(const std::vector<Corners>& triangles, std::size_t nodes) {
  Rows rows{std::vector<std::size_t>(nodes + 1, 0), std::vector<Index>(3 * triangles.size())};
  for (const Corners& corners : triangles)
    for (const Index node : corners) ++rows.begin[node + 1];
  for (std::size_t n = 0; n < nodes; ++n) rows.begin[n + 1] += rows.begin[n];
  std::vector<std::size_t> next(rows.begin.begin(), rows.begin.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (const Index node : triangles[t]) rows.items[next[node]++] = static_cast<Index>(t);
  return rows;
}

bool has(const Corners& corners, Index node) { return std::ranges::find(corners, node) != corners.end(); }

// True if the corners are counter-clockwise, seen from above.
bool turnsLeft(const Corners& corners, const std::vector<Point>& lonlat) {
  const auto at = [&](std::size_t i) { return onSphere(asLonLat(lonlat[corners[i]])); };
  return dot(at(0), cross(at(1), at(2))) > 0.0;
}

// FESOM2 has clockwise triangles: it swaps the second and third corners of counter-clockwise ones.
std::vector<Corners> clockwise(const Grid& grid, const std::vector<Point>& lonlat) {
  std::vector<Corners> triangles(grid.triangles.begin(), grid.triangles.end());
  for (Corners& corners : triangles)
    if (turnsLeft(corners, lonlat)) std::swap(corners[1], corners[2]);
  return triangles;
}

// Edges numbered as in FESOM2's edges.out: those with two triangles before those with one; within each group by lesser
// node, then in the order in which the triangles around that node and their corners list the other node.
struct Edges {
  std::vector<std::array<Index, 2>> ends;
  std::vector<Corners> of_triangle;  // from corner 1 to 2, from 2 to 3, from 3 to 1
};

Edges numberEdges(const std::vector<Corners>& triangles, const Rows& round, std::size_t nodes) {
  struct Named {
    Index from = 0, to = 0;
    bool inside = false;
  };
  std::vector<Named> named;
  std::vector<std::size_t> begin(nodes + 1, 0);  // for each node: its first edge in `named`
  std::vector<char> seen(nodes, 0);
  std::vector<Index> others;
  for (Index n = 0; n < nodes; ++n) {
    for (const Index t : round[n]) {
      for (const Index other : triangles[t]) {
        if (other == n || seen[other]) continue;
        seen[other] = 1;
        others.push_back(other);
      }
    }
    for (const Index other : others) {
      seen[other] = 0;
      if (other < n) continue;
      const auto both = std::ranges::count_if(round[n], [&](Index t) { return has(triangles[t], other); });
      named.push_back({n, other, both == 2});
    }
    others.clear();
    begin[n + 1] = named.size();
  }
  Edges edges;
  std::vector<Index> number(named.size());
  for (const bool inside : {true, false}) {
    for (std::size_t e = 0; e < named.size(); ++e) {
      if (named[e].inside != inside) continue;
      number[e] = static_cast<Index>(edges.ends.size());
      edges.ends.push_back({named[e].from, named[e].to});
    }
  }
  for (const Corners& corners : triangles) {
    Corners& of = edges.of_triangle.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [from, to] = std::minmax(corners[i], corners[(i + 1) % 3]);
      for (std::size_t e = begin[from]; e < begin[from + 1]; ++e)
        if (named[e].to == to) of[i] = number[e];
    }
  }
  return edges;
}

// For each process: pairs of another process and an item exchanged with it, ascending.
using Peer = std::pair<Index, Index>;
using Exchange = std::vector<std::vector<Peer>>;

void sortOut(Exchange& exchange) {
  for (auto& items : exchange) {
    std::ranges::sort(items);
    items.erase(std::ranges::unique(items).begin(), items.end());
  }
}

// What each process sends, given what each receives.
Exchange sentFor(const Exchange& received) {
  Exchange sent(received.size());
  for (Index part = 0; part < received.size(); ++part)
    for (const auto& [from, item] : received[part]) sent[from].emplace_back(part, item);
  sortOut(sent);
  return sent;
}

// A partitioned mesh: a process owns its nodes, and every triangle with one of them.
class Deal {
 public:
  Deal(const std::vector<Corners>& triangles, const std::vector<Index>& part_of, const Rows& round, Index parts)
      : triangles_(triangles), part_of_(part_of), round_(round), parts_(parts) {}

  bool owns(Index part, Index triangle) const {
    return std::ranges::any_of(triangles_[triangle], [&](Index node) { return part_of_[node] == part; });
  }

  // Nodes to receive: neighbours of a process's own nodes that others own.
  Exchange nodes() const {
    Exchange received(parts_);
    for (const Corners& corners : triangles_)
      for (const Index node : corners)
        for (const Index beside : corners)
          if (part_of_[beside] != part_of_[node]) received[part_of_[beside]].emplace_back(part_of_[node], node);
    sortOut(received);
    return received;
  }

  // Triangles to receive: not a process's own, but with at least `shared_nodes` corners (2: an edge) in common with one
  // of its own. The process of the first corner sends them.
  Exchange triangles(std::ptrdiff_t shared_nodes) const {
    Exchange received(parts_);
    for (Index t = 0; t < triangles_.size(); ++t) {
      const Corners& corners = triangles_[t];
      for (const Index node : corners) {
        for (const Index other : round_[node]) {
          for (const Index n : triangles_[other])
            if (!owns(part_of_[n], t) && shares(t, other) >= shared_nodes)
              received[part_of_[n]].emplace_back(part_of_[corners[0]], t);
        }
      }
    }
    sortOut(received);
    return received;
  }

 private:
  std::ptrdiff_t shares(Index t, Index other) const {
    return std::ranges::count_if(triangles_[other], [&](Index node) { return has(triangles_[t], node); });
  }

  const std::vector<Corners>& triangles_;
  const std::vector<Index>& part_of_;
  const Rows& round_;
  Index parts_;
};

// Writes numbers plus `first`, ten a line. An empty list is an empty line, since FESOM2 reads each list as a record.
void writeList(TextWriter& file, const std::vector<Index>& numbers, Index first = 1) {
  constexpr std::size_t kOnALine = 10;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    file << numbers[i] + first << (i + 1 == numbers.size() || i % kOnALine == kOnALine - 1 ? '\n' : ' ');
  if (numbers.empty()) file << '\n';
}

std::vector<Index> itemsOf(const std::vector<Peer>& peers) {
  std::vector<Index> items;
  for (const auto& [part, item] : peers) items.push_back(item);
  return items;
}

// Writes the peers, where the items of each begin, and the local numbers of the items.
void writePeers(TextWriter& file, const std::vector<Peer>& peers, const std::vector<Index>& local, Index part,
                const std::string& path) {
  std::vector<Index> parts, begins;
  for (Index i = 0; i < peers.size(); ++i) {
    if (!parts.empty() && parts.back() == peers[i].first) continue;
    parts.push_back(peers[i].first);
    begins.push_back(i);
  }
  begins.push_back(static_cast<Index>(peers.size()));
  if (parts.size() > kMostNeighbours)
    throw OutputError("'" + path + "': process " + std::to_string(part) + " has " + std::to_string(parts.size()) +
                      " neighbours, and FESOM2 has room for " + std::to_string(kMostNeighbours) +
                      ": take other parts, or make its MAX_NEIGHBOR_PARTITIONS larger and its own partition");
  file << parts.size() << '\n';
  writeList(file, parts, 0);
  writeList(file, begins);
  std::vector<Index> items;
  for (const auto& [peer, item] : peers) items.push_back(local[item]);
  writeList(file, items);
}

// The files of a set start with what precedes "rpart.out" in `path`; if it does not end in that, with `path` without
// its extension and an underscore.
std::string fileOf(const std::string& path, const char* kind, Index part) {
  std::string base = path;
  if (base.ends_with(kMainFile)) {
    base.resize(base.size() - kMainFile.size());
  } else {
    base = fs::path(path).replace_extension().string() + '_';
  }
  char name[40];
  std::snprintf(name, sizeof name, "%s%05u.out", kind, part);
  return base + name;
}

// rpart.out: the node count of each process, and the number of each node if nodes are numbered process after process.
void writeCounts(const std::string& path, const std::vector<Index>& part_of, Index parts) {
  std::vector<Index> counts(parts, 0), next(parts, 1);
  for (const Index part : part_of) ++counts[part];
  for (Index part = 1; part < parts; ++part) next[part] = next[part - 1] + counts[part - 1];
  TextWriter file(path);
  file << parts << '\n';
  writeList(file, counts, 0);
  for (const Index part : part_of) file << next[part]++ << '\n';
  file.close();
}

// Items of a process: its own, then those that it receives.
struct Owned {
  std::vector<Index> own, beside, beyond;  // `beyond`: triangles that share only a node
};

// FESOM2's dist_N for the mesh in its nod2d.out and elem2d.out: rpart.out, and for each process my_list00000.out (its
// nodes, triangles and edges) and com_info00000.out (its exchange with each other process). Edge numbers are those of
// the edges.out that FESOM2's partitioner writes once for a mesh. `path` is rpart.out. Throws OutputError, also for a
// mesh in a plane, and if a process has more neighbours than FESOM2 supports.
void writeFesomPartition(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const std::vector<Index>& part_of = grid.node_part_of;
  if (part_of.empty())
    throw OutputError("'" + path + "': the mesh has no parts: give mesh --partition, or run partition");
  const Index parts = *std::ranges::max_element(part_of) + 1;
  const std::vector<Corners> triangles = clockwise(grid, requireGeographicNodes(grid, path, "FESOM2", loop));
  const std::size_t nodes = grid.nodes.size();
  const Rows round = trianglesRound(triangles, nodes);
  const Edges edges = numberEdges(triangles, round, nodes);
  const Deal deal(triangles, part_of, round, parts);
  const Exchange node_in = deal.nodes(), edge_in = deal.triangles(2), all_in = deal.triangles(1);
  const Exchange node_out = sentFor(node_in), edge_out = sentFor(edge_in), all_out = sentFor(all_in);

  std::vector<Owned> of_nodes(parts), of_triangles(parts), of_edges(parts);
  for (Index n = 0; n < nodes; ++n) of_nodes[part_of[n]].own.push_back(n);
  const auto addTo = [&](std::vector<Owned>& owned, Index item, auto ends) {
    for (auto& end : ends) end = part_of[end];
    std::ranges::sort(ends);
    const auto last = std::ranges::unique(ends).begin();
    for (auto part = ends.begin(); part != last; ++part) owned[*part].own.push_back(item);
  };
  for (Index t = 0; t < triangles.size(); ++t) addTo(of_triangles, t, triangles[t]);
  for (Index e = 0; e < edges.ends.size(); ++e) addTo(of_edges, e, edges.ends[e]);

  writeCounts(path, part_of, parts);
  std::vector<Index> node_here(nodes), triangle_here(triangles.size());
  std::vector<char> taken(std::max(edges.ends.size(), triangles.size()), 0);
  for (Index part = 0; part < parts; ++part) {
    Owned& own_nodes = of_nodes[part];
    Owned& own_triangles = of_triangles[part];
    Owned& own_edges = of_edges[part];
    own_nodes.beside = itemsOf(node_in[part]);
    own_triangles.beside = itemsOf(edge_in[part]);
    for (const Index t : own_triangles.beside) taken[t] = 1;
    for (const auto& [peer, t] : all_in[part])
      if (taken[t] == 0) own_triangles.beyond.push_back(t);
    for (const Index t : own_triangles.beside) taken[t] = 0;
    for (const Index t : own_triangles.own) {
      for (const Index e : edges.of_triangle[t]) {
        const auto& [a, b] = edges.ends[e];
        if (part_of[a] == part || part_of[b] == part || taken[e] != 0) continue;
        taken[e] = 1;
        own_edges.beside.push_back(e);
      }
    }
    for (const Index e : own_edges.beside) taken[e] = 0;

    TextWriter list(fileOf(path, "my_list", part));
    list << part << '\n';
    for (const Owned* owned : {&own_nodes, &own_triangles, &own_edges}) {
      list << owned->own.size() << '\n' << owned->beside.size() << '\n';
      if (owned == &own_triangles) list << owned->beyond.size() << '\n';
      std::vector<Index> all = owned->own;
      all.insert(all.end(), owned->beside.begin(), owned->beside.end());
      all.insert(all.end(), owned->beyond.begin(), owned->beyond.end());
      writeList(list, all);
      auto& here = owned == &own_nodes ? node_here : triangle_here;
      for (Index i = 0; i < all.size() && owned != &own_edges; ++i) here[all[i]] = i;
    }
    list.close();
    TextWriter peers(fileOf(path, "com_info", part));
    peers << part << '\n';
    writePeers(peers, node_in[part], node_here, part, path);
    writePeers(peers, node_out[part], node_here, part, path);
    writePeers(peers, edge_in[part], triangle_here, part, path);
    writePeers(peers, edge_out[part], triangle_here, part, path);
    writePeers(peers, all_in[part], triangle_here, part, path);
    writePeers(peers, all_out[part], triangle_here, part, path);
    peers.close();
  }
}

// The number of processes N of the folder dist_N, where FESOM2 looks for the files. Throws OptionError for another
// folder.
Index partsOfFolder(const std::string& path) {
  const std::string folder = fs::absolute(path).parent_path().filename().string();
  constexpr std::string_view kBegin = "dist_";
  Index parts = 0;
  if (folder.starts_with(kBegin)) {
    const char* const end = folder.data() + folder.size();
    const auto read = std::from_chars(folder.data() + kBegin.size(), end, parts);
    if (read.ec != std::errc() || read.ptr != end) parts = 0;
  }
  if (parts == 0 || parts > kMostParts)
    throw OptionError("'" + path +
                      "': FESOM2 looks for it in a folder dist_N beside nod2d.out, N being how many processes there "
                      "are, such as dist_64/" +
                      std::string(kMainFile));
  return parts;
}

OutputFiles filesOfPartition(const std::string& path) {
  OutputFiles files{{path}, {}, {}};
  for (Index part = 0, parts = partsOfFolder(path); part < parts; ++part) {
    files.targets.push_back(fileOf(path, "my_list", part));
    files.targets.push_back(fileOf(path, "com_info", part));
  }
  return files;
}

}  // namespace

FormatRecord fesomPartitionFormat() {
  return {{.name = "fesom_partition",
           .endings = {kMainFile},
           .description = "FESOM2's rpart.out, my_list and com_info of a folder dist_N, for --partition",
           .writable = true,
           .holds = {GridPart::NodePartition},
           .beside_grid = true},
          {writeFesomPartition, nullptr, filesOfPartition}};
}

}  // namespace coastmesh
