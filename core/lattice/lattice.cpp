#include "core/lattice/lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr double kRowHeight = 0.86602540378443865;  // of an equilateral triangle with edges of length 1
// Minimum distance of places to segments and points of the input, in spacings: refinement makes better shapes there
// than fit between the input and a lattice. Under a longest edge it also makes more triangles, hence the second.
constexpr double kClearanceOfLengths = 2.0, kClearanceUnderABound = 1.0;
// A longest edge is a bound, which rounding must not break.
constexpr double kBelowTheBound = 1.0 - 1e-6;
// Lengths down to this share of the longest one share a lattice.
constexpr double kSameLength = 0.87;
// If lengths vary, they are sampled first at about this many places.
constexpr double kProbes = 16384.0;
// Most lattice places to examine, as a multiple of the expected vertices.
constexpr double kMostLooks = 2.0;
// A lattice of fewer places is not worth its boundary with the rest of the mesh.
constexpr double kFewestPlaces = 100.0;
// Most rows or columns: longer domains are slivers with hardly a place inside.
constexpr double kMostRows = 1e7;

// The spacing under a longest edge, as a share of it. At 1 no lattice vertex can move: beside the shore each inserted
// point requires another, without end, unless halves of equilateral triangles meet the bounds. Found by trial on the
// Great Lakes: the fewest triangles without long repairs.
double shareOfLongest(const LatticeWishes& wishes) {
  constexpr double kOfHalves = 30.0, kEasy = 36.0, kHard = 38.0, kObtuse = 120.0;
  if (wishes.min_angle_deg > kHard || wishes.max_angle_deg < kObtuse) return 0.87;
  if (wishes.min_angle_deg > kEasy) return 0.95;
  return wishes.min_angle_deg < kOfHalves ? kBelowTheBound : 0.98;
}

struct Box {
  Point least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point most{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void take(const Point& p) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
};

struct Extent {
  Box box;
  double area = 0.0;
};

Extent extentOf(const TriMesh& mesh, const ItemLoop& loop) {
  const auto extentIn = [&](std::size_t first, std::size_t last) {
    Extent some;
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = mesh.triangles[t].v;
      const std::array<Point, 3> corners{mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])};
      some.area += 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
      for (const Point& p : corners) some.box.take(p);
    }
    return some;
  };
  Extent all;
  for (const Extent& some : overStretches(loop, mesh.triangles.size(), extentIn)) {
    all.area += some.area;
    for (const Point& p : {some.box.least, some.box.most}) all.box.take(p);
  }
  return all;
}

bool isTooLong(const Box& box, double spacing) {
  return !(std::max(box.most.x - box.least.x, box.most.y - box.least.y) < kMostRows * kRowHeight * spacing);
}

// Rows of a lattice that cover a box.
struct Grid {
  Lattice lattice;
  std::int64_t rows = 0;

  Grid(const Box& box, double spacing)
      : lattice{box.least, spacing},
        rows(static_cast<std::int64_t>((box.most.y - box.least.y) / (kRowHeight * spacing)) + 1) {}

  double yOf(std::int64_t b) const { return lattice.at(0, b).y; }
  // The first row at y or above, at most `rows`.
  std::int64_t rowFrom(double y) const {
    const double row = std::ceil((y - lattice.origin.y) / (kRowHeight * lattice.spacing));
    return static_cast<std::int64_t>(std::clamp(row, 0.0, static_cast<double>(rows)));
  }
  // The first place of row b at or beyond x.
  std::int64_t placeFrom(double x, std::int64_t b) const {
    return static_cast<std::int64_t>(std::ceil((x - lattice.at(0, b).x) / lattice.spacing));
  }
};

// A range along x in a row; for a crossing both ends are the same.
struct Span {
  std::int64_t row;
  double from, to;
};

std::vector<std::vector<Span>> byRow(std::vector<std::vector<Span>>&& lists, std::int64_t rows) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(rows), 0);
  for (const auto& list : lists)
    for (const Span& s : list) ++counts[static_cast<std::size_t>(s.row)];
  std::vector<std::vector<Span>> of_row(counts.size());
  for (std::size_t b = 0; b < counts.size(); ++b) of_row[b].reserve(counts[b]);
  for (auto& list : lists) {
    for (const Span& s : list) of_row[static_cast<std::size_t>(s.row)].push_back(s);
    freeMemoryOf(list);
  }
  return of_row;
}

// The places inside the domain: in each row between crossings one and two, three and four ... of the boundary.
LatticeRows insideOf(const TriMesh& mesh, const Grid& grid, const ItemLoop& loop) {
  auto crossings = overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Span> some;
    for (std::size_t t = first; t < last; ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
        if (mesh.twin(e) != kNone) continue;
        Point p = mesh.point(mesh.origin(e)), q = mesh.point(mesh.target(e));
        if (p.y > q.y) std::swap(p, q);
        for (std::int64_t b = grid.rowFrom(p.y); b < grid.rows; ++b) {
          const double y = grid.yOf(b);
          if (y >= q.y) break;
          if (y < p.y) continue;
          const double x = p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x);
          some.push_back({b, x, x});
        }
      }
    }
    return some;
  });
  std::vector<std::vector<Span>> rows = byRow(std::move(crossings), grid.rows);
  LatticeRows inside{0, std::vector<Intervals>(rows.size())};
  return eachRow(inside, loop, [&](std::int64_t b) {
    std::vector<Span>& row = rows[static_cast<std::size_t>(b)];
    std::ranges::sort(row, {}, &Span::from);
    Intervals some;
    for (std::size_t i = 0; i + 1 < row.size(); i += 2)
      some.push_back({grid.placeFrom(row[i].from, b), grid.placeFrom(row[i + 1].from, b)});
    return unionOf(std::move(some));
  });
}

