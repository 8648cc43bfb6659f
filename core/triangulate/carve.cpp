#include "core/triangulate/carve.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>

#include "core/hilbert.hpp"
#include "core/union_find.hpp"

namespace coastmesh {

namespace {

using FaceId = std::uint32_t;  // of a face, or of a part of one in a range of triangles

class Carver {
 public:
  Carver(const Triangulation& all, const Pslg& pslg, const ItemLoop& loop)
      : all_(all), triangles_(all.mesh.triangles), pslg_(pslg), loop_(loop) {}

  BulkList<RegionId> run() {
    const std::size_t parts = findParts();
    UnionFind faces(parts);
    for (const auto& [a, b] : joins_) faces.unite(a, b);
    const auto isLabelled = [](const Segment& s) { return s.left != kUnlabelled || s.right != kUnlabelled; };
    std::vector<RegionId> label =
        std::ranges::any_of(pslg_.segments, isLabelled) ? labelsFromSegments(faces) : labelsFromHoles(faces, parts);
    for (FaceId p = 0; p < parts; ++p) {
      label[p] = label[faces.find(p)];
      if (label[p] == kUnlabelled) label[p] = kOutside;
    }
    BulkList<RegionId> region = unsetList<RegionId>(triangles_.size());
    forEachByStretches(loop_, region.size(), [&](std::size_t i) {
      const auto t = static_cast<TriId>(i);
      region[t] = all_.isGhost(t) ? kOutside : label[part_of_[t]];
    });
    return region;
  }

 private:
  using Join = std::pair<FaceId, FaceId>;
  struct Range {
    std::vector<RegionId> labels;  // by part: of its first segment with a label
    std::vector<Join> joins;
    bool clashes = false;
  };

  // Divides each range of triangles into connected parts, and notes which touch. Returns the number of parts.
  std::size_t findParts() {
    resizeUnset(part_of_, triangles_.size());
    std::vector<Range> ranges = overStretches(loop_, triangles_.size(), [&](std::size_t first, std::size_t last) {
      return partsOf(static_cast<TriId>(first), static_cast<TriId>(last));
    });
    const std::size_t count = triangles_.size();
    std::vector<FaceId> starts{0};
    for (const Range& range : ranges) starts.push_back(starts.back() + static_cast<FaceId>(range.labels.size()));
    if (ranges.size() > 1) {
      forEachStretch(loop_, count, ranges.size(), [&](std::size_t r, std::size_t first, std::size_t last) {
        for (std::size_t t = first; t < last; ++t) part_of_[t] += starts[r];
      });
      const auto joins = overStretches(loop_, count, [&](std::size_t first, std::size_t last) {
        return joinsFrom(static_cast<TriId>(first), static_cast<TriId>(last));
      });
      for (const std::vector<Join>& some : joins) joins_.insert(joins_.end(), some.begin(), some.end());
    }
    for (const Range& range : ranges) {
      labels_.insert(labels_.end(), range.labels.begin(), range.labels.end());
      clashes_ = clashes_ || range.clashes;
    }
    return starts.back();
  }

  Range partsOf(TriId first, TriId last) {
    Range range;
    std::fill(part_of_.begin() + first, part_of_.begin() + last, kNone);
    std::vector<TriId> stack;
    for (TriId start = first; start < last; ++start) {
      if (part_of_[start] != kNone) continue;
      const auto part = static_cast<FaceId>(range.labels.size());
      RegionId own = kUnlabelled;
      part_of_[start] = part;
      stack.assign(1, start);
      while (!stack.empty()) {
        const TriId t = stack.back();
        stack.pop_back();
        const Triangle& here = triangles_[t];
        for (unsigned i = 0; i < 3; ++i) {
          if (here.seg[i] != kNone) {
            const RegionId label = labelOn(t, i);
            if (label == kUnlabelled) continue;
            if (own == kUnlabelled) own = label;
            if (own != label) range.clashes = true;
            continue;
          }
          const TriId other = triOf(here.adj[i]);
          if (other < first || other >= last || part_of_[other] != kNone) continue;
          part_of_[other] = part;
          stack.push_back(other);
        }
      }
      range.labels.push_back(own);
    }
    return range;
  }

  // Pairs of parts on the two sides of an edge that ends the range.
  std::vector<Join> joinsFrom(TriId first, TriId last) const {
    std::vector<Join> joins;
    for (TriId t = first; t < last; ++t) {
      const Triangle& here = triangles_[t];
      for (unsigned i = 0; i < 3; ++i) {
        const TriId other = triOf(here.adj[i]);
        if (here.seg[i] != kNone || other < last) continue;
        const Join join{part_of_[t], part_of_[other]};
        if (joins.empty() || joins.back() != join) joins.push_back(join);
      }
    }
    std::ranges::sort(joins);
    const auto doubles = std::ranges::unique(joins);
    joins.erase(doubles.begin(), doubles.end());
    return joins;
  }

  // By part, set for the parts that stand for faces.
  std::vector<RegionId> labelsFromSegments(UnionFind& faces) {
    for (FaceId p = 0; p < labels_.size(); ++p) {
      RegionId& face = labels_[faces.find(p)];
      if (face == kUnlabelled) face = labels_[p];
      if (labels_[p] != kUnlabelled && face != labels_[p]) clashes_ = true;
    }
    if (clashes_) refuseLabels(faces);
    return std::move(labels_);
  }

  std::vector<RegionId> labelsFromHoles(UnionFind& faces, std::size_t parts) const {
    std::vector<RegionId> labels(parts, 0);
    const auto carve = [&](TriId t) { labels[faces.find(part_of_[t])] = kOutside; };
    TriId ghost = 0;
    while (!all_.isGhost(ghost)) ++ghost;
    if (!pslg_.segments.empty()) carve(ghost);
    TriId at = 0;
    for (const std::uint32_t hole : hilbertOrder(pslg_.holes)) {
      at = locate(all_, pslg_.holes[hole], at);
      carve(at);
    }
    return labels;
  }

  // Reports the first two segments that label the same face differently.
  [[noreturn]] void refuseLabels(UnionFind& faces) const {
    std::vector<SegmentId> by(labels_.size(), kNone);
    std::vector<RegionId> given(labels_.size(), kUnlabelled);
    for (TriId t = 0; t < triangles_.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const SegmentId s = triangles_[t].seg[i];
        if (s == kNone || labelOn(t, i) == kUnlabelled) continue;
        const FaceId face = faces.find(part_of_[t]);
        if (by[face] != kNone && given[face] != labelOn(t, i)) throw LabelClash(s, by[face]);
        by[face] = s;
        given[face] = labelOn(t, i);
      }
    }
    throw std::logic_error("labels that contradict one another were not found again");
  }

  // The label that the segment on edge i gives to triangle t.
  RegionId labelOn(TriId t, unsigned i) const {
    const Segment& segment = pslg_.segments[triangles_[t].seg[i]];
    return triangles_[t].v[next3(i)] == segment.a ? segment.left : segment.right;
  }

  const Triangulation& all_;
  std::span<const Triangle> triangles_;
  const Pslg& pslg_;
  const ItemLoop& loop_;
  BulkList<FaceId> part_of_;  // of each triangle
  // By part; then those of faces.
  std::vector<RegionId> labels_;
  std::vector<Join> joins_;
  bool clashes_ = false;
};

}  // namespace

BulkList<RegionId> regionsOf(const Triangulation& triangulation, const Pslg& pslg, const ItemLoop& loop) {
  return Carver(triangulation, pslg, loop).run();
}

}  // namespace coastmesh
