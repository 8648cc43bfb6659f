# coastmesh_precompile(TARGET [HEADER…]): with COASTMESH_PRECOMPILE, compiles headers of other projects once for a target
# rather than once for each of its sources: those of the standard library, and HEADER….
#
# Sources then compile without including what they use, which scripts/check-includes finds instead; it knows the names of
# each header. Own headers are left out: a change to one of them would compile everything again.
option(COASTMESH_PRECOMPILE "Precompile headers of the standard library and of GoogleTest" OFF)
function(coastmesh_precompile target)
  if(COASTMESH_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <atomic> <cmath> <filesystem> <fstream> <functional>
      <iostream> <limits> <map> <memory> <mutex> <numeric> <optional> <random> <ranges> <set> <span> <sstream> <string>
      <string_view> <unordered_map> <utility> <variant> <vector> ${ARGN})
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      # GCC forgets in precompiled headers that they are of the system, and warns of what is right in std::string.
      target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread
        -Wno-restrict)
    endif()
  endif()
endfunction()
