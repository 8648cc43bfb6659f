#pragma once

#include <cstddef>
#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// A type of ADCIRC's flux boundaries (IBTYPE), as its reader of fort.14 takes it.
struct Ibtype {
  int number = 0;
  BoundaryRole role = BoundaryRole::Land;  // what it is to other models
  std::size_t values = 0;                  // heights and coefficients that follow each node: a weir's
  bool has_back_nodes = false;             // and before them the node across

  bool isWeir() const { return values > 0; }
  bool closesItself() const { return role == BoundaryRole::Island; }  // its first node is not repeated
};

// Null where ADCIRC has no such type.
const Ibtype* findIbtype(int number);

// The type that a role alone has in a file: 20 land, 21 a closed island, 22 river.
int ibtypeOf(BoundaryRole role, bool closed);
bool isRolesOwn(int number);  // one of these three

// True iff the boundary's type is a weir's and the heights of one are missing.
bool isBareWeir(const Boundary& boundary);

// Types that a user may give for a boundary: those whose nodes need nothing besides. "0, 1, 2, 10, …"
std::string givableIbtypes();

}  // namespace coastmesh
