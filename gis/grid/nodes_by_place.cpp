#include "gis/grid/nodes_by_place.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "core/ids.hpp"

namespace coastmesh {

void NodesByPlace::add(const Point& place, std::uint32_t node) {
  const auto [at, added] = first_.emplace(place, node);
  if (next_.size() <= node) next_.resize(node + 1, kNone);
  if (added) return;
  next_[node] = std::exchange(next_[at->second], node);
}

std::uint32_t NodesByPlace::firstAt(const Point& place) const {
  const auto at = first_.find(place);
  return at == first_.end() ? kNone : at->second;
}

std::vector<std::uint32_t> NodesByPlace::allAt(const Point& place) const {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t node = firstAt(place); node != kNone; node = next_[node]) nodes.push_back(node);
  return nodes;
}

LineNodes::LineNodes(const Grid& grid, Along along) : grid_(grid), along_(along) {}

std::vector<std::uint32_t> LineNodes::of(std::vector<std::vector<std::uint32_t>> choices, bool closed) {
  std::vector<std::uint32_t> first;
  bool several = false;
  for (const auto& nodes : choices) {
    first.push_back(nodes.front());
    several = several || nodes.size() > 1;
  }
  if (!several || choices.size() < 2) return first;
  if (edges_.empty())
    for (const auto& t : grid_.triangles)
      for (unsigned i = 0; i < 3; ++i) edges_.insert({t[i], t[(i + 1) % 3]});
  std::vector<std::uint32_t> found = find(choices, closed);
  if (found.empty() && closed) found = find(choices, false);
  return found.empty() ? first : found;
}

std::vector<std::uint32_t> LineNodes::find(std::vector<std::vector<std::uint32_t>> choices, bool closed) const {
  const std::vector<std::uint32_t> starts = choices.front();
  for (const std::uint32_t start : starts) {
    choices.front() = {start};
    if (closed) choices.back() = {start};
    if (std::vector<std::uint32_t> found = follow(choices); !found.empty()) return found;
  }
  return {};
}

bool LineNodes::joined(std::uint32_t a, std::uint32_t b) const {
  return edges_.contains({a, b}) && edges_.contains({b, a}) == (along_ == Along::Inside);
}

std::vector<std::uint32_t> LineNodes::follow(const std::vector<std::vector<std::uint32_t>>& choices) const {
  std::vector<std::map<std::uint32_t, std::uint32_t>> before(choices.size());  // by node: the one before it
  before[0].emplace(choices[0].front(), kNone);
  for (std::size_t i = 1; i < choices.size(); ++i)
    for (const std::uint32_t node : choices[i])
      for (const auto& [from, unused] : before[i - 1])
        if (joined(from, node)) before[i].emplace(node, from);
  if (before.back().empty()) return {};
  std::vector<std::uint32_t> nodes{before.back().begin()->first};
  for (std::size_t i = choices.size() - 1; i > 0; --i) nodes.push_back(before[i].at(nodes.back()));
  std::ranges::reverse(nodes);
  return nodes;
}

}  // namespace coastmesh
