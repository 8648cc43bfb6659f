#include "gis/coast/clip_chains.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gis/coast/turned_rings.hpp"

namespace coastmesh {

namespace {

// A point of a chain, and the turn to add to its longitude so that the chain does not jump.
struct Turned {
  Point p;
  double turn = 0;    // degrees
  bool made = false;  // not a point of the input
};

using TurnedChain = std::vector<Turned>;

TurnedChain plain(const std::vector<Point>& chain) {
  TurnedChain turned;
  turned.reserve(chain.size());
  for (const Point& p : chain) turned.push_back({p});
  return turned;
}

TurnedChain withTurns(const std::vector<Point>& lonlat, const Turns& turns) {
  TurnedChain turned;
  turned.reserve(lonlat.size() + 3);
  for (std::size_t i = 0; i < lonlat.size(); ++i) turned.push_back({lonlat[i], 360.0 * turns.of[i]});
  return turned;
}

std::vector<Point> pointsOf(const TurnedChain& chain) {
  std::vector<Point> points;
  points.reserve(chain.size());
  for (const Turned& at : chain) points.push_back(at.p);
  return points;
}

// One side of the box. Inside: sign · coordinate <= sign · limit.
struct Side {
  bool in_x;
  double limit;
  double sign;
  double shift;  // of the coordinate

  double shiftOf(const Turned& at) const { return in_x ? shift + at.turn : 0; }
  double own(const Turned& at) const { return in_x ? at.p.x : at.p.y; }
  double beyond(const Turned& at) const { return sign * (own(at) + shiftOf(at) - limit); }
  bool holds(const Turned& at) const { return beyond(at) <= 0; }
  bool runsThrough(const Turned& at) const { return own(at) == limit - shiftOf(at); }
  // Where ab crosses the side, with the turn of a. REQUIRES: exactly one of the two is inside.
  Turned cut(const Turned& a, const Turned& b) const {
    const double da = beyond(a), db = beyond(b), t = da / (da - db), dx = b.p.x + (b.turn - a.turn) - a.p.x;
    Turned at{{a.p.x + t * dx, a.p.y + t * (b.p.y - a.p.y)}, a.turn, true};
    (in_x ? at.p.x : at.p.y) = limit - shiftOf(at);
    return at;
  }
};

// The finite sides.
std::vector<Side> sidesOf(const ClipBox& clip) {
  const Side all[] = {{true, clip.box.xmin, -1, clip.shift},
                      {true, clip.box.xmax, 1, clip.shift},
                      {false, clip.box.ymin, -1, 0},
                      {false, clip.box.ymax, 1, 0}};
  std::vector<Side> sides;
  for (const Side& side : all) {
    if (std::isfinite(side.limit)) sides.push_back(side);
  }
  return sides;
}

// Adds points at the multiples of `piece` strictly between a and b, in the order from a to b. REQUIRES: a and b lie on
// one side of the box.
void addPieces(const Turned& a, const Turned& b, double piece, bool along_x, TurnedChain& chain) {
  const double from = along_x ? a.p.x + a.turn : a.p.y, to = along_x ? b.p.x + b.turn : b.p.y;
  const double low = std::floor(std::min(from, to) / piece) + 1, high = std::ceil(std::max(from, to) / piece) - 1;
  const auto count = static_cast<long>(high - low) + 1;
  for (long k = 0; k < count; ++k) {
    const double at = piece * (from < to ? low + static_cast<double>(k) : high - static_cast<double>(k));
    Turned& added = chain.emplace_back(a);
    added.made = true;
    (along_x ? added.p.x : added.p.y) = along_x ? at - a.turn : at;
  }
}

// Divides the edges that run along sides of the box.
TurnedChain inPieces(const TurnedChain& ring, const ClipBox& clip, const std::vector<Side>& sides) {
  if (!std::isfinite(clip.piece_x) && !std::isfinite(clip.piece_y)) return ring;
  TurnedChain result;
  result.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Turned &a = ring[i], &b = ring[(i + 1) % ring.size()];
    result.push_back(a);
    for (const Side& side : sides) {
      const double piece = side.in_x ? clip.piece_y : clip.piece_x;
      if (!std::isfinite(piece) || !side.runsThrough(a) || !side.runsThrough(b)) continue;
      addPieces(a, b, piece, !side.in_x, result);
      break;
    }
  }
  return result;
}

TurnedChain clipTurned(TurnedChain kept, const ClipBox& clip) {
  const std::vector<Side> sides = sidesOf(clip);
  for (const Side& side : sides) {
    TurnedChain next;
    next.reserve(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) {
      const Turned &a = kept[i], &b = kept[(i + 1) % kept.size()];
      if (side.holds(a)) next.push_back(a);
      if (side.holds(a) != side.holds(b)) next.push_back(side.cut(a, b));
    }
    kept = std::move(next);
  }
  return kept.size() < 3 ? TurnedChain{} : inPieces(kept, clip, sides);
}

std::vector<TurnedChain> clipLines(TurnedChain line, const ClipBox& clip) {
  std::vector<TurnedChain> kept{std::move(line)};
  for (const Side& side : sidesOf(clip)) {
    std::vector<TurnedChain> next;
    for (const TurnedChain& piece : kept) {
      bool open = false;
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const bool in = side.holds(piece[i]);
        if (in != open && i > 0) {
          const Turned cut = side.cut(piece[i - 1], piece[i]);
          if (in) next.push_back({cut});
          if (!in) next.back().push_back(cut);
        } else if (in && !open) {
          next.emplace_back();
        }
        if (in) next.back().push_back(piece[i]);
        open = in;
      }
    }
    std::erase_if(next, [](const TurnedChain& piece) { return piece.size() < 2; });
    kept = std::move(next);
  }
  return kept;
}

