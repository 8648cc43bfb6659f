#include "parallel/piece_task.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/links.hpp"
#include "core/optimise/optimise.hpp"
#include "core/refine/submesh_runs.hpp"
#include "parallel/bytes.hpp"

namespace coastmesh {

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& task) requires std::is_same_v<std::remove_cvref_t<decltype(task)>, PieceTask> {
  auto& [work, sweeps, min_angle_deg, max_angle_deg, size_max, size_scale, max_vertices] = task;
  return std::tie(work, sweeps, min_angle_deg, max_angle_deg, size_max, size_scale, max_vertices);
}

namespace {

struct BadPiece : std::runtime_error {
  using std::runtime_error::runtime_error;
};
using Reader = BasicByteReader<BadPiece>;

// An edge that carries a segment.
struct SegmentEdge {
  EdgeRef edge;
  SegmentId seg;
};

void passTriangles(ByteWriter& writer, const TriMesh& mesh) {
  std::vector<VertexId> corners;
  std::vector<std::uint32_t> edges;
  std::uint64_t bare = 0;
  corners.reserve(3 * mesh.triangles.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangle(t);
    for (unsigned i = 0; i < 3; ++i) {
      corners.push_back(tri.v[i]);
      bare += tri.adj[i] == kNone;
      if (tri.seg[i] != kNone) edges.insert(edges.end(), {edgeRef(t, i), tri.seg[i]});
    }
  }
  writer.pass(corners);
  writer.pass(edges);
  writer.pass(bare);
}

// Links triangles by their corners; returns the number of edges without a twin.
std::uint64_t linkByCorners(TriMesh& mesh) {
  // The edges that begin at vertex v: from[first[v]] to from[first[v + 1]].
  std::vector<std::uint32_t> first(mesh.points.size() + 2, 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t.v) ++first[v + 2];
  for (std::size_t v = 2; v < first.size(); ++v) first[v] += first[v - 1];
  std::vector<EdgeRef> from(3 * mesh.triangles.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i) from[first[mesh.origin(edgeRef(t, i)) + 1]++] = edgeRef(t, i);
  std::uint64_t bare = 0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone) continue;
      const VertexId a = mesh.origin(e), b = mesh.target(e);
      const auto begin = from.begin() + first[b], end = from.begin() + first[b + 1];
      const auto twin = std::find_if(begin, end, [&](EdgeRef f) { return mesh.target(f) == a; });
      if (twin == end) {
        ++bare;
      } else {
        setTwins(mesh.triangles, e, *twin);
      }
    }
  }
  return bare;
}

void passTriangles(Reader& reader, TriMesh& mesh) {
  std::vector<VertexId> corners;
  std::vector<std::uint32_t> edges;
  std::uint64_t bare = 0;
  reader.pass(corners);
  reader.pass(edges);
  reader.pass(bare);
  if (corners.size() % 3 != 0 || edges.size() % 2 != 0) throw BadPiece("the triangles of a piece are damaged");
  mesh.triangles.clear();
  mesh.triangles.reserve(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    if (std::max({corners[i], corners[i + 1], corners[i + 2]}) >= mesh.points.size())
      throw BadPiece("a piece has a corner that is no vertex of it");
    mesh.triangles.push_back(unlinked({corners[i], corners[i + 1], corners[i + 2]}));
  }
  if (linkByCorners(mesh) != bare) throw BadPiece("the triangles of a piece are not linked as they were");
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    if (triOf(edges[i]) >= mesh.triangles.size() || indexOf(edges[i]) > 2)
      throw BadPiece("a piece has a segment on no edge of it");
    setSegment(mesh.triangles, edges[i], edges[i + 1]);
  }
}

constexpr std::uint8_t kDone = 0, kOutOfRoom = 1;

}  // namespace

PieceTask PieceTask::of(PieceWork work, const RefineOptions& options, int sweeps) {
  return {work,
          sweeps,
          options.min_angle_deg,
          options.max_angle_deg,
          options.size_max,
          options.size_scale,
          options.max_vertices};
}

