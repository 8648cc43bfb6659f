#include "gis/check/target_defect.hpp"

#include <array>
#include <cstddef>

namespace coastmesh {
namespace {

constexpr std::array<std::string_view, kTargetDefectKinds> kKindNames{
    "wrong count",     "broken edge",  "clockwise",       "overlapping triangles", "unused node",
    "repeated node",   "hanging node", "pinched node",    "orphan cell",           "unknown depth",
    "dry opening",     "no boundary",  "stray boundary",  "boundary twice",        "boundary turned",
    "looped boundary", "wrong shore",  "two open edges",  "open and solid",        "open bridge",
    "one neighbour",   "lone wall",    "valence",         "large angle",           "not orthogonal",
    "small flow link", "courant",      "round the globe", "quadrilateral",         "bed above crest"};

}  // namespace

std::string_view toString(TargetDefectKind kind) { return kKindNames[static_cast<std::size_t>(kind)]; }

}  // namespace coastmesh
