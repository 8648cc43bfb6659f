#include "parallel/piece_task.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/size/size_tree.hpp"
#include "core/triangulate/delaunay.hpp"
#include "parallel/piece_context.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;

constexpr double kSizeMax = 0.2;

PieceTask task(PieceWork work = PieceWork::Refine) {
  return PieceTask::of(work, {.min_angle_deg = 30.0, .size_max = kSizeMax});
}

// The unit square as one piece that is due.
MeshState square() {
  MeshState state;
  state.mesh = constrainedDelaunay(squarePslg());
  state.mesh.regions.clear();
  state.notes = noteInput(state.mesh, TriangleBound(30.0, 180.0, kSizeMax));
  state.due_triangles.assign(state.mesh.triangles.size(), 1);
  return state;
}

PieceContext squareContext() { return contextFrom(contextBytes(squarePslg(), {}, nullptr)); }

std::string answered(const MeshState& state, const PieceTask& task) {
  return answerPiece(requestFor(task, state), squareContext(), {});
}

// The message with which bytes are refused.
std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "not refused";
}

TEST(PieceTask, IsDoneFromItsBytesAsOnThePieceItself) {
  const Pslg pslg = squarePslg();
  MeshState here = square(), there = here;
  workOn(task(), here, pslg, {}, {});
  takePiece({Reply::Outcome::Done, answered(there, task())}, there);
  EXPECT_GT(here.mesh.points.size(), 20u);
  EXPECT_EQ(digestOf(there.mesh), digestOf(here.mesh));
  EXPECT_EQ(there.notes.spacing, here.notes.spacing);
  EXPECT_EQ(there.due_triangles, here.due_triangles);
}

TEST(PieceTask, WithoutRoomIsReportedWithThePlace) {
  RefineOptions options;
  options.most_in_memory = 10;
  const PieceContext context = contextFrom(contextBytes(squarePslg(), options, nullptr));
  MeshState state = square();
  std::string bytes = answerPiece(requestFor(task(), state), context, {});
  try {
    takePiece({Reply::Outcome::Done, std::move(bytes)}, state);
    FAIL();
  } catch (const OutOfRoom& error) {
    EXPECT_TRUE(error.place.x >= 0.0 && error.place.x <= 1.0 && error.place.y >= 0.0 && error.place.y <= 1.0);
  }
}

TEST(PieceTask, ARequestIsRefusedWhereverItEnds) {
  const std::string request = requestFor(task(), square());
  const PieceContext context = squareContext();
  for (std::size_t size = 0; size < request.size(); ++size)
    EXPECT_THROW(answerPiece(request.substr(0, size), context, {}), std::runtime_error) << size;
  EXPECT_THAT(refusal([&] { answerPiece(request + "x", context, {}); }), HasSubstr("longer"));
}

TEST(PieceTask, AReplyIsRefusedWhereverItEnds) {
  MeshState state = square();
  const std::string reply = answered(state, task());
  for (std::size_t size = 0; size < reply.size(); ++size) {
    MeshState copy = state;
    EXPECT_THROW(takePiece({Reply::Outcome::Done, reply.substr(0, size)}, copy), std::runtime_error) << size;
  }
  EXPECT_THAT(refusal([&] { takePiece({Reply::Outcome::Done, reply + "x"}, state); }), HasSubstr("longer"));
}

TEST(PieceTask, ADamagedPieceIsRefused) {
  const std::vector<std::pair<std::string, std::function<void(MeshState&)>>> cases = {
      {"vertices of a piece", [](MeshState& state) { state.mesh.input_vertices = 99; }},
      {"no vertex", [](MeshState& state) { state.mesh.triangles[0].v[1] = 99; }},
      {"not linked",
       [](MeshState& state) {
         for (auto& twin : state.mesh.triangles[0].adj) twin = kNone;
       }},
      {"another input", [](MeshState& state) { state.notes.corners = std::make_shared<const InputCorners>(); }},
      {"another input", [](MeshState& state) { state.notes.surface = Surface::sphere(1.0); }},
  };
  for (const auto& [reason, damage] : cases) {
    MeshState state = square();
    damage(state);
    EXPECT_THAT(refusal([&] { answered(state, task()); }), HasSubstr(reason));
  }
}

TEST(PieceTask, UnknownWorkIsRefused) {
  EXPECT_THAT(refusal([] { answered(square(), task(static_cast<PieceWork>(9))); }), HasSubstr("nobody knows"));
}

TEST(PieceContext, ComesBackWithItsSizesAndCorners) {
  const ConstantSize size(0.25);
  RefineOptions options;
  options.size = &size;
  const Pslg pslg = squarePslg();
  const InputCorners corners(constrainedDelaunay(pslg), TriangleBound(95.0, 180.0, 0.0));
  ASSERT_FALSE(corners.all().empty());
  const PieceContext context = contextFrom(contextBytes(pslg, options, &corners));
  EXPECT_EQ(context.pslg.points.size(), pslg.points.size());
  ASSERT_NE(context.options.size, nullptr);
  EXPECT_EQ(context.options.size->least(), 0.25);
  ASSERT_NE(context.corners, nullptr);
  EXPECT_EQ(context.corners->all().size(), corners.all().size());
}

TEST(PieceContext, IsRefusedWhereverItEnds) {
  const InputCorners none;
  const std::string bytes = contextBytes(squarePslg(), {}, &none);
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THROW(contextFrom(bytes.substr(0, size)), std::runtime_error) << size;
  EXPECT_THAT(refusal([&] { contextFrom(bytes + "x"); }), HasSubstr("longer"));
}

TEST(PieceContext, RefusesSizesThatItCannotSend) {
  class Other final : public SizeFunction {
   public:
    double at(const Point&) const override { return 1.0; }
    double least() const override { return 1.0; }
    double most() const override { return 1.0; }
  };
  const Other other;
  RefineOptions options;
  options.size = &other;
  EXPECT_THROW(contextBytes(squarePslg(), options, nullptr), std::logic_error);
}

}  // namespace
}  // namespace coastmesh
