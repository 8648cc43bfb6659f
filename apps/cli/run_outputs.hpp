#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/process/interrupt.hpp"
#include "apps/usage/option_table.hpp"
#include "gis/file/staged_files.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"
#include "gis/model/depth.hpp"

namespace coastmesh {

// Throws OptionError if outputs of the run share a file, or if one would replace something that the run reads: a file
// that an option or an argument names, one that belongs to it, or one that it takes its data from. To be called before
// anything is read or written. `besides`: files that the run reads and `table` does not name.
void requireOutputsApart(const OptionTable& table, const std::vector<OptionTable::NamedFile>& besides = {});
// The same for given outputs, and a run that reads the files `read`.
void requireOutputsApart(const std::vector<OptionTable::NamedOutput>& outputs,
                         const std::vector<OptionTable::NamedFile>& read);

// The existing files that may be read for an option's value: those in the name, those that they take their data from
// (the tiles of a VRT), and those that belong to one of them (a shapefile's .dbf).
std::vector<std::string> filesReadBy(const std::string& name);

// True if an output exists, for --skip-existing. An empty file does not count: a full disk leaves such files.
bool isMade(const std::string& path);

// All outputs of a run: they are moved into place when all are written, either all or none.
class RunOutputs {
 public:
  RunOutputs(bool overwrite, std::vector<std::string> inputs, Interrupt& interrupt)
      : overwrite_(overwrite), inputs_(std::move(inputs)), interrupt_(interrupt) {}
  ~RunOutputs();
  RunOutputs(const RunOutputs&) = delete;
  RunOutputs& operator=(const RunOutputs&) = delete;

  // Mesh files. `format`: of the only path; empty: the endings of the paths decide. Throws OptionError, OutputError.
  void addGrids(const std::vector<std::string>& paths, const std::string& format);
  // Any other file.
  StagedFiles& addFile(const std::string& path);
  // A report: in a file, or on standard output if `path` is "-". Nothing if `path` is empty.
  void addReport(const std::string& path);

  // The folders that hold the outputs until they are moved into place.
  const std::vector<std::filesystem::path>& unfinished() const { return guarded_; }
  std::size_t grids() const { return grids_.size(); }
  void writeGrid(std::size_t index, const Grid& grid, const ItemLoop& loop) { grids_[index].write(grid, loop); }
  // One grid into all mesh files. Throws Cancelled if the run is interrupted between two of them.
  void writeGrids(const Grid& grid, const ItemLoop& loop);
  void writeReport(const std::string& text);
  // A warning, to be given before the mesh is made, if nodes may stay without a depth and an output cannot be written
  // then; else empty.
  std::string unknownDepthWarning(const DepthOptions& depth) const;
  // Warnings about numbers that models would misread: depths of 0 where the grid has none, coordinates that are not
  // metres, or not true to scale.
  std::vector<std::string> numberWarnings(const Grid& grid) const;
  // A warning for each output that cannot hold all of the grid.
  std::vector<std::string> lossWarnings(const Grid& grid, LossesOf of) const;
  // Lines for the summary on what models call open boundaries and rivers: see `openingsIn`.
  std::string openingsText(const Grid& grid) const;

  // Moves everything written into place, after Interrupt::close(). Throws OutputError, Cancelled, and std::bad_alloc if
  // any allocation failed.
  void commit();

 private:
  friend void commitInTurn(std::span<const std::unique_ptr<RunOutputs>> parts, const ItemLoop& loop);
  void guard(const StagedFiles& files);
  std::vector<StagedFiles*> made();

  bool overwrite_;
  std::vector<std::string> inputs_;
  Interrupt& interrupt_;
  std::vector<StagedOutput> grids_;
  std::vector<const GridFormat*> formats_;  // of each grid
  std::vector<std::unique_ptr<StagedFiles>> files_;
  StagedFiles* report_ = nullptr;
  bool report_to_stdout_ = false;
  std::string report_text_;
  std::vector<std::string> depth_paths_;        // of formats with a depth at each node
  std::vector<std::string> full_depth_paths_;   // of formats that cannot say that a node has no depth
  std::vector<std::string> metre_paths_;        // of formats whose coordinates are read as metres
  std::vector<std::filesystem::path> guarded_;  // copied, so that releasing them allocates nothing
};

// Moves several parts of a run's outputs into place, one after another: each appears whole or not at all. First waits
// once until all of them are on disk, with `loop`. The run continues and can be interrupted again. REQUIRES: they have
// the same `Interrupt`. Throws as `commit`; then the parts before the one that failed may be in place.
void commitInTurn(std::span<const std::unique_ptr<RunOutputs>> parts, const ItemLoop& loop);

}  // namespace coastmesh
