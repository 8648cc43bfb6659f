#include "gis/follow/water_lines.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/metric.hpp"
#include "gis/shore/line_coarsen.hpp"
#include "gis/shore/line_pieces.hpp"

namespace coastmesh {

namespace {

// Shares of the size.
constexpr double kOff = 0.4;       // from the shore; nearer parts of lines belong to it
constexpr double kSlow = 1.0;      // a line that takes longer for its last `kOff` is led straight to the shore
constexpr double kSampling = 0.1;  // between samples for this

bool isPlain(const Segment& s) { return s.left == s.right && s.left >= 0; }

class Returner {
 public:
  Returner(ShoreGraph& graph, WaterLines&& lines, const ShoreSizes& sizes, double off, LostLines& lost)
      : graph_(graph),
        lines_(std::move(lines)),
        sizes_(sizes),
        off_(off),
        lost_(lost),
        cutter_(graph.pslg, lines_.at, lines_.segments, sizes.wanted) {}

  void run() {
    std::vector<std::pair<Point, Point>> dry;
    for (SegmentId s = 0; s < lines_.segments.size(); ++s) {
      cutter_.cut(s, pieces_, dry);
      if (s + lines_.bridges < lines_.segments.size())
        for (const auto& [from, to] : dry) lose(s, from, to);
      dry.clear();
    }
    at_node_.resize(cutter_.nodes().size());
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      at_node_[pieces_[i].a].push_back(i);
      at_node_[pieces_[i].b].push_back(i);
    }
    is_done_.assign(pieces_.size(), 0);
    for (std::uint32_t i = 0; i < is_done_.size(); ++i)
      if (is_done_[i] == 0) treat(chainThrough(i));
    coarsenLines(chains_, cutter_, graph_.pslg, lines_.segments, lines_.stays, sizes_.wanted);
    addToGraph();
  }

 private:
  enum class EndKind { Shore, Free, Junction };
  const Point& at(std::uint32_t node) const { return cutter_.nodes()[node].at; }

  EndKind kindOf(std::uint32_t node) const {
    if (cutter_.nodes()[node].isAtShore()) return EndKind::Shore;
    return at_node_[node].size() == 1 ? EndKind::Free : EndKind::Junction;
  }
  bool goesOn(std::uint32_t node) const { return !cutter_.nodes()[node].isAtShore() && at_node_[node].size() == 2; }

  // The chain of pieces through nodes in the water where nothing else ends.
  LineChain chainThrough(std::uint32_t piece) {
    is_done_[piece] = 1;
    LineChain chain{{pieces_[piece].a, pieces_[piece].b, pieces_[piece].of, false}};
    std::uint32_t last = piece;
    for (const bool ahead : {true, false}) {
      while (true) {
        const std::uint32_t node = chain.back().to;
        if (!goesOn(node)) break;
        const auto& both = at_node_[node];
        const std::uint32_t next = both[0] == last ? both[1] : both[0];
        if (is_done_[next] != 0) break;
        is_done_[next] = 1;
        const bool is_back = pieces_[next].a != node;
        chain.push_back({node, is_back ? pieces_[next].a : pieces_[next].b, pieces_[next].of, is_back});
        last = next;
      }
      if (ahead) turn(chain);
      last = piece;
    }
    turn(chain);
    return chain;
  }

  static void turn(LineChain& chain) {
    std::ranges::reverse(chain);
    for (LineStep& step : chain) {
      std::swap(step.from, step.to);
      step.is_back = !step.is_back;
    }
  }

  bool isOff(const Point& x) const { return !cutter_.isShoreWithin(x, off_ * sizes_.wanted.at(x)); }

  // The first point of a step that is off the shore, as a share of its length; 2 if none is.
  double firstOff(const LineStep& step) const {
    constexpr double kMostSamples = 1000.0;
    const Point &a = at(step.from), &b = at(step.to);
    const double size = std::min(sizes_.wanted.at(a), sizes_.wanted.at(b));
    const double count = std::clamp(std::ceil(distance(a, b) / (kSampling * size)), 1.0, kMostSamples);
    for (double i = 0.0; i <= count; ++i)
      if (isOff(a + (i / count) * (b - a))) return i / count;
    return 2.0;
  }

  void treat(LineChain&& chain) {
    const EndKind first = kindOf(chain.front().from), last = kindOf(chain.back().to);
    if (first == EndKind::Shore || last == EndKind::Shore) {
      const bool is_off = std::ranges::any_of(chain, [&](const LineStep& step) { return firstOff(step) <= 1.0; });
      if (!is_off && first != EndKind::Junction && last != EndKind::Junction) {
        for (const LineStep& step : chain) lose(step.of, at(step.from), at(step.to));
        return;
      }
      const bool turns = is_off && first == EndKind::Shore && turnToShore(chain, 0);
      if (is_off && last == EndKind::Shore) {
        turn(chain);
        turnToShore(chain, turns ? 1 : 0);
      }
    }
    chains_.push_back(std::move(chain));
  }

