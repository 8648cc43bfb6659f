#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/cli/interrupt.hpp"
#include "apps/usage/option_table.hpp"
#include "gis/file/staged_files.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"

namespace coastmesh {

// Throws OptionError where outputs of the run that `line` asks for share a file, or one would replace what the run
// reads: any file that an option or an argument names, those that belong to it, and those that it takes its data from.
// To be called before anything is read or written. `besides`: what the run reads that `table` does not name.
void requireOutputsApart(const OptionTable& table, const std::vector<OptionTable::NamedFile>& besides = {});
// The same of outputs that `table` does not name: of a run that reads the files `read`.
void requireOutputsApart(const std::vector<OptionTable::NamedOutput>& outputs,
                         const std::vector<OptionTable::NamedFile>& read);

// The files on the disk that reading what an option names may read: those in the name, those that they take their data
// from (the tiles of a VRT), and those that belong to one of them (a shapefile's .dbf), as far as they are there.
std::vector<std::string> filesReadBy(const std::string& name);

// Whether an output exists, for --skip-existing. An empty file is what a full disk left of one.
bool isMade(const std::string& path);

// All outputs of a run: none comes into place before all are written, and then all do or none.
class RunOutputs {
 public:
  RunOutputs(bool overwrite, std::vector<std::string> inputs, Interrupt& interrupt)
      : overwrite_(overwrite), inputs_(std::move(inputs)), interrupt_(interrupt) {}
  ~RunOutputs();
  RunOutputs(const RunOutputs&) = delete;
  RunOutputs& operator=(const RunOutputs&) = delete;

  // Mesh files. `format` names the format of the one path there is then; empty takes every path's ending. Throws
  // OptionError, OutputError.
  void addGrids(const std::vector<std::string>& paths, const std::string& format);
  // Any other file.
  StagedFiles& addFile(const std::string& path);
  // A text for programs: a file, or "-" for standard output. Nothing where `path` is empty.
  void addReport(const std::string& path);

  std::size_t grids() const { return grids_.size(); }
  void writeGrid(std::size_t index, const Grid& grid, const ItemLoop& loop) { grids_[index].write(grid, loop); }
  void writeReport(const std::string& text);
  // Warnings where outputs hold numbers that models take for something else: depths of 0 where the grid has none,
  // coordinates in other units than metres.
  std::vector<std::string> numberWarnings(const Grid& grid) const;
  // A warning for each output that cannot hold all of the grid.
  std::vector<std::string> lossWarnings(const Grid& grid, LossesOf of) const;

  // Moves all that was written into place, after Interrupt::close(). Throws OutputError, Cancelled, and std::bad_alloc
  // where memory lacked for anything.
  void commit();
  // The same for some of a run's outputs, after which it goes on: it can be interrupted again.
  void commitAndGoOn();

 private:
  void guard(const StagedFiles& files);
  void moveIntoPlace();

  bool overwrite_;
  std::vector<std::string> inputs_;
  Interrupt& interrupt_;
  std::vector<StagedOutput> grids_;
  std::vector<const GridFormat*> formats_;  // one a grid
  std::vector<std::unique_ptr<StagedFiles>> files_;
  StagedFiles* report_ = nullptr;
  bool report_to_stdout_ = false;
  std::string report_text_;
  std::vector<std::string> depth_paths_;        // of formats that say a depth at each node
  std::vector<std::string> metre_paths_;        // of formats whose coordinates are read as metres
  std::vector<std::filesystem::path> guarded_;  // to be released without asking for memory
};

}  // namespace coastmesh
