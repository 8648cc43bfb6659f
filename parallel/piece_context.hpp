#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/input_corners.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/size_function.hpp"

namespace coastmesh {

// The shared data of all pieces of a region, for processes that work on some of them.
struct PieceContext {
  Pslg pslg;
  RefineOptions options;                        // except what a PieceTask contains
  std::unique_ptr<const SizeFunction> size;     // referred to by `options`
  std::shared_ptr<const InputCorners> corners;  // null if there are none
};

// The context as bytes. REQUIRES: requested lengths, if any, are a SizeTree or a ConstantSize.
std::string contextBytes(const Pslg& pslg, const RefineOptions& options, const InputCorners* corners);
// Throws std::runtime_error if the bytes are not a context.
PieceContext contextFrom(std::string_view bytes);

}  // namespace coastmesh
