#pragma once

#include <filesystem>

namespace coastmesh {

// Processes that outlive the one that does the work. A parent: where its child is killed, the exit code is that of an
// interrupted run, in place of none; signals to end go on to the child, and where the parent is killed the child is
// interrupted. And a sweeper, who removes the child's folders under guard when it is gone, even where parent and child
// are killed together.
class Keeper {
 public:
  // What is done where the child was killed: `tell` is called with the exit code.
  struct Lost {
    int rank = 0;  // what messages call the child
    void (*tell)(int exit_code);
  };
  // Forks, and returns in the child alone: the parent ends with the child's exit code. To be called before there are
  // threads. Where no child can be made, this process goes on alone.
  explicit Keeper(const Lost& lost);
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  // Tells the sweeper of a folder, by its path from the root.
  void note(const std::filesystem::path& folder, bool guarded) const noexcept;

 private:
  int to_sweeper_ = -1;
};

}  // namespace coastmesh
