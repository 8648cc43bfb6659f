#include "tests/fuzz/reduce_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

class Reducer {
 public:
  Reducer(RefineCase failing, const std::function<bool(const RefineCase&)>& still_fails, int most_trials)
      : best_(std::move(failing)), still_fails_(still_fails), trials_left_(most_trials) {}

  RefineCase run() {
    simplifyOptions();
    // Each round that changes something makes the case smaller; few rounds are needed.
    constexpr int kRounds = 8;
    for (int round = 0; round < kRounds && trials_left_ > 0; ++round) {
      changed_ = false;
      dropRings();
      dropPieces(best_.pslg.holes.size(), [](RefineCase& c, std::size_t from, std::size_t to) {
        c.pslg.holes.erase(c.pslg.holes.begin() + static_cast<std::ptrdiff_t>(from),
                           c.pslg.holes.begin() + static_cast<std::ptrdiff_t>(to));
      });
      dropPieces(best_.pslg.segments.size(), [](RefineCase& c, std::size_t from, std::size_t to) {
        c.pslg.segments.erase(c.pslg.segments.begin() + static_cast<std::ptrdiff_t>(from),
                              c.pslg.segments.begin() + static_cast<std::ptrdiff_t>(to));
      });
      dropPieces(best_.pslg.points.size(), [](RefineCase& c, std::size_t from, std::size_t to) {
        std::vector<bool> gone(c.pslg.points.size(), false);
        std::fill(gone.begin() + static_cast<std::ptrdiff_t>(from), gone.begin() + static_cast<std::ptrdiff_t>(to),
                  true);
        dropPoints(c.pslg, gone);
      });
      for (VertexId v = 0; v < best_.pslg.points.size(); ++v) bypass(v);
      if (!changed_) break;
    }
    roundCoordinates();
    simplifyOptions();
    return best_;
  }

 private:
  bool keepIfFails(RefineCase candidate) {
    if (trials_left_ <= 0) return false;
    --trials_left_;
    if (!still_fails_(candidate)) return false;
    best_ = std::move(candidate);
    changed_ = true;
    return true;
  }

  template <typename Change>
  bool attempt(const Change& change) {
    RefineCase candidate = best_;
    change(candidate);
    return keepIfFails(std::move(candidate));
  }

  void simplifyOptions() {
    const RefineOptions plain;
    if (best_.coarsen) attempt([](RefineCase& c) { c.coarsen = false; });
    if (best_.options.max_vertices != plain.max_vertices)
      attempt([&](RefineCase& c) { c.options.max_vertices = plain.max_vertices; });
    if (!std::isinf(best_.options.size_max)) attempt([&](RefineCase& c) { c.options.size_max = plain.size_max; });
    if (best_.options.max_angle_deg != 180.0) attempt([](RefineCase& c) { c.options.max_angle_deg = 180.0; });
    for (const double angle : {0.0, 20.0, 30.0})
      if (best_.options.min_angle_deg > angle && attempt([&](RefineCase& c) { c.options.min_angle_deg = angle; }))
        break;
    if (best_.options.min_angle_deg != std::round(best_.options.min_angle_deg))
      attempt([](RefineCase& c) { c.options.min_angle_deg = std::round(c.options.min_angle_deg); });
    attempt([](RefineCase& c) {
      for (Segment& s : c.pslg.segments) s.left = s.right = kUnlabelled;
    });
  }

  // Drops pieces of the list, from its end, from half of it down to single entries.
  template <typename Drop>
  void dropPieces(std::size_t count, const Drop& drop) {
    for (std::size_t piece = std::max<std::size_t>(1, count / 2); count > 0; piece /= 2) {
      for (std::size_t to = count; to > 0 && trials_left_ > 0; to -= std::min(to, piece)) {
        const std::size_t from = to - std::min(to, piece);
        if (attempt([&](RefineCase& c) { drop(c, from, to); })) count -= to - from;
      }
      if (piece <= 1) break;
    }
  }

