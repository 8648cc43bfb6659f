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

// What all pieces of one region share, for whoever works on some of them elsewhere.
struct PieceContext {
  Pslg pslg;
  RefineOptions options;                        // but for what a PieceTask says
  std::unique_ptr<const SizeFunction> size;     // that `options` point to
  std::shared_ptr<const InputCorners> corners;  // null where there are none
};

// The same as bytes. REQUIRES: wanted lengths, where there are some, are a SizeTree or a ConstantSize.
std::string contextBytes(const Pslg& pslg, const RefineOptions& options, const InputCorners* corners);
// Throws std::runtime_error where the bytes are not of a context.
PieceContext contextFrom(std::string_view bytes);

}  // namespace coastmesh
