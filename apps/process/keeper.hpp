#pragma once

#include <filesystem>

namespace coastmesh {

// Processes that outlive the working one. The parent passes on stop signals to the child, and ends with the exit code
// of an interrupted run if the child is killed; if the parent is killed, the child is interrupted. The sweeper removes
// the child's guarded folders when it is gone, even if parent and child are killed together.
class Keeper {
 public:
  // For a child that was killed: `tell` is called with the exit code.
  struct Lost {
    int rank = 0;  // of the child, for messages
    void (*tell)(int exit_code);
  };
  // Forks, and returns only in the child; the parent ends with the child's exit code. To be called before threads are
  // started. If no child can be made, this process continues alone.
  explicit Keeper(const Lost& lost);
  ~Keeper();
  Keeper(const Keeper&) = delete;
  Keeper& operator=(const Keeper&) = delete;

  // Reports a guarded or released folder to the sweeper. REQUIRES: an absolute path.
  void note(const std::filesystem::path& folder, bool guarded) const noexcept;

 private:
  int to_sweeper_ = -1;
};

}  // namespace coastmesh
