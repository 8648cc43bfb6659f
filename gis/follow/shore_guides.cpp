#include "gis/follow/shore_guides.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/follow/line_samples.hpp"
#include "gis/follow/shore_settle.hpp"

namespace coastmesh {

namespace {

// Shares of the size wanted.
constexpr double kBarrier = 0.25;      // on either side
constexpr double kTooNear = 0.02;      // least distance of helpers from anything else
constexpr double kDug = 1.0;           // land this long on a passage is reported
constexpr double kLittleMore = 1.001;  // of the reach: rounding of helpers

// Temporary points, so that triangles end at the sides of lines.
class Helpers {
 public:
  explicit Helpers(ShoreTriangles& triangles) : triangles_(triangles) {}

  // True if x is in the mesh and no segment comes within `least`. Searches the triangles that do.
  bool isFree(const Point& x, double least) {
    const TriMesh& mesh = triangles_.mesh;
    const TriId found = locateIn(triangles_, x, last_);
    if (found == kNone) return false;
    near_.assign(1, last_ = found);
    for (std::size_t i = 0; i < near_.size(); ++i) {
      for (unsigned k = 0; k < 3; ++k) {
        const EdgeRef e = edgeRef(near_[i], k);
        if (mesh.twin(e) == kNone ||
            squaredDistanceToSegment(x, mesh.point(mesh.origin(e)), mesh.point(mesh.target(e))) > least * least)
          continue;
        if (mesh.segment(e) != kNone) return false;
        const TriId beside = triOf(mesh.twin(e));
        if (std::ranges::find(near_, beside) == near_.end()) near_.push_back(beside);
      }
    }
    return true;
  }

  void add(const Point& x, double size) {
    const double least = kTooNear * size;
    if (isFree(x, least)) wanted_.emplace_back(x, least);
  }

  // Adds points all around the line, `reach` times the size away.
  void addAround(const std::vector<LineSample>& samples, double reach) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Point along = samples[std::min(i + 1, samples.size() - 1)].at - samples[i == 0 ? 0 : i - 1].at;
      const double length = std::sqrt(squaredLength(along));
      if (length == 0.0) continue;
      const double by = reach * samples[i].size / length;
      const Point side{-by * along.y, by * along.x}, ahead = by * along;
      add(samples[i].at + side, samples[i].size);
      add(samples[i].at - side, samples[i].size);
      for (const double turn : {-1.0, 0.0, 1.0}) {
        if (i == 0) add(samples[i].at - ahead + turn * side, samples[i].size);
        if (i + 1 == samples.size()) add(samples[i].at + ahead + turn * side, samples[i].size);
      }
    }
  }

  // Inserts the points; of points too near to one another, the first.
  void finish(const SizeFunction& size) {
    std::vector<Box> boxes;
    for (const auto& [x, least] : wanted_) boxes.push_back(Box::of(x, x));
    const BoxTree tree(boxes, BoxTree::Order::Hilbert);
    std::vector<bool> kept(wanted_.size(), false);
    std::vector<Point> points;
    for (std::size_t i = 0; i < wanted_.size(); ++i) {
      const auto& [x, least] = wanted_[i];
      kept[i] = true;
      tree.visit(Box::of(x, x).grownBy(least), [&](std::uint32_t other) {
        if (other < i && kept[other] && squaredDistance(x, wanted_[other].first) < least * least) kept[i] = false;
      });
      if (kept[i]) points.push_back(x);
    }
    insertPoints(triangles_, points, size);
  }

 private:
  ShoreTriangles& triangles_;
  TriId last_ = 0;
  std::vector<TriId> near_;
  std::vector<std::pair<Point, double>> wanted_;
};

std::uint8_t usesOf(const ShoreTriangles& t, TriId i) {
  const auto& v = t.mesh.triangles[i].v;
  return t.use[v[0]] | t.use[v[1]] | t.use[v[2]];
}

