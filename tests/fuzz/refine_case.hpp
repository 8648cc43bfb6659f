#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/pslg.hpp"
#include "core/refine/refine.hpp"

namespace coastmesh {

// An input of the core with its options.
struct RefineCase {
  Pslg pslg;
  RefineOptions options;
  bool coarsen = true;
};

enum class Verdict {
  Refused,   // constrainedDelaunay rejects it as a PSLG
  Held,      // no rule is broken
  TooLarge,  // cut off at the limit, but the input may need so many vertices
  Failed,
};

struct CaseResult {
  Verdict verdict = Verdict::Held;
  std::string failure;  // the broken rule, in the same words every time; for Refused the kind of defect
  std::string detail;   // where and how
  std::uint64_t vertices = 0;
};

struct CaseLimits {
  std::uint64_t most_vertices = 100000;  // runs are cut off here; the verdict is then TooLarge or Failed
  bool repeat = false;                   // run twice and compare, bit for bit
};

// Meshes the input and checks the result of each stage: valid by `checkMesh`; exactly the bound violations are listed;
// areas of regions are kept; counts agree; no more vertices than a bound that follows from the input; coarsening adds
// no vertices, and no bad triangles if there were none.
CaseResult runCase(const RefineCase& refine_case, const CaseLimits& limits = {});

std::string_view nameOf(Algorithm algorithm);

}  // namespace coastmesh
