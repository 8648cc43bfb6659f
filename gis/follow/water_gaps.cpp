#include "gis/follow/water_gaps.hpp"

#include <algorithm>
#include <cmath>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Shares of the size.
constexpr double kThinned = 0.5;        // thinning changes widths by less
constexpr double kWide = 1.5;           // edges this long are taken as the width
constexpr double kLongestIsland = 4.0;  // thinning drops none that are longer
constexpr double kRock = 0.2;           // of the width: smaller islands do not divide it
constexpr int kMostSamples = 512;       // along a run
// Sides of a way, among the numbers of islands.
constexpr std::size_t kOrigin = std::numeric_limits<std::size_t>::max(), kTarget = kOrigin - 1;

bool haveCommonEnd(const std::pair<VertexId, VertexId>& a, const std::pair<VertexId, VertexId>& b) {
  return a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second;
}

}  // namespace

WaterGaps::WaterGaps(const ShoreData& data, double narrowest, const ItemLoop& loop)
    : t_(data.triangles),
      shores_(data.shores),
      narrowest_(narrowest),
      narrow_(edgeRef(static_cast<TriId>(t_.mesh.triangles.size()), 0), -1.0) {
  forEachByStretches(loop, t_.mesh.triangles.size(), [&](std::size_t i) {
    const auto t = static_cast<TriId>(i);
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeRef e = edgeRef(t, k), back = mesh().twin(e);
      if (e < back && back != kNone && isBelowNarrowest(e)) narrow_[e] = narrow_[back] = measured(e);
    }
  });
}

double WaterGaps::sizeAt(EdgeRef e) const { return std::min(t_.size[triOf(e)], t_.size[triOf(mesh().twin(e))]); }

bool WaterGaps::isShore(EdgeRef e) const {
  const EdgeRef back = mesh().twin(e);
  return back != kNone && mesh().regions[triOf(e)] != t_.land && mesh().regions[triOf(back)] == t_.land;
}

// Edges of shores with the water to their left that begin or end in v.
template <typename Visit>
void WaterGaps::forShoreAt(VertexId v, Visit&& visit) const {
  forTrianglesRound(t_, v, [&](TriId t) {
    const unsigned corner = mesh().cornerOf(t, v);
    for (const unsigned side : {prev3(corner), next3(corner)})
      if (isShore(edgeRef(t, side))) visit(edgeRef(t, side));
  });
}

double WaterGaps::leastTo(VertexId v, VertexId from) const {
  const Point& x = mesh().point(from);
  double least = kInfinity;
  forShoreAt(v, [&](EdgeRef e) {
    const VertexId a = mesh().origin(e), b = mesh().target(e);
    if (a != from && b != from) least = std::min(least, squaredDistanceToSegment(x, mesh().point(a), mesh().point(b)));
  });
  return least;
}

double WaterGaps::share(EdgeRef e) const { return isNarrow(e) ? narrow_[e] : measured(e); }

double WaterGaps::measured(EdgeRef e) const {
  const VertexId a = mesh().origin(e), b = mesh().target(e);
  if (isOffShore(t_, a) || isOffShore(t_, b)) return kInfinity;
  const double size = sizeAt(e), length = distance(mesh().point(a), mesh().point(b));
  if (length >= kWide * size) return length / size;
  return std::min(length, std::sqrt(std::min(leastTo(a, b), leastTo(b, a)))) / size;
}

bool WaterGaps::isBelowNarrowest(EdgeRef e) const {
  if (mesh().regions[triOf(e)] == t_.land || mesh().regions[triOf(mesh().twin(e))] == t_.land) return false;
  const VertexId a = mesh().origin(e), b = mesh().target(e);
  if (isOffShore(t_, a) || isOffShore(t_, b)) return false;
  const double width = narrowest_ * sizeAt(e);
  return squaredDistance(mesh().point(a), mesh().point(b)) < width * width || measured(e) < narrowest_;
}

