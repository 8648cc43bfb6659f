#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/submesh.hpp"
#include "core/run_control.hpp"
#include "parallel/deal.hpp"
#include "parallel/piece_context.hpp"

namespace coastmesh {

enum class PieceWork : std::uint8_t { Refine, RefineAndMend, Repair, Coarsen, Optimise };

// The operation on a piece of a mesh, and those of its options that change from round to round.
struct PieceTask {
  PieceWork work = PieceWork::Refine;
  std::int32_t sweeps = 0;  // for Optimise
  double min_angle_deg = 0.0, max_angle_deg = 180.0;
  double size_max = 0.0, size_scale = 1.0;
  std::uint64_t max_vertices = 0;

  static PieceTask of(PieceWork work, const RefineOptions& options, int sweeps = 0);
};

RefineStats workOn(const PieceTask& task, MeshState& state, const Pslg& pslg, const RefineOptions& options,
                   const RunControl& control);

// A task and its piece as bytes; without links between triangles, which follow from their corners, and without the
// shared context of the region's pieces.
std::string requestFor(const PieceTask& task, const MeshState& state);
// Reads the reply to a request into the piece that was sent. Throws OutOfRoom if that was the reply, HelperFailed and
// HelperOutOfMemory.
RefineStats takePiece(Reply&& reply, MeshState& state);

// Executes a request; returns the reply's bytes. Throws Cancelled, and std::runtime_error for an invalid request.
std::string answerPiece(std::string_view request, const PieceContext& context, const RunControl& control);

}  // namespace coastmesh
