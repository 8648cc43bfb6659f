#pragma once

namespace coastmesh {

// How many processes this one was started with, itself included, by mpirun or the like, as these say in the
// environment: 1 where nothing says so. And which of them it is, from 0.
int ranksStarted();
int rankStarted();

// Has a launcher that speaks PMI, as MPICH's, end all ranks with this exit code: it would make one of its own where a
// rank ends without MPI's leave. Does nothing elsewhere.
void tellLauncher(int exit_code);

}  // namespace coastmesh
