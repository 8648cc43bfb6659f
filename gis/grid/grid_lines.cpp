#include "gis/grid/grid_lines.hpp"

#include <algorithm>
#include <cassert>

namespace coastmesh {

std::string_view toString(LineKind kind) {
  switch (kind) {
    case LineKind::Constraint:
      return "constraint";
    case LineKind::Weir:
      return "weir";
    case LineKind::RegionBorder:
      return "region border";
  }
  assert(false);
  return {};
}

std::optional<LineKind> lineKindNamed(std::string_view name) {
  for (const LineKind kind : kLineKinds)
    if (name == toString(kind)) return kind;
  return std::nullopt;
}

std::vector<NodePair> edgesOf(const GridLine& line) {
  std::vector<NodePair> edges;
  const std::vector<std::uint32_t>& nodes = line.nodes;
  for (std::size_t i = 1; i < nodes.size(); ++i) edges.push_back({nodes[i - 1], nodes[i]});
  if (line.closed && nodes.size() > 1) edges.push_back({nodes.back(), nodes.front()});
  return edges;
}

namespace {

// Edges from both of their ends, sorted.
class Star {
 public:
  explicit Star(std::vector<NodePair> edges) : from_(std::move(edges)) {
    const std::size_t count = from_.size();
    for (std::size_t i = 0; i < count; ++i) from_.push_back({from_[i][1], from_[i][0]});
    std::ranges::sort(from_);
    const auto repeated = std::ranges::unique(from_);
    from_.erase(repeated.begin(), repeated.end());
    used_.assign(from_.size(), false);
  }

  std::size_t size() const { return from_.size(); }
  bool isUsed(std::size_t i) const { return used_[i]; }
  std::uint32_t origin(std::size_t i) const { return from_[i][0]; }

  std::size_t degree(std::uint32_t node) const {
    const auto [first, last] = range(node);
    return last - first;
  }

  // Follows edges until a line ends, or a loop closes.
  std::vector<std::uint32_t> follow(std::size_t first) {
    std::vector<std::uint32_t> nodes{from_[first][0]};
    for (std::size_t at = first; at < from_.size(); at = next(at)) {
      use(at);
      nodes.push_back(from_[at][1]);
      if (nodes.back() == nodes.front() || degree(nodes.back()) != 2) break;
    }
    return nodes;
  }

 private:
  std::pair<std::size_t, std::size_t> range(std::uint32_t node) const {
    const auto found = std::ranges::equal_range(from_, node, {}, [](const NodePair& edge) { return edge[0]; });
    return {static_cast<std::size_t>(found.begin() - from_.begin()),
            static_cast<std::size_t>(found.end() - from_.begin())};
  }

  void use(std::size_t i) {
    used_[i] = true;
    const NodePair back{from_[i][1], from_[i][0]};
    used_[static_cast<std::size_t>(std::ranges::lower_bound(from_, back) - from_.begin())] = true;
  }

  // An unused edge at the end of this one; `size()` if there is none.
  std::size_t next(std::size_t i) const {
    const auto [first, last] = range(from_[i][1]);
    for (std::size_t at = first; at < last; ++at)
      if (!used_[at]) return at;
    return from_.size();
  }

  std::vector<NodePair> from_;
  std::vector<bool> used_;
};

}  // namespace

std::vector<GridLine> chainLines(std::vector<NodePair> edges, LineKind kind, const std::string& name) {
  Star star(std::move(edges));
  std::vector<GridLine> lines;
  for (const bool loops : {false, true}) {
    for (std::size_t i = 0; i < star.size(); ++i) {
      if (star.isUsed(i) || (!loops && star.degree(star.origin(i)) == 2)) continue;
      lines.push_back(lineOfNodes(kind, name, star.follow(i)));
    }
  }
  return lines;
}

std::vector<GridLine> linesAlong(const std::vector<NodePair>& edges, LineKind kind, const std::string& name) {
  if (edges.empty()) return {};
  std::vector<std::uint32_t> nodes{edges.front()[0]};
  for (const auto& [from, to] : edges) {
    const bool turns_back = nodes.size() > 1 && nodes[nodes.size() - 2] == to;
    if (from != nodes.back() || turns_back) return chainLines(edges, kind, name);
    nodes.push_back(to);
  }
  return {lineOfNodes(kind, name, std::move(nodes))};
}

GridLine lineOfNodes(LineKind kind, std::string name, std::vector<std::uint32_t> nodes) {
  const bool closed = nodes.size() > 3 && nodes.front() == nodes.back();
  if (closed) nodes.pop_back();
  return {kind, std::move(name), closed, std::move(nodes)};
}

}  // namespace coastmesh
