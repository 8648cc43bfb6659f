#include "cluster/transport.hpp"

namespace coastmesh {

std::unique_ptr<Transport> joinRanks() {
  throw CannotJoin(
      "this coastmesh was started as one of several ranks, but built without MPI: start it alone, or build it with "
      "-DCOASTMESH_MPI=ON");
}

}  // namespace coastmesh