// The range along the row at y within r of the segment from p to q; nullopt if empty.
std::optional<std::array<double, 2>> nearAlong(double y, const Point& p, const Point& q, double r) {
  std::array<double, 2> range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  const auto widen = [&](double x) { range = {std::min(range[0], x), std::max(range[1], x)}; };
  for (const Point& end : {p, q}) {
    const double dy = y - end.y;
    if (std::abs(dy) > r) continue;
    const double dx = std::sqrt(r * r - dy * dy);
    widen(end.x - dx);
    widen(end.x + dx);
  }
  const double length = distance(p, q);
  if (length > 0.0) {
    const Point side = (r / length) * Point{p.y - q.y, q.x - p.x};
    const std::array<Point, 4> corners{p + side, p - side, q - side, q + side};
    for (std::size_t i = 0; i < 4; ++i) {
      const Point &c = corners[i], &d = corners[(i + 1) % 4];
      if ((c.y <= y) != (d.y <= y)) widen(c.x + (y - c.y) / (d.y - c.y) * (d.x - c.x));
    }
  }
  if (range[0] > range[1]) return std::nullopt;
  return range;
}

// A segment, or a point on no segment.
struct InputPart {
  Point p, q;
};

std::vector<InputPart> partsOf(const TriMesh& mesh, const ItemLoop& loop) {
  const auto isConstrained = [&](EdgeRef e) { return mesh.segment(e) != kNone || mesh.twin(e) == kNone; };
  BulkList<std::uint8_t> alone = usedVertices(mesh, loop);
  std::vector<InputPart> parts =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<InputPart> segments;
        for (auto t = static_cast<TriId>(first); t < last; ++t) {
          for (unsigned i = 0; i < 3; ++i) {
            const EdgeRef e = edgeRef(t, i);
            if (!isConstrained(e)) continue;
            const VertexId v = mesh.origin(e), w = mesh.target(e);
            for (const VertexId end : {v, w}) __atomic_store_n(&alone[end], std::uint8_t{0}, __ATOMIC_RELAXED);
            if (mesh.twin(e) == kNone || mesh.twin(e) > e) segments.push_back({mesh.point(v), mesh.point(w)});
          }
        }
        return segments;
      }));
  for (VertexId v = 0; v < alone.size(); ++v)
    if (alone[v]) parts.push_back({mesh.point(v), mesh.point(v)});
  return parts;
}

// True if any of these places lies in the interval.
bool meets(std::span<const Interval> places, const Interval& interval) {
  const auto at = std::ranges::upper_bound(places, interval.first, {}, &Interval::last);
  return at != places.end() && at->first < interval.last;
}

// Those of the places that are no closer than the clearance to the input.
LatticeRows awayFromInput(const LatticeRows& places, const std::vector<InputPart>& input, const Grid& grid,
                          double clearance, const ItemLoop& loop) {
  const double r = clearance * grid.lattice.spacing;
  auto lists = overStretches(loop, input.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Span> near;
    for (std::size_t k = first; k < last; ++k) {
      const auto& [p, q] = input[k];
      const double from = std::min(p.x, q.x) - r, to = std::max(p.x, q.x) + r;
      for (std::int64_t b = grid.rowFrom(std::min(p.y, q.y) - r); b < grid.rows; ++b) {
        const double y = grid.yOf(b);
        if (y > std::max(p.y, q.y) + r) break;
        // Most of the input is far from places of this length. One place more on either side, since all is rounded.
        if (!meets(places.row(b), {grid.placeFrom(from, b) - 1, grid.placeFrom(to, b) + 1})) continue;
        if (const auto range = nearAlong(y, p, q, r)) near.push_back({b, (*range)[0], (*range)[1]});
      }
    }
    return near;
  });
  const std::vector<std::vector<Span>> rows = byRow(std::move(lists), grid.rows);
  return eachRow(places, loop, [&](std::int64_t b) {
    Intervals near;
    for (const Span& s : rows[static_cast<std::size_t>(b)])
      near.push_back({grid.placeFrom(s.from, b), grid.placeFrom(s.to, b)});
    return differenceOf(places.row(b), unionOf(std::move(near)));
  });
}