RefineStats workOn(const PieceTask& task, MeshState& state, const Pslg& pslg, const RefineOptions& options,
                   const RunControl& control) {
  RefineOptions own = options;
  own.min_angle_deg = task.min_angle_deg;
  own.max_angle_deg = task.max_angle_deg;
  own.size_max = task.size_max;
  own.size_scale = task.size_scale;
  own.max_vertices = task.max_vertices;
  switch (task.work) {
    case PieceWork::Refine:
      return refineSubmesh(state, pslg, own, false, control);
    case PieceWork::RefineAndMend:
      return refineSubmesh(state, pslg, own, true, control);
    case PieceWork::Repair:
      return repairSubmesh(state, pslg, own, control);
    case PieceWork::Coarsen:
      return coarsenSubmesh(state, pslg, own, control);
    case PieceWork::Optimise:
      return optimiseSubmesh(state, pslg, own, task.sweeps, control);
  }
  throw BadPiece("a piece is asked for what nobody knows");
}

std::string requestFor(const PieceTask& task, const MeshState& state) {
  ByteWriter writer;
  writer.pass(task);
  writer.pass(state.mesh.input_vertices);
  writer.pass(state.mesh.points);
  passTriangles(writer, state.mesh);
  writer.pass(state.notes.surface.isCurved());
  writer.pass(state.notes.corners != nullptr);
  writer.pass(state.notes.spacing);
  writer.pass(state.notes.shell_unit);
  writer.passFlags(state.notes.small_angle);
  writer.passFlags(state.due_triangles);
  writer.passFlags(state.due_vertices);
  return writer.take();
}

std::string answerPiece(std::string_view request, const PieceContext& context, const RunControl& control) {
  Reader reader(request, "a request");
  PieceTask task;
  MeshState state;
  reader.pass(task);
  reader.pass(state.mesh.input_vertices);
  reader.pass(state.mesh.points);
  if (state.mesh.input_vertices > state.mesh.points.size()) throw BadPiece("the vertices of a piece are damaged");
  passTriangles(reader, state.mesh);
  bool curved = false, with_corners = false;
  reader.pass(curved);
  reader.pass(with_corners);
  if (curved) state.notes.surface = context.options.surface;
  if (with_corners) state.notes.corners = context.corners;
  if (curved != state.notes.surface.isCurved() || with_corners != (state.notes.corners != nullptr))
    throw BadPiece("a piece is of another input than the one that is here");
  reader.pass(state.notes.spacing);
  reader.pass(state.notes.shell_unit);
  reader.passFlags(state.notes.small_angle);
  reader.passFlags(state.due_triangles);
  reader.passFlags(state.due_vertices);
  if (!reader.atEnd()) throw BadPiece("a request is longer than it should be");

  ByteWriter writer;
  RefineStats stats;
  try {
    stats = workOn(task, state, context.pslg, context.options, control);
  } catch (const OutOfRoom& error) {
    writer.pass(kOutOfRoom);
    writer.pass(error.place);
    return writer.take();
  }
  writer.pass(kDone);
  writer.pass(stats);
  // The fixed vertices are unchanged, and the sender has them.
  writer.pass(std::vector<Point>(state.mesh.points.begin() + state.mesh.input_vertices, state.mesh.points.end()));
  passTriangles(writer, state.mesh);
  writer.pass(state.notes.spacing);
  writer.passFlags(state.due_triangles);
  writer.passFlags(state.due_vertices);
  return writer.take();
}

RefineStats takePiece(Reply&& reply, MeshState& state) {
  if (reply.outcome == Reply::Outcome::NoMemory) throw HelperOutOfMemory(reply.bytes);
  if (reply.outcome == Reply::Outcome::Failed) throw HelperFailed(reply.bytes);
  Reader reader(reply.bytes, "a reply");
  std::uint8_t outcome = kDone;
  reader.pass(outcome);
  if (outcome == kOutOfRoom) {
    Point place;
    reader.pass(place);
    throw OutOfRoom(place);
  }
  RefineStats stats;
  std::vector<Point> free;
  reader.pass(stats);
  reader.pass(free);
  state.mesh.points.resize(state.mesh.input_vertices);
  state.mesh.points.insert(state.mesh.points.end(), free.begin(), free.end());
  passTriangles(reader, state.mesh);
  reader.pass(state.notes.spacing);
  reader.passFlags(state.due_triangles);
  reader.passFlags(state.due_vertices);
  if (!reader.atEnd()) throw BadPiece("a reply is longer than it should be");
  return stats;
}

}  // namespace coastmesh
