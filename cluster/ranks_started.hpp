#pragma once

namespace coastmesh {

// The number of processes started together by mpirun or a similar launcher, this one included, according to the
// environment; 1 if it has no such variable. And the number of this process, from 0.
int ranksStarted();
int rankStarted();

// Makes a launcher that uses PMI, such as MPICH's, end all ranks with this exit code; otherwise it chooses its own if a
// rank ends without finalising MPI. Does nothing with other launchers.
void tellLauncher(int exit_code);

}  // namespace coastmesh
