#pragma once

#include <string>
#include <vector>

#include "apps/interrupt.hpp"
#include "gis/grid_io.hpp"
#include "gis/grid_losses.hpp"

namespace coastmesh {

// The mesh files that a command makes: none comes into place before all are written. Each appears whole or not at all.
class GridOutputs {
 public:
  // `format` names the format of the one path there is then; empty takes every path's ending. Refuses two outputs of
  // the same path and an output that is one of `inputs` (UsageError), existing targets unless `overwrite`
  // (OutputError).
  GridOutputs(const std::vector<std::string>& paths, const std::string& format, bool overwrite,
              const std::vector<std::string>& inputs, Interrupt& interrupt);

  // Empty, or a warning: an output tells depths, and the grid has none.
  std::string depthWarning(const Grid& grid) const;
  // A warning for each output that cannot hold all of the grid.
  std::vector<std::string> lossWarnings(const Grid& grid, LossesOf of) const;
  std::size_t size() const { return outputs_.size(); }
  void write(std::size_t index, const Grid& grid);  // throws OutputError
  // Moves all into place. After Interrupt::close().
  void commit();

 private:
  std::vector<std::string> paths_;
  std::vector<const GridFormat*> formats_;  // one a path
  std::vector<StagedOutput> outputs_;
  std::vector<std::string> depth_paths_;  // of formats that tell a depth at each node
};

}  // namespace coastmesh
