#pragma once

namespace coastmesh {

// Keeps HDF5 from printing its errors in this thread. netCDF turns that off in the thread that first uses it only, and
// then takes many errors for answers: that an attribute does not exist, for example. To be called in each thread before
// it reads files that may be netCDF-4.
void quietHdf5();

}  // namespace coastmesh