  // If the chain leaves the shore slowly, replaces that part by a straight piece from the shore and returns true. Keeps
  // more than the last `at_other_end` steps, which lead to the other shore.
  bool turnToShore(LineChain& chain, std::size_t at_other_end) {
    std::size_t i = 0;
    double way = 0.0, along = firstOff(chain[i]);
    while (along > 1.0) {
      way += distance(at(chain[i].from), at(chain[i].to));
      along = firstOff(chain[++i]);
    }
    const LineStep step = chain[i];
    const Point from = at(step.from), to = at(step.to), x = along == 1.0 ? to : from + along * (to - from);
    way += distance(from, x);
    const double size = sizes_.wanted.at(x);
    if (way <= kSlow * size * off_ / kOff || (i + 1 + at_other_end >= chain.size() && along == 1.0)) return false;
    if (along > 0.0 && along < 1.0 && cutter_.hasNodeAt(x)) return false;
    const std::uint32_t node = along == 0.0 ? step.from : along == 1.0 ? step.to : cutter_.addNode(x);
    const auto lead = cutter_.leadToShore(node, step.of, 2.0 * off_ * size);
    if (!lead) return false;
    for (std::size_t k = 0; k < i; ++k) lose(chain[k].of, at(chain[k].from), at(chain[k].to));
    if (along > 0.0) lose(step.of, from, x);
    if (along == 1.0) ++i;
    chain.erase(chain.begin(), chain.begin() + static_cast<std::ptrdiff_t>(i));
    chain.front().from = node;
    chain.insert(chain.begin(), {lead->b, lead->a, lead->of, step.is_back});
    return true;
  }

  void lose(SegmentId line, const Point& from, const Point& to) {
    const Point middle = midpoint(from, to);
    const double length = distance(from, to);
    const auto [part, is_first] = lost_.lines.try_emplace(lines_.segments[line].tag, LostLines::Part{.first = middle});
    part->second.length_m += length / sizes_.scale.at(middle);
    part->second.elements += length / sizes_.wanted.at(middle);
  }

  void addToGraph() {
    Pslg& pslg = graph_.pslg;
    std::vector<VertexId> vertex_of(cutter_.nodes().size(), kNone);
    const auto add = [&](std::uint32_t node) {
      const LineNode& n = cutter_.nodes()[node];
      if (vertex_of[node] != kNone) return vertex_of[node];
      if (n.vertex != kNone) return vertex_of[node] = n.vertex;
      graph_.source.push_back(n.of != kNone ? lines_.source[n.of] : kNone);
      added_.push_back(n.at);
      return vertex_of[node] = static_cast<VertexId>(pslg.points.size() + added_.size() - 1);
    };
    std::vector<Segment> segments;
    for (const LineChain& chain : chains_) {
      for (const LineStep& step : chain) {
        const LinePiece piece = step.piece();
        Segment s = lines_.segments[piece.of];
        s.a = add(piece.a);
        s.b = add(piece.b);
        segments.push_back(s);
      }
    }
    for (const VertexId v : lines_.loose) {
      if (cutter_.waterAt(lines_.at[v]) >= 0) {
        add(v);
      } else {
        lost_.points.push_back(lines_.at[v]);
      }
    }
    for (SegmentId s = 0; s < cutter_.cuts().size(); ++s) cutShore(s, vertex_of, segments);
    pslg.points.insert(pslg.points.end(), added_.begin(), added_.end());
    pslg.segments.insert(pslg.segments.end(), segments.begin(), segments.end());
  }

  void cutShore(SegmentId s, const std::vector<VertexId>& vertex_of, std::vector<Segment>& segments) {
    std::vector<std::pair<double, VertexId>> cuts;
    Segment piece = graph_.pslg.segments[s];
    for (const std::uint32_t node : cutter_.cuts()[s])
      if (vertex_of[node] != kNone)
        cuts.emplace_back(squaredDistance(graph_.pslg.points[piece.a], at(node)), vertex_of[node]);
    if (cuts.empty()) return;
    std::ranges::sort(cuts);
    const VertexId last = piece.b;
    for (const auto& [off, v] : cuts) {
      piece.b = v;
      segments.push_back(piece);
      piece.a = v;
    }
    piece.b = last;
    graph_.pslg.segments[s] = piece;
  }

  ShoreGraph& graph_;
  WaterLines lines_;
  const ShoreSizes& sizes_;
  double off_;
  LostLines& lost_;
  LineCutter cutter_;
  std::vector<LinePiece> pieces_;
  std::vector<LineChain> chains_;
  std::vector<std::vector<std::uint32_t>> at_node_;  // pieces that end at each node
  std::vector<char> is_done_;                        // by piece
  std::vector<Point> added_;
};

}  // namespace

