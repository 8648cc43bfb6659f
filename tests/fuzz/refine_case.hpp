#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/pslg.hpp"
#include "core/refine/refine.hpp"

namespace coastmesh {

// An input of the core with what is asked of it.
struct RefineCase {
  Pslg pslg;
  RefineOptions options;
  bool coarsen = true;
};

enum class Verdict {
  Refused,   // constrainedDelaunay says that it is no PSLG
  Held,      // everything holds that should
  TooLarge,  // cut off: the input needs more vertices than the limit, whatever the method
  Failed,
};

struct CaseResult {
  Verdict verdict = Verdict::Held;
  std::string failure;  // which rule broke, the same words for the same rule; the kind of defect where refused
  std::string detail;   // where and how
  std::uint64_t vertices = 0;
};

struct CaseLimits {
  std::uint64_t most_vertices = 100000;  // a run is cut off there and judged by `TooLarge`'s standard
  bool repeat = false;                   // run it twice and compare, bit for bit
};

// Meshes the input and judges every stage's result: valid by `checkMesh`; every bound violation listed, and nothing
// else; areas of regions kept; counts that agree; no more vertices than a bound that follows from the input; coarsening
// leaves no more vertices than it found, and no bad triangle where there was none.
CaseResult runCase(const RefineCase& refine_case, const CaseLimits& limits = {});

std::string_view nameOf(Algorithm algorithm);

}  // namespace coastmesh
