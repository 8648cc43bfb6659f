#include "core/delaunay.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<VertexId, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel,
                                                           CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage,
                                                       CGAL::No_constraint_intersection_requiring_constructions_tag>;
using FaceHandle = Cdt::Face_handle;
using VertexHandle = Cdt::Vertex_handle;

[[noreturn]] void refuse(PslgDefect::Kind kind, const Point& place, SegmentId segment, std::string message) {
  throw BadPslg({kind, place, segment, std::move(message)});
}

void checkReferences(const Pslg& pslg) {
  for (const Point& p : pslg.points)
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      refuse(PslgDefect::Kind::NotFinite, p, kNone, "a coordinate is not a finite number");
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const auto& [a, b, tag, left, right] = pslg.segments[s];
    if (a >= pslg.points.size() || b >= pslg.points.size())
      refuse(PslgDefect::Kind::UnknownVertex, {}, s, "a segment names a vertex that does not exist");
    if (a == b) refuse(PslgDefect::Kind::SegmentOfNoLength, pslg.points[a], s, "a segment has no length");
  }
}

// Points go in along a space-filling curve, each found from the one before.
std::vector<VertexHandle> insertPoints(const Pslg& pslg, Cdt& cdt) {
  std::vector<Kernel::Point_2> points;
  points.reserve(pslg.points.size());
  for (const Point& p : pslg.points) points.emplace_back(p.x, p.y);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto map = CGAL::make_property_map(points);
  CGAL::spatial_sort(order.begin(), order.end(), CGAL::Spatial_sort_traits_adapter_2<Kernel, decltype(map)>(map));

  std::vector<VertexHandle> handles(points.size());
  FaceHandle hint;
  for (std::size_t i : order) {
    const std::size_t before = cdt.number_of_vertices();
    const VertexHandle v = cdt.insert(points[i], hint);
    if (cdt.number_of_vertices() == before)
      refuse(PslgDefect::Kind::PointsCoincide, pslg.points[i], kNone, "two vertices lie at the same place");
    v->info() = static_cast<VertexId>(i);
    handles[i] = v;
    hint = v->face();
  }
  return handles;
}

// The vertex that lies inside a segment; asked for only once it is known that there is one.
Point vertexInside(const Pslg& pslg, const Segment& s) {
  const Point &a = pslg.points[s.a], &b = pslg.points[s.b];
  const auto isInside = [&](const Point& p) {
    return p != a && p != b && orient2d(a, b, p) == 0 && dot(p - a, b - a) > 0.0 && dot(p - b, a - b) > 0.0;
  };
  const auto found = std::ranges::find_if(pslg.points, isInside);
  return found == pslg.points.end() ? a : *found;
}

// Where a segment crosses one of those before it; asked for only once it is known that it does.
Point crossingWith(const Pslg& pslg, SegmentId crossing) {
  const Point &a = pslg.points[pslg.segments[crossing].a], &b = pslg.points[pslg.segments[crossing].b];
  for (SegmentId s = 0; s < crossing; ++s) {
    const Point &c = pslg.points[pslg.segments[s].a], &d = pslg.points[pslg.segments[s].b];
    if (orient2d(a, b, c) * orient2d(a, b, d) >= 0 || orient2d(c, d, a) * orient2d(c, d, b) >= 0) continue;
    const double from = cross(d - c, a - c), to = cross(d - c, b - c);
    return a + (from / (from - to)) * (b - a);
  }
  return a;
}

void insertSegments(const Pslg& pslg, const std::vector<VertexHandle>& handles, Cdt& cdt) {
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const VertexHandle a = handles[pslg.segments[s].a], b = handles[pslg.segments[s].b];
    try {
      cdt.insert_constraint(a, b);
    } catch (const Cdt::Intersection_of_constraints_exception&) {
      refuse(PslgDefect::Kind::SegmentsCross, crossingWith(pslg, s), s, "two segments cross");
    }
    if (!cdt.is_edge(a, b))
      refuse(PslgDefect::Kind::PointOnSegment, vertexInside(pslg, pslg.segments[s]), s,
             "a vertex lies inside a segment");
  }
}

constexpr RegionId kUnvisited = kUnlabelled;

// Decides for every face which region it belongs to, by flooding from what is known up to the segments.
class Carver {
 public:
  Carver(const Pslg& pslg, const Cdt& cdt, std::vector<FaceHandle> faces)
      : pslg_(pslg), cdt_(cdt), faces_(std::move(faces)), region_(faces_.size(), kUnvisited) {}