// The clip with each shift by full turns at which the chain may reach into the box.
std::vector<ClipBox> clipsOf(const TurnedChain& chain, const ClipBox& clip) {
  if (!std::isfinite(clip.box.xmin)) return {clip};
  double west = std::numeric_limits<double>::infinity(), east = -west;
  for (const Turned& at : chain) {
    west = std::min(west, at.p.x + at.turn);
    east = std::max(east, at.p.x + at.turn);
  }
  std::vector<ClipBox> clips;
  const double first = std::ceil((clip.box.xmin - east) / 360), last = std::floor((clip.box.xmax - west) / 360);
  for (double turn = first; turn <= last; ++turn) {
    clips.push_back(clip);
    clips.back().shift = 360 * turn;
  }
  return clips;
}

// The points of the chain; longitudes of new ones are moved to the range of 360 degrees that begins at `west`.
std::vector<Point> onMap(const TurnedChain& chain, double west) {
  std::vector<Point> points = pointsOf(chain);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    if (chain[i].made) points[i].x -= 360 * std::floor((points[i].x - west) / 360);
  }
  return points;
}

}  // namespace

Ring clipRing(const Ring& ring, const ClipBox& clip) { return pointsOf(clipTurned(plain(ring), clip)); }

std::vector<std::vector<Point>> clipLine(const std::vector<Point>& line, const ClipBox& clip) {
  std::vector<std::vector<Point>> parts;
  for (const TurnedChain& part : clipLines(plain(line), clip)) parts.push_back(pointsOf(part));
  return parts;
}

std::vector<Ring> clipTurnedRing(const Ring& lonlat, const ClipBox& clip, double west) {
  const Turns turns = turnsOf(lonlat, true);
  TurnedChain ring = withTurns(lonlat, turns);
  if (turns.round != 0) {
    const double pole = poleWithin(lonlat), end = 360.0 * turns.round;
    if (clip.box.ymin <= pole && pole <= clip.box.ymax) return {lonlat};
    const Point& first = lonlat.front();
    ring.insert(ring.end(), {{first, end}, {{first.x, pole}, end, true}, {{first.x, pole}, 0, true}});
  }
  std::vector<Ring> rings;
  for (const ClipBox& seen : clipsOf(ring, clip)) {
    const TurnedChain part = clipTurned(ring, seen);
    if (!part.empty()) rings.push_back(onMap(part, west));
  }
  return rings;
}

std::vector<std::vector<Point>> clipTurnedLine(const std::vector<Point>& lonlat, const ClipBox& clip, double west) {
  const TurnedChain line = withTurns(lonlat, turnsOf(lonlat, false));
  std::vector<std::vector<Point>> parts;
  for (const ClipBox& seen : clipsOf(line, clip)) {
    for (const TurnedChain& part : clipLines(line, seen)) parts.push_back(onMap(part, west));
  }
  return parts;
}

}  // namespace coastmesh