// The next vertex of the data along the shore from v, which may be one itself; kNone if there is none near.
VertexId WaterGaps::follow(VertexId v, bool ahead) const {
  for (int i = 0; i < kMostSamples && t_.source[v] == kNone; ++i) {
    VertexId next = kNone;
    forShoreAt(v, [&](EdgeRef e) {
      if ((ahead ? mesh().origin(e) : mesh().target(e)) == v) next = ahead ? mesh().target(e) : mesh().origin(e);
    });
    if (next == kNone) return kNone;
    v = next;
  }
  return t_.source[v] == kNone ? kNone : v;
}

// The edge itself if it is between no vertices of the data.
WaterGaps::Run WaterGaps::runOf(EdgeRef shore) const {
  const VertexId first = follow(mesh().origin(shore), false), last = follow(mesh().target(shore), true);
  if (first == kNone || last == kNone) return {mesh().origin(shore), mesh().target(shore)};
  return {first, last};
}

std::vector<WaterGaps::Run> WaterGaps::runsAt(VertexId v) const {
  std::vector<Run> runs;
  forShoreAt(v, [&](EdgeRef e) {
    const Run run = runOf(e);
    if (std::ranges::find(runs, run) == runs.end()) runs.push_back(run);
  });
  return runs;
}

// The runs at both ends of these edges, as in the data.
WaterGaps::Lines WaterGaps::linesOf(const std::vector<std::vector<Measured>>& ways) const {
  Lines lines;
  for (const std::vector<Measured>& way : ways)
    for (const Measured& at : way)
      for (const VertexId v : {mesh().origin(at.edge), mesh().target(at.edge)})
        for (const Run& run : runsAt(v)) lines.try_emplace(run);
  std::vector<Point> firsts;
  for (const auto& [run, line] : lines) firsts.push_back(mesh().point(run.first));
  const std::vector<VertexId> found = shores_.find(firsts);
  std::size_t i = 0;
  for (auto& [run, line] : lines) {
    const Point &a = mesh().point(run.first), &b = mesh().point(run.second);
    const VertexId first = found[i++];
    const double reach = kThinned * t_.size[t_.home[run.first]];
    if (first != kNone) line = shores_.piece(first, b, Box::of(a, b).grownBy(reach));
    if (line.empty()) line = {a, b};
  }
  return lines;
}

ShoreGap WaterGaps::gapAt(EdgeRef e, const Lines& lines) const {
  const VertexId a = mesh().origin(e), b = mesh().target(e);
  ShoreGap least{kInfinity, midpoint(mesh().point(a), mesh().point(b))};
  for (const Run& one : runsAt(a)) {
    for (const Run& other : runsAt(b)) {
      if (haveCommonEnd(one, other)) continue;
      const ShoreGap gap = gapBetween(lines.at(one), lines.at(other));
      if (gap.width < least.width) least = gap;
    }
  }
  if (least.width == kInfinity) least.width = share(e) * sizeAt(e);  // a corner
  return least;
}

// True if the shore at v is the island's.
bool WaterGaps::isOn(VertexId v, const std::vector<Point>& island) const {
  return std::ranges::any_of(
      runsAt(v), [&](const Run& run) { return std::ranges::find(island, mesh().point(run.first)) != island.end(); });
}

// Islands across an edge from its origin to its target, between the sides of the way; without those at its ends, and
// those that take hardly any of its length.
std::vector<std::size_t> WaterGaps::rowAcross(EdgeRef e, const std::vector<std::size_t>& across,
                                              const Islands& islands) const {
  const Point &a = mesh().point(mesh().origin(e)), along = mesh().point(mesh().target(e)) - a;
  const double length = std::sqrt(squaredLength(along));
  std::vector<std::pair<double, std::size_t>> sorted;
  for (const std::size_t island : across) {
    if (isOn(mesh().origin(e), islands.rings[island]) || isOn(mesh().target(e), islands.rings[island])) continue;
    double first = kInfinity, last = -kInfinity;
    for (const Point& p : islands.rings[island]) {
      const double at = dot(p - a, along) / length;
      first = std::min(first, at);
      last = std::max(last, at);
    }
    if (last - first >= kRock * length) sorted.emplace_back(first + last, island);
  }
  std::ranges::sort(sorted);
  std::vector<std::size_t> row{kOrigin};
  for (const auto& [at, island] : sorted) row.push_back(island);
  row.push_back(kTarget);
  return row;
}