  std::vector<RegionId> run(const std::vector<std::array<SegmentId, 3>>& segments) {
    bool labelled = false;
    for (const Segment& s : pslg_.segments) labelled |= s.left != kUnlabelled || s.right != kUnlabelled;
    if (labelled) {
      floodFromLabels(segments);
    } else {
      if (!pslg_.segments.empty()) flood(cdt_.infinite_face()->info(), kOutside);
      for (const Point& hole : pslg_.holes) {
        const FaceHandle f = cdt_.locate({hole.x, hole.y});
        if (f != nullptr) flood(f->info(), kOutside);
      }
      for (RegionId& r : region_)
        if (r == kUnvisited) r = 0;
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
      if (region_[f] == kUnvisited || cdt_.is_infinite(faces_[f])) region_[f] = kOutside;
    return std::move(region_);
  }

 private:
  void floodFromLabels(const std::vector<std::array<SegmentId, 3>>& segments) {
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      for (int i = 0; i < 3; ++i) {
        const SegmentId s = segments[f][i];
        if (s == kNone) continue;
        const bool along = faces_[f]->vertex(Cdt::ccw(i))->info() == pslg_.segments[s].a;
        const RegionId label = along ? pslg_.segments[s].left : pslg_.segments[s].right;
        if (label == kUnlabelled) continue;
        if (region_[f] == kUnvisited) flood(f, label);
        if (region_[f] != label) throw std::logic_error("the labels of a PSLG's segments contradict one another");
      }
    }
  }

  void flood(std::size_t start, RegionId label) {
    if (region_[start] != kUnvisited) return;
    region_[start] = label;
    stack_.push_back(start);
    while (!stack_.empty()) {
      const FaceHandle face = faces_[stack_.back()];
      stack_.pop_back();
      for (int i = 0; i < 3; ++i) {
        if (face->is_constrained(i)) continue;
        const std::size_t other = face->neighbor(i)->info();
        if (region_[other] != kUnvisited) continue;
        region_[other] = label;
        stack_.push_back(other);
      }
    }
  }

  const Pslg& pslg_;
  const Cdt& cdt_;
  std::vector<FaceHandle> faces_;
  std::vector<RegionId> region_;
  std::vector<std::size_t> stack_;
};

std::vector<FaceHandle> numberFaces(const Cdt& cdt) {
  std::vector<FaceHandle> faces;
  faces.reserve(cdt.tds().number_of_faces());
  for (auto f = cdt.all_faces_begin(); f != cdt.all_faces_end(); ++f) {
    f->info() = static_cast<std::uint32_t>(faces.size());
    faces.push_back(f);
  }
  return faces;
}

std::vector<std::array<SegmentId, 3>> segmentsOfFaces(const Pslg& pslg, const std::vector<VertexHandle>& handles,
                                                      const Cdt& cdt, std::size_t face_count) {
  std::vector<std::array<SegmentId, 3>> segments(face_count, {kNone, kNone, kNone});
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    FaceHandle f;
    int i = 0;
    cdt.is_edge(handles[pslg.segments[s].a], handles[pslg.segments[s].b], f, i);
    if (segments[f->info()][i] != kNone) {
      const Point &a = pslg.points[pslg.segments[s].a], &b = pslg.points[pslg.segments[s].b];
      refuse(PslgDefect::Kind::SegmentsCoincide, midpoint(a, b), s, "two segments have the same ends");
    }
    segments[f->info()][i] = s;
    const auto [g, j] = cdt.mirror_edge({f, i});
    segments[g->info()][j] = s;
  }
  return segments;
}

}  // namespace

TriMesh constrainedDelaunay(const Pslg& pslg) {
  checkReferences(pslg);
  Cdt cdt;
  const std::vector<VertexHandle> handles = insertPoints(pslg, cdt);
  if (cdt.dimension() < 2)
    refuse(PslgDefect::Kind::NoArea, pslg.points.empty() ? Point{} : pslg.points.front(), kNone,
           "the vertices lie on one line and enclose no area");
  insertSegments(pslg, handles, cdt);

  std::vector<FaceHandle> faces = numberFaces(cdt);
  const auto segments = segmentsOfFaces(pslg, handles, cdt, faces.size());
  const std::vector<RegionId> region = Carver(pslg, cdt, faces).run(segments);

  std::vector<TriId> kept(faces.size(), kNone);
  TriId count = 0;
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (region[f] != kOutside) kept[f] = count++;
  if (count == 0) refuse(PslgDefect::Kind::NoArea, pslg.points.front(), kNone, "the segments enclose no area");

  TriMesh mesh;
  mesh.points = pslg.points;
  mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  mesh.triangles.resize(count);
  mesh.regions.resize(count);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    if (kept[f] == kNone) continue;
    Triangle& t = mesh.triangles[kept[f]];
    mesh.regions[kept[f]] = region[f];
    t.seg = segments[f];
    for (int i = 0; i < 3; ++i) {
      t.v[i] = faces[f]->vertex(i)->info();
      const TriId other = kept[faces[f]->neighbor(i)->info()];
      if (other != kNone) t.adj[i] = edgeRef(other, static_cast<unsigned>(cdt.mirror_index(faces[f], i)));
    }
  }
  return mesh;
}

}  // namespace coastmesh