WaterLines takeLines(ShoreGraph& graph, const std::vector<VertexId>& asked) {
  WaterLines lines;
  const std::set<VertexId> stays(asked.begin(), asked.end());
  Pslg& pslg = graph.pslg;
  std::vector<char> on_shore(pslg.points.size(), 0), on_line(pslg.points.size(), 0);
  for (const Segment& s : pslg.segments) {
    auto& on = isPlain(s) ? on_line : on_shore;
    on[s.a] = on[s.b] = 1;
  }
  std::vector<VertexId> in_lines(pslg.points.size(), kNone), left(pslg.points.size(), kNone);  // their new numbers
  VertexId kept = 0;
  for (VertexId v = 0; v < pslg.points.size(); ++v) {
    if (on_shore[v] == 0 || on_line[v] != 0) {
      in_lines[v] = static_cast<VertexId>(lines.at.size());
      lines.at.push_back(pslg.points[v]);
      lines.source.push_back(graph.source[v]);
      lines.stays.push_back(stays.contains(graph.source[v]) ? 1 : 0);
      lines.shore.push_back(on_shore[v] != 0 ? kept : kNone);
      if (on_line[v] == 0) lines.loose.push_back(in_lines[v]);
    }
    if (on_shore[v] == 0) continue;
    left[v] = kept;
    pslg.points[kept] = pslg.points[v];
    graph.source[kept++] = graph.source[v];
  }
  if (lines.at.empty()) return lines;
  pslg.points.resize(kept);
  graph.source.resize(kept);
  std::size_t shores = 0;
  for (Segment s : pslg.segments) {
    const std::vector<VertexId>& number = isPlain(s) ? in_lines : left;
    s.a = number[s.a];
    s.b = number[s.b];
    if (isPlain(s)) {
      lines.segments.push_back(s);
    } else {
      pslg.segments[shores++] = s;
    }
  }
  pslg.segments.resize(shores);
  return lines;
}

void addLoose(WaterLines& lines, const std::vector<AskedPoint>& points) {
  for (const AskedPoint& point : points) {
    lines.loose.push_back(static_cast<VertexId>(lines.at.size()));
    lines.at.push_back(point.at);
    lines.source.push_back(point.source);
    lines.stays.push_back(1);
    lines.shore.push_back(kNone);
  }
}

void addLost(LostLines& lost, const std::vector<AskedPoint>& points) {
  for (const AskedPoint& point : points)
    if (std::ranges::find(lost.points, point.at) == lost.points.end()) lost.points.push_back(point.at);
}

std::vector<VertexId> bridgeLand(const ShoreGraph& shores, WaterLines& lines, const SizeFunction& size) {
  constexpr double kNarrow = 1.0;  // of the size
  std::vector<VertexId> ends;      // of lines at shores, once per segment
  std::vector<std::int32_t> tags;
  std::vector<Box> boxes;
  std::vector<RegionId> waters;
  for (const Segment& s : lines.segments) {
    for (const VertexId v : {s.a, s.b}) {
      if (lines.shore[v] == kNone) continue;
      ends.push_back(v);
      tags.push_back(s.tag);
      waters.push_back(s.left);
      boxes.push_back(Box::of(lines.at[v], lines.at[v]));
    }
  }
  if (ends.empty()) return {};
  const LineCutter cutter(shores.pslg, lines.at, lines.segments, size);
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<std::uint32_t> across(ends.size(), kNone);  // index of the nearest end across land
  for (std::uint32_t i = 0; i < ends.size(); ++i) {
    const Point& x = lines.at[ends[i]];
    double nearest = kNarrow * size.at(x);
    tree.visit(boxes[i].grownBy(nearest), [&](std::uint32_t j) {
      const double off = distance(x, lines.at[ends[j]]);
      if (off > nearest || (off == nearest && across[i] < j) || ends[i] == ends[j]) return;
      if (tags[i] != tags[j] || waters[i] != waters[j]) return;
      if (cutter.waterAt(midpoint(x, lines.at[ends[j]])) >= 0) return;
      nearest = off;
      across[i] = j;
    });
  }
  // True if the line only touches the shore there.
  const auto goesOn = [&](std::uint32_t i) {
    bool does = false;
    tree.visit(boxes[i], [&](std::uint32_t j) { does = does || (j != i && ends[j] == ends[i] && tags[j] == tags[i]); });
    return does;
  };
  std::vector<VertexId> others;
  for (std::uint32_t i = 0; i < ends.size(); ++i) {
    if (across[i] == kNone || across[across[i]] != i) {
      if (!goesOn(i)) others.push_back(lines.shore[ends[i]]);
    } else if (i < across[i]) {
      lines.segments.push_back({ends[i], ends[across[i]], tags[i], waters[i], waters[i]});
      ++lines.bridges;
    }
  }
  return others;
}

void returnLines(ShoreGraph& graph, WaterLines&& lines, const ShoreSizes& sizes, double channel_min, LostLines& lost) {
  if (lines.at.empty()) return;
  Returner(graph, std::move(lines), sizes, kOff * std::min(1.0, channel_min), lost).run();
}

}  // namespace coastmesh
