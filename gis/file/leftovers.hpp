#pragma once

#include <string>

namespace coastmesh {

// The name of a new staging folder beside `target`, to be completed by mkdtemp: ".lake.nc.part-BOOT-PID-START-XXXXXX".
// BOOT stands for the start of this machine and the process's numbering of processes (its PID namespace), which
// containers may have of their own; START is when the process began. ".lake.nc.part-XXXXXX" where the system does not
// tell these, or the name would be too long.
std::string stagingPattern(const std::string& target);

// Removes the staging folders in `folder`, of any output, of processes that were killed. Only those that cannot be of a
// running process: BOOT is that of this process, and there is no process PID, or it began at another time. So folders
// of other machines that share the disk stay, and those from before a restart. Folders of other users and those with
// files that were being replaced stay too.
void removeLeftovers(const std::string& folder);

}  // namespace coastmesh