// The edges where a way may be narrowest: those with islands, and those that thinning may have made seem wider than
// others.
std::vector<std::vector<WaterGaps::Measured>> WaterGaps::measuredOf(const std::vector<std::vector<EdgeRef>>& ways,
                                                                    Islands& islands) const {
  std::vector<DataShores::Across> lines;
  for (const std::vector<EdgeRef>& way : ways)
    for (const EdgeRef e : way)
      lines.push_back({mesh().point(mesh().origin(e)), mesh().point(mesh().target(e)), kLongestIsland * sizeAt(e)});
  islands = shores_.islandsAcross(lines);
  std::vector<std::vector<Measured>> measured(ways.size());
  auto across = islands.across.begin();
  for (std::size_t i = 0; i < ways.size(); ++i) {
    double least = kInfinity;
    for (const EdgeRef e : ways[i]) least = std::min(least, share(e));
    for (const EdgeRef e : ways[i]) {
      const std::vector<std::size_t> row = rowAcross(e, *across++, islands);
      if (const double width = share(e); width < kInfinity && (width <= least + kThinned || row.size() > 2))
        measured[i].push_back({e, row});
    }
  }
  return measured;
}

void WaterGaps::addChannels(const Measured& at, const Lines& lines, const Islands& islands, Channels& channels) const {
  const auto linesOn = [&](std::size_t side) {
    std::vector<const std::vector<Point>*> found;
    if (side < kTarget) return std::vector{&islands.rings[side]};
    for (const Run& run : runsAt(side == kOrigin ? mesh().origin(at.edge) : mesh().target(at.edge)))
      found.push_back(&lines.at(run));
    return found;
  };
  for (std::size_t i = 0; i + 1 < at.row.size(); ++i) {
    ShoreGap& least = channels.try_emplace({at.row[i], at.row[i + 1]}, ShoreGap{kInfinity, {}}).first->second;
    for (const auto* one : linesOn(at.row[i]))
      for (const auto* other : linesOn(at.row[i + 1]))
        if (const ShoreGap gap = gapBetween(*one, *other); gap.width < least.width) least = gap;
  }
}

std::vector<NarrowPlace> WaterGaps::narrowest(const std::vector<std::vector<EdgeRef>>& ways, double least) const {
  Islands islands;
  const std::vector<std::vector<Measured>> measured = measuredOf(ways, islands);
  const Lines lines = linesOf(measured);
  std::vector<NarrowPlace> places(ways.size());
  for (std::size_t i = 0; i < ways.size(); ++i) {
    Channels channels;
    for (const Measured& at : measured[i])
      if (at.row.size() > 2) addChannels(at, lines, islands, channels);
    for (const Measured& at : measured[i]) {
      ShoreGap gap;
      if (at.row.size() == 2) gap = gapAt(at.edge, lines);
      for (std::size_t k = 0; at.row.size() > 2 && k + 1 < at.row.size(); ++k)
        if (const ShoreGap& other = channels.at({at.row[k], at.row[k + 1]}); other.width > gap.width) gap = other;
      const double share = gap.width / sizeAt(at.edge);
      if (share < least) places[i].too_narrow.push_back(at.edge);
      if (share >= places[i].share) continue;
      places[i].gap = gap;
      places[i].share = share;
    }
  }
  return places;
}

}  // namespace coastmesh