// The places for which `holds(point)` is true.
template <typename Holds>
LatticeRows where(const LatticeRows& places, const Lattice& lattice, const ItemLoop& loop, const Holds& holds) {
  return eachRow(places, loop, [&](std::int64_t b) {
    Intervals some;
    for (const Interval& i : places.row(b)) {
      for (std::int64_t a = i.first; a < i.last; ++a) {
        if (!holds(lattice.at(a, b))) continue;
        if (!some.empty() && some.back().last == a) {
          ++some.back().last;
        } else {
          some.push_back({a, a + 1});
        }
      }
    }
    return some;
  });
}

// A range of lengths, which get a lattice of this spacing.
struct Length {
  double spacing, least, most;
};

// The lengths requested in large parts of the domain, the longest first.
std::vector<Length> wantedLengths(const TriMesh& mesh, const Box& box, double area, const SizeFunction& size,
                                  const ItemLoop& loop) {
  if (size.least() == size.most()) return {{size.most(), size.least(), size.most()}};
  const double apart = std::sqrt(area / (kRowHeight * kProbes));
  if (isTooLong(box, apart)) return {};
  const Grid grid(box, apart);
  const LatticeRows probes = insideOf(mesh, grid, loop);
  std::vector<double> lengths;
  for (const LatticePlace& p : placesIn(probes)) lengths.push_back(size.at(grid.lattice.at(p.a, p.b)));
  std::ranges::sort(lengths, std::greater());
  const double cell = kRowHeight * grid.lattice.spacing * grid.lattice.spacing;
  double vertices = 0.0;  // expected
  for (const double h : lengths) vertices += cell / (kRowHeight * h * h);

  std::vector<Length> wanted;
  double looked_at = 0.0;
  for (std::size_t first = 0, last = 0; first < lengths.size(); first = last) {
    const double least = kSameLength * lengths[first];
    while (last < lengths.size() && lengths[last] >= least) ++last;
    const double spacing = lengths[first + (last - first) / 2];
    if (static_cast<double>(last - first) * cell < kFewestPlaces * kRowHeight * spacing * spacing) continue;
    // All places of the lattice are examined, not only those where this length is requested.
    looked_at += area / (kRowHeight * spacing * spacing);
    if (looked_at > kMostLooks * vertices) break;
    wanted.push_back({spacing, least, lengths[first]});
  }
  return wanted;
}

// The places and their neighbours.
LatticeRows dilated(const LatticeRows& set, const ItemLoop& loop) {
  return eachRow(set, loop, [&](std::int64_t b) {
    Intervals all;
    const auto add = [&](std::span<const Interval> some, std::int64_t from, std::int64_t to) {
      for (const Interval& i : some) all.push_back({i.first + from, i.last + to});
    };
    add(set.row(b), -1, 1);
    add(set.row(b + 1), 0, 1);
    add(set.row(b - 1), -1, 0);
    return unionOf(std::move(all));
  });
}

LatticeRows without(const LatticeRows& set, const LatticeRows& taken, const ItemLoop& loop) {
  return eachRow(set, loop, [&](std::int64_t b) { return differenceOf(set.row(b), taken.row(b)); });
}

}  // namespace

Point Lattice::at(std::int64_t a, std::int64_t b) const {
  return {origin.x + spacing * (static_cast<double>(a) + 0.5 * static_cast<double>(b)),
          origin.y + kRowHeight * spacing * static_cast<double>(b)};
}

std::vector<LatticePlaces> layLattices(const TriMesh& mesh, const LatticeWishes& wishes, const ItemLoop& loop) {
  const double most = wishes.size_max * shareOfLongest(wishes);
  if (wishes.size == nullptr && std::isinf(most)) return {};
  const auto [box, area] = extentOf(mesh, loop);
  const std::vector<Length> lengths = wishes.size == nullptr ? std::vector<Length>{{most, most, most}}
                                                             : wantedLengths(mesh, box, area, *wishes.size, loop);
  const double clearance = wishes.size == nullptr ? kClearanceUnderABound : kClearanceOfLengths;
  std::vector<LatticePlaces> lattices;
  std::vector<InputPart> input;  // once it is needed
  std::uint64_t places = 0;
  for (const Length& length : lengths) {
    const double spacing = std::min(length.spacing, most);
    const double count = area / (kRowHeight * spacing * spacing);
    if (count < kFewestPlaces || count > static_cast<double>(wishes.most_places - places)) continue;
    if (isTooLong(box, spacing)) continue;
    const Grid grid(box, spacing);
    const LatticeRows inside = insideOf(mesh, grid, loop);
    LatticeRows kept = inside;
    if (length.least < length.most) {
      const auto isOther = [&](const Point& p) {
        const double h = wishes.size->at(p);
        return h < length.least || h > length.most;
      };
      kept = without(inside, dilated(where(inside, grid.lattice, loop, isOther), loop), loop);
    }
    if (static_cast<double>(kept.count()) < kFewestPlaces) continue;
    if (input.empty()) input = partsOf(mesh, loop);
    kept = awayFromInput(kept, input, grid, clearance, loop);
    const std::int64_t found = kept.count();
    if (static_cast<double>(found) < kFewestPlaces) continue;
    places += static_cast<std::uint64_t>(found);
    lattices.push_back({grid.lattice, std::move(kept)});
  }
  return lattices;
}

}  // namespace coastmesh
