#include "core/piece.hpp"

#include <utility>

#include "core/refiner.hpp"
#include "core/repair.hpp"

namespace coastmesh {

RefineStats refinePiece(Piece& piece, const Pslg& pslg, const RefineOptions& options, bool mends,
                        const RunControl& control) {
  RefineVariant variant = usualVariant(options);
  variant.clear_of_frozen = true;
  std::vector<std::uint8_t> due = std::move(piece.due_triangles);
  Refiner refiner(std::move(piece.mesh), pslg, options, std::move(piece.notes), variant);

  std::vector<TriId> first;
  std::vector<BadTriangle> given_up;
  for (TriId t = 0; t < due.size(); ++t) {
    if (due[t]) {
      first.push_back(t);
    } else if (mends && refiner.isShort(t)) {
      given_up.push_back({t, refiner.mesh().triangle(t).v});
    }
  }
  refiner.resume(first, control);
  if (mends && options.algorithm == Algorithm::Relocate) repair(refiner, pslg, options, control, given_up);
  piece.mesh = refiner.release(piece.notes, piece.due_triangles);
  RefineStats stats = std::move(refiner.stats());
  stats.steiner_points = 0;
  return stats;
}

}  // namespace coastmesh