bool meets(const Point& p, const Point& q, const Point& a, const Point& b, const Point& c) {
  if (isIn(p, a, b, c) || isIn(q, a, b, c)) return true;
  const auto crosses = [&](const Point& x, const Point& y) {
    return orient2d(p, q, x) * orient2d(p, q, y) <= 0 && orient2d(x, y, p) * orient2d(x, y, q) <= 0 &&
           Box::of(p, q).meets(Box::of(x, y));
  };
  return crosses(a, b) || crosses(b, c) || crosses(c, a);
}

}  // namespace

std::vector<double> elementsOf(const std::vector<ShoreLine>& lines) {
  std::vector<double> elements;
  for (const ShoreLine& line : lines) elements.push_back(line.elements);
  return elements;
}

BoxTree ShoreGuides::tree() const {
  std::vector<Box> boxes;
  for (const auto* lines : {&passages, &barriers})
    for (const ShoreLine& line : *lines)
      for (std::size_t i = 0; i + 1 < line.points.size(); ++i)
        boxes.push_back(Box::of(line.points[i], line.points[i + 1]));
  return boxes.empty() ? BoxTree() : BoxTree(boxes, BoxTree::Order::Hilbert);
}

LineZone::LineZone(const std::vector<ShoreLine>& lines) {
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<Point>& points = lines[k].points;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      pieces_.push_back({points[i], points[i + 1], lines[k].elements, k});
      most_elements_ = std::max(most_elements_, lines[k].elements);
      boxes.push_back(Box::of(points[i], points[i + 1]));
    }
  }
  if (!boxes.empty()) tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

bool LineZone::holds(const Point& a, const Point& b, const Point& c, double reach) const {
  if (pieces_.empty()) return false;
  const Point centre = centroid(a, b, c);
  Box box = Box::of(centre, centre).grownBy(most_elements_ * reach);
  for (const Point& p : {a, b, c}) box.add(p);
  bool found = false;
  tree_.visit(box, [&](std::uint32_t i) {
    const auto& [p, q, elements, line] = pieces_[i];
    const double far = elements * reach;
    found = found || squaredDistanceToSegment(centre, p, q) <= far * far || meets(p, q, a, b, c);
  });
  return found;
}

std::optional<std::size_t> LineZone::firstAt(const Point& a, const Point& b, const Point& c) const {
  std::optional<std::size_t> first;
  if (pieces_.empty()) return first;
  Box box = Box::of(a, b);
  box.add(c);
  tree_.visit(box, [&](std::uint32_t i) {
    const Piece& piece = pieces_[i];
    if ((!first || piece.line < *first) && meets(piece.a, piece.b, a, b, c)) first = piece.line;
  });
  return first;
}

bool LineZone::hasAnotherNear(const Point& x, double reach, std::size_t own) const {
  if (pieces_.empty()) return false;
  bool found = false;
  tree_.visit(Box::of(x, x).grownBy(reach), [&](std::uint32_t i) {
    const Piece& piece = pieces_[i];
    found = found || (piece.line != own && squaredDistanceToSegment(x, piece.a, piece.b) <= reach * reach);
  });
  return found;
}

namespace {

// For each region of water, the one that it becomes part of: small waters become part of a larger one beside them, or
// beside other small ones at which they lie. Borders as fine as the data would stay between them otherwise.
std::vector<RegionId> largerBeside(const ShoreTriangles& triangles, const SmallWaters& small) {
  const TriMesh& mesh = triangles.mesh;
  std::vector<RegionId> larger(small.size());
  std::iota(larger.begin(), larger.end(), RegionId{0});
  std::set<std::pair<RegionId, RegionId>> beside;  // a small one, and another
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const RegionId region = mesh.regions[t];
    if (region == triangles.land || !small[static_cast<std::size_t>(region)]) continue;
    for (const EdgeRef e : mesh.triangles[t].adj)
      if (const RegionId other = mesh.regions[triOf(e)]; other != triangles.land && other != region)
        beside.emplace(region, other);
  }
  const auto isSmall = [&](RegionId region) { return small[static_cast<std::size_t>(larger[region])]; };
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [region, other] : beside) {
      if (!isSmall(region) || isSmall(other)) continue;
      larger[region] = larger[other];
      changed = true;
    }
  }
  return larger;
}

}  // namespace

