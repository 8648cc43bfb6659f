#pragma once

#include <cstddef>
#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// A type of ADCIRC's flux boundaries (IBTYPE), as its reader of fort.14 defines it.
struct Ibtype {
  int number = 0;
  BoundaryRole role = BoundaryRole::Land;  // its role in other models
  std::size_t values = 0;                  // heights and coefficients that follow each node: a weir's
  bool has_back_nodes = false;             // before them, each node is followed by the node across

  bool isWeir() const { return values > 0; }
  bool closesItself() const { return role == BoundaryRole::Island; }  // its first node is not repeated
};

// Null if ADCIRC has no such type.
const Ibtype* findIbtype(int number);

// The type written for a role without a type: 20 land, 21 a closed island, 22 river.
int ibtypeOf(BoundaryRole role, bool closed);
bool isRolesOwn(int number);  // one of these three

// True if the boundary has a weir's type, but no heights.
bool isBareWeir(const Boundary& boundary);

// True if the boundary has an island's type, which ADCIRC would close, but is only a part of a shore.
bool isPartOfIsland(const Boundary& boundary);
// The type of other shores with the same condition as an island's: 20 for 21.
int mainlandType(int island);

// The types that a user may give for a boundary: those without values at nodes. "0, 1, 2, 10, …"
std::string givableIbtypes();

}  // namespace coastmesh