  static void dropPoints(Pslg& pslg, const std::vector<bool>& gone) {
    std::vector<VertexId> renumbered(pslg.points.size(), kNone);
    std::vector<Point> kept;
    for (VertexId v = 0; v < pslg.points.size(); ++v) {
      if (gone[v]) continue;
      renumbered[v] = static_cast<VertexId>(kept.size());
      kept.push_back(pslg.points[v]);
    }
    pslg.points = std::move(kept);
    std::erase_if(pslg.segments, [&](const Segment& s) { return gone[s.a] || gone[s.b]; });
    for (Segment& s : pslg.segments) s.a = renumbered[s.a], s.b = renumbered[s.b];
  }

  // Drops whole rings, or other connected components of segments, one at a time.
  void dropRings() {
    std::vector<VertexId> ring(best_.pslg.points.size());
    std::iota(ring.begin(), ring.end(), VertexId{0});
    for (bool again = true; again;) {
      again = false;
      for (const Segment& s : best_.pslg.segments) {
        const VertexId least = std::min(ring[s.a], ring[s.b]);
        again |= ring[s.a] != least || ring[s.b] != least;
        ring[s.a] = ring[s.b] = least;
      }
    }
    std::vector<VertexId> names = ring;
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    for (const VertexId name : names) {
      std::vector<bool> gone(ring.size());
      for (std::size_t v = 0; v < ring.size(); ++v) gone[v] = ring[v] == name;
      if (!attempt([&](RefineCase& c) { dropPoints(c.pslg, gone); })) continue;
      std::erase(ring, name);
    }
  }

  // Removes a vertex where two segments meet, and merges these into one.
  void bypass(VertexId v) {
    RefineCase candidate = best_;
    std::vector<Segment*> ends;
    for (Segment& s : candidate.pslg.segments)
      if (s.a == v || s.b == v) ends.push_back(&s);
    if (ends.size() != 2) return;
    Segment &kept = *ends[0], &other = *ends[1];
    const VertexId beyond = other.a == v ? other.b : other.a;
    (kept.a == v ? kept.a : kept.b) = beyond;
    other.a = other.b = v;
    std::vector<bool> gone(candidate.pslg.points.size(), false);
    gone[v] = true;
    dropPoints(candidate.pslg, gone);
    keepIfFails(std::move(candidate));
  }

  void roundCoordinates() {
    if (best_.pslg.points.empty()) return;
    const Point first = best_.pslg.points.front();
    attempt([&](RefineCase& c) {
      for (Point& p : c.pslg.points) p = p - first;
      for (Point& p : c.pslg.holes) p = p - first;
    });
    for (const int digits : {1, 2, 3, 4, 6, 9, 12}) {
      double magnitude = 0.0;
      for (const Point& p : best_.pslg.points) magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y)});
      if (!(magnitude > 0.0)) return;
      const double unit = std::pow(10.0, std::floor(std::log10(magnitude)) + 1 - digits);
      const auto rounded = [&](double x) { return unit * std::round(x / unit); };
      const auto round = [&](RefineCase& c) {
        for (Point& p : c.pslg.points) p = {rounded(p.x), rounded(p.y)};
      };
      if (attempt(round)) break;
    }
    // Rounds points one by one if not all can be rounded together.
    for (std::size_t v = 0; v < best_.pslg.points.size(); ++v) {
      for (const int digits : {1, 2, 3, 4, 6}) {
        const Point p = best_.pslg.points[v];
        const double magnitude = std::max(std::abs(p.x), std::abs(p.y));
        if (!(magnitude > 0.0)) break;
        const double unit = std::pow(10.0, std::floor(std::log10(magnitude)) + 1 - digits);
        const Point q{unit * std::round(p.x / unit), unit * std::round(p.y / unit)};
        if (q == p || attempt([&](RefineCase& c) { c.pslg.points[v] = q; })) break;
      }
    }
  }

  RefineCase best_;
  const std::function<bool(const RefineCase&)>& still_fails_;
  int trials_left_;
  bool changed_ = false;
};

}  // namespace

RefineCase reduceCase(RefineCase failing, const std::function<bool(const RefineCase&)>& still_fails, int most_trials) {
  return Reducer(std::move(failing), still_fails, most_trials).run();
}

}  // namespace coastmesh
