#pragma once

namespace coastmesh {

// The number of processes started together by mpirun or a similar launcher, this one included, as the environment says:
// 1 if it says nothing. And the number of this process, from 0.
int ranksStarted();
int rankStarted();

// Makes a launcher that speaks PMI, such as MPICH's, end all ranks with this exit code; otherwise it chooses its own if
// a rank ends without finalising MPI. Does nothing with other launchers.
void tellLauncher(int exit_code);

}  // namespace coastmesh
