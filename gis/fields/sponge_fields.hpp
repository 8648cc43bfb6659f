#pragma once

#include <array>

namespace coastmesh {

// The nodal attributes of FVCOM's sponge at open boundaries: radius and damping. Its files take both or none.
inline constexpr std::array<const char*, 2> kSpongeFields{"sponge_radius", "sponge_coefficient"};

}  // namespace coastmesh