void widenPassages(ShoreTriangles& triangles, const ShoreSizes& sizes, const std::vector<ShoreLine>& passages,
                   const SmallWaters& small, const ShoreEdit& edit, WaterAreas& gained, PassageEffects& effects,
                   const ItemLoop& loop) {
  Helpers helpers(triangles);
  struct Piece {
    Point a, b;
    double elements;
    RegionId water;
  };
  std::vector<Piece> pieces;
  std::vector<Box> boxes;
  std::vector<std::vector<LineSample>> sampled;
  for (const ShoreLine& line : passages) sampled.push_back(samplesOf(line.points, sizes.wanted));
  locateSamples(sampled, elementsOf(passages), triangles);
  const std::size_t widened_before = effects.widened.size();
  for (std::size_t line = 0; line < passages.size(); ++line) {
    const double elements = passages[line].elements;
    const std::vector<LineSample>& samples = sampled[line];
    const auto first = std::ranges::find_if(samples, isWet);
    const auto last = std::find_if(samples.rbegin(), samples.rend(), isWet).base();
    if (first == samples.end()) {
      effects.dry.push_back(line);
      continue;
    }
    const std::vector<LineSample> wet(first, last);
    RegionId water = wet.front().water;
    WidenedPassage passage{.line = line};
    for (std::size_t i = 0; i + 1 < wet.size(); ++i) {
      if (isWet(wet[i])) water = wet[i].water;
      if ((!wet[i].wanting && !wet[i + 1].wanting) || wet[i].beyond || wet[i + 1].beyond) continue;
      pieces.push_back({wet[i].at, wet[i + 1].at, elements, water});
      boxes.push_back(Box::of(wet[i].at, wet[i + 1].at).grownBy(elements * wet[i].size));
      helpers.addAround({wet[i], wet[i + 1]}, 0.5 * elements);
      const double scale = sizes.scale.at(wet[i].at);
      passage.length_m += (wet[i + 1].way - wet[i].way) / scale;
      passage.width_m = std::max(passage.width_m, elements * wet[i].size / scale);
      passage.place = wet[i].at;
      passage.water = water;
    }
    for (const LandOnLine& land : landsOn(samples)) {
      if (samples[land.first].beyond || land.length < kDug * samples[land.middle].size) continue;
      const Point& place = samples[land.middle].at;
      const double length_m = land.length / sizes.scale.at(place);
      if (land.at_end) {
        effects.ends.push_back({line, samples[land.first > 0 ? land.first : land.last].at, length_m});
      } else if (length_m > passage.dug_m) {
        passage.dug_m = length_m;
        passage.dug_at = place;
      }
    }
    if (passage.length_m > 0.0) effects.widened.push_back(passage);
  }
  if (pieces.empty()) return;
  helpers.finish(sizes.wanted);
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  const BoxGrid grid(boxes);
  std::vector<TriId> dug;
  for (TriId t = 0; t < triangles.mesh.triangles.size(); ++t) {
    if (triangles.mesh.regions[t] != triangles.land || (usesOf(triangles, t) & (kAround | kOnOpen)) != 0) continue;
    const auto& v = triangles.mesh.triangles[t].v;
    const Point &a = triangles.mesh.point(v[0]), &b = triangles.mesh.point(v[1]), &c = triangles.mesh.point(v[2]);
    const Point centre = centroid(a, b, c);
    if (!grid.mayMeet(Box::of(centre, centre))) continue;
    double nearest = kLittleMore * 0.5 * triangles.size[t];  // per element across
    tree.visit(Box::of(centre, centre), [&](std::uint32_t i) {
      const double far = std::sqrt(squaredDistanceToSegment(centre, pieces[i].a, pieces[i].b)) / pieces[i].elements;
      if (far > nearest) return;
      nearest = far;
      triangles.mesh.regions[t] = pieces[i].water;
    });
    if (triangles.mesh.regions[t] != triangles.land) dug.push_back(t);
  }
  const std::vector<RegionId> larger = largerBeside(triangles, small);
  for (RegionId& region : triangles.mesh.regions)
    if (region != triangles.land) region = larger[region];
  for (const TriId t : dug) {
    const auto& v = triangles.mesh.triangles[t].v;
    const Point &a = triangles.mesh.point(v[0]), &b = triangles.mesh.point(v[1]), &c = triangles.mesh.point(v[2]);
    const double scale = sizes.scale.at(centroid(a, b, c));
    gained[triangles.mesh.regions[t]] += 0.5 * cross(b - a, c - a) / scale / scale;
  }
  for (std::size_t i = widened_before; i < effects.widened.size(); ++i) {
    WidenedPassage& passage = effects.widened[i];
    passage.water = larger[passage.water];
    edit(EditKind::WidenedPassage, passage.place, passage.water);
  }
  settleShores(triangles, sizes.wanted, loop);
}

namespace {

// Finds ends of barriers that water goes around.
void findOpenEnds(const std::vector<ShoreLine>& barriers, const std::vector<std::vector<LineSample>>& sampled,
                  const LineZone& zone, Helpers& helpers, std::vector<OpenBarrier>& open) {
  for (std::size_t line = 0; line < barriers.size(); ++line) {
    if (sampled[line].empty() || barriers[line].points.front() == barriers[line].points.back()) continue;
    for (const LineSample* end : {&sampled[line].front(), &sampled[line].back()}) {
      if (end->water == kUnlabelled || !helpers.isFree(end->at, end->size) ||
          zone.hasAnotherNear(end->at, end->size, line))
        continue;
      open.push_back({line, end->at});
      break;
    }
  }
}

}  // namespace

void closeBarriers(ShoreTriangles& triangles, const ShoreSizes& sizes, const ShoreGuides& guides, const ShoreEdit& edit,
                   std::vector<OpenBarrier>& open) {
  if (guides.barriers.empty()) return;
  Helpers helpers(triangles);
  std::vector<std::vector<LineSample>> sampled;
  for (const ShoreLine& line : guides.barriers) sampled.push_back(samplesOf(line.points, sizes.wanted));
  locateSamples(sampled, elementsOf(guides.barriers), triangles);
  const LineZone zone(guides.barriers);
  findOpenEnds(guides.barriers, sampled, zone, helpers, open);
  for (const std::vector<LineSample>& samples : sampled) helpers.addAround(samples, kBarrier);
  helpers.finish(sizes.wanted);
  struct Closed {
    Point place;
    RegionId water;
  };
  std::vector<std::optional<Closed>> closed(guides.barriers.size());  // the first triangle that each barrier closes
  for (TriId t = 0; t < triangles.mesh.triangles.size(); ++t) {
    RegionId& water = triangles.mesh.regions[t];
    if (water == triangles.land) continue;
    const auto& v = triangles.mesh.triangles[t].v;
    const Point& a = triangles.mesh.point(v[0]);
    const auto line = zone.firstAt(a, triangles.mesh.point(v[1]), triangles.mesh.point(v[2]));
    if (!line) continue;
    if (!closed[*line]) closed[*line] = {a, water};
    water = triangles.land;
  }
  for (std::size_t line = 0; line < guides.barriers.size(); ++line) {
    if (closed[line]) {
      edit(EditKind::Barrier, closed[line]->place, closed[line]->water);
    } else if (std::ranges::none_of(sampled[line], isWet)) {  // in water closed by another, it meets water too
      open.push_back({line, std::nullopt});
    }
  }
  settleShores(triangles, sizes.wanted);
}

}  // namespace coastmesh
