#include "apps/cli/run_outputs.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <set>

#include "apps/process/memory_lacked.hpp"
#include "gis/error.hpp"
#include "gis/read/virtual_source.hpp"

namespace coastmesh {

namespace {

namespace fs = std::filesystem;

// Identifies a file whatever its path: by device and inode if it exists, otherwise by its path without links.
std::string identityOf(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return std::to_string(status.st_dev) + ':' + std::to_string(status.st_ino);
  std::error_code error;
  const fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : real.string();
}

bool isThere(const std::string& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// The files on disk that an option's value names: the path itself, or the paths within a name of GDAL's, such as
// "GPKG:file:layer", "/vsizip/file.zip/inside.shp" and "file|layer".
std::vector<std::string> filesNamed(const std::string& name) {
  std::vector<std::string> files{name};
  std::string part;
  const auto take = [&] {
    if (isThere(part)) files.push_back(part);
    part.clear();
  };
  for (const char c : name) {
    if (c == ':' || c == '|' || c == '"') {
      take();
    } else {
      part += c;
    }
  }
  take();
  if (name.starts_with("/vsi") || !isThere(name)) {
    const std::size_t begin = name.starts_with("/vsi") ? name.find('/', 1) : 0;
    for (std::size_t end = begin; end != std::string::npos && begin != std::string::npos;) {
      end = name.find('/', end + 1);
      const std::string outer = name.substr(begin + (begin > 0 ? 1 : 0), end - begin - (begin > 0 ? 1 : 0));
      std::error_code error;
      if (fs::is_regular_file(outer, error)) files.push_back(outer);
    }
  }
  return files;
}

// The same, with the files that these take their data from.
std::vector<std::string> filesNamedAndBehind(const std::string& name) {
  std::vector<std::string> all = filesNamed(name);
  for (const std::string& behind : filesBehind(name)) {
    const std::vector<std::string> files = filesNamed(behind);
    all.insert(all.end(), files.begin(), files.end());
  }
  return all;
}

struct Owner {
  std::string option, path;
};

class Inputs {
 public:
  explicit Inputs(const std::vector<OptionTable::NamedFile>& named) {
    for (const auto& [option, path] : named) {
      for (const std::string& file : filesNamedAndBehind(path)) {
        files_.try_emplace(identityOf(file), Owner{option, path});
        for (const std::string& companion : companionsOf(file))
          if (isThere(companion)) companions_.try_emplace(identityOf(companion), Owner{option, path});
      }
    }
  }

  void requireApart(const OptionTable::NamedOutput& output, const std::string& file, bool written) const {
    const std::string subject = output.option + " " + output.path + ": ";
    const std::string what = file == output.path ? "" : "'" + file + "', which it writes too, ";
    const auto input = files_.find(identityOf(file));
    if (input != files_.end())
      throw OptionError(subject + what + (what.empty() ? "it " : "") + "is input and output at once: " +
                        input->second.option + " reads it; give the output another name");
    const auto companion = companions_.find(identityOf(file));
    if (written && companion != companions_.end())
      throw OptionError(subject + what + (what.empty() ? "it " : "") + "belongs to '" + companion->second.path +
                        "', which " + companion->second.option + " reads; give the output another name");
  }

 private:
  std::map<std::string, Owner> files_, companions_;
};

// The files that outputs write, and those that they remove or keep.
class Claims {
 public:
  void add(const OptionTable::NamedOutput& output) {
    std::set<std::string> own;
    for (const std::string& file : output.files.targets) {
      const std::string key = identityOf(file);
      if (!own.insert(key).second) continue;
      for (const auto* taken : {&written_, &touched_}) {
        if (const auto other = taken->find(key); other != taken->end()) refuse(output, other->second, file);
      }
    }
    std::vector<std::string> others = output.files.stale;
    if (!output.files.prj.empty()) others.push_back(output.files.prj);
    for (const std::string& file : others) {
      const auto other = written_.find(identityOf(file));
      if (other != written_.end()) refuse(output, other->second, file);
    }
    for (const std::string& key : own) written_.try_emplace(key, Owner{output.option, output.path});
    for (const std::string& file : others) touched_.try_emplace(identityOf(file), Owner{output.option, output.path});
  }

 private:
  [[noreturn]] static void refuse(const OptionTable::NamedOutput& output, const Owner& other, const std::string& file) {
    if (output.option == other.option && identityOf(output.path) == identityOf(other.path))
      throw OptionError("'" + output.path + "' is given as an output twice");
    throw OptionError(output.option + " " + output.path + " and " + other.option + " " + other.path +
                      " would both write '" + file + "'; give one of them another name");
  }

  std::map<std::string, Owner> written_, touched_;
};

}  // namespace

std::vector<std::string> filesReadBy(const std::string& name) {
  // Journals of a database, which come and go as it is read.
  const auto isPassing = [](const std::string& file) { return file.ends_with("-wal") || file.ends_with("-journal"); };
  std::vector<std::string> files;
  for (const std::string& file : filesNamedAndBehind(name)) {
    files.push_back(file);
    for (const std::string& companion : companionsOf(file))
      if (isThere(companion) && !isPassing(companion)) files.push_back(companion);
  }
  return files;
}

void requireOutputsApart(const OptionTable& table, const std::vector<OptionTable::NamedFile>& besides) {
  const std::vector<OptionTable::NamedOutput> outputs = table.outputs();
  if (outputs.empty()) return;
  std::vector<OptionTable::NamedFile> read = table.inputs();
  read.insert(read.end(), besides.begin(), besides.end());
  requireOutputsApart(outputs, read);
}

void requireOutputsApart(const std::vector<OptionTable::NamedOutput>& outputs,
                         const std::vector<OptionTable::NamedFile>& read) {
  const Inputs inputs(read);
  Claims claims;
  for (const OptionTable::NamedOutput& output : outputs) {
    for (const std::string& file : output.files.targets) inputs.requireApart(output, file, true);
    for (const std::string& file : output.files.stale) inputs.requireApart(output, file, false);
    if (!output.files.prj.empty()) inputs.requireApart(output, output.files.prj, false);
    claims.add(output);
  }
}

bool isMade(const std::string& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!exists(status)) return false;
  return !is_regular_file(status) || std::filesystem::file_size(path, error) > 0;
}

RunOutputs::~RunOutputs() {
  grids_.clear();
  files_.clear();
  for (const fs::path& folder : guarded_) interrupt_.release(folder);
}

void RunOutputs::guard(const StagedFiles& files) {
  guarded_.emplace_back(files.stagingFolder());
  interrupt_.guard(guarded_.back());
}

void RunOutputs::addGrids(const std::vector<std::string>& paths, const std::string& format) {
  if (!format.empty() && paths.size() > 1) {
    throw OptionError("--format goes with one output; choose the formats of several by their endings");
  }
  for (const std::string& path : paths) {
    const GridFormat& known = gridFormatFor(path, format);
    grids_.emplace_back(path, known, overwrite_);
    grids_.back().protect(inputs_);
    formats_.push_back(&known);
    if (known.says_depth) depth_paths_.push_back(path);
    if (known.needs_depths) full_depth_paths_.push_back(path);
    if (known.lengths_in_metres) metre_paths_.push_back(path);
    guard(grids_.back().files());
  }
}

StagedFiles& RunOutputs::addFile(const std::string& path) {
  files_.push_back(std::make_unique<StagedFiles>(path, overwrite_));
  guard(*files_.back());
  return *files_.back();
}

void RunOutputs::addReport(const std::string& path) {
  report_to_stdout_ = path == "-";
  if (path.empty() || report_to_stdout_) return;
  try {
    report_ = &addFile(path);
  } catch (const OutputError& error) {
    std::error_code ignored;
    const bool special =
        fs::exists(path, ignored) && !fs::is_regular_file(path, ignored) && !fs::is_directory(path, ignored);
    throw OutputError(std::string(error.what()) + (special ? "; '--report -' prints the report" : ""));
  }
}

void RunOutputs::writeGrids(const Grid& grid, const ItemLoop& loop) {
  for (StagedOutput& output : grids_) {
    interrupt_.check();
    output.write(grid, loop);
  }
}

void RunOutputs::writeReport(const std::string& text) {
  if (report_ != nullptr) report_->write(text);
  if (report_to_stdout_) report_text_ = text;
}

std::string RunOutputs::unknownDepthWarning(const DepthOptions& depth) const {
  if (depth.files.empty() || depth.fill != DepthFill::None || full_depth_paths_.empty()) return {};
  return "--depth-fill none: '" + full_depth_paths_.front() +
         "' cannot say that a node has no depth: nothing is written if there is one; choose another --depth-fill, or "
         "only formats that can, such as .nc and .gpkg";
}

std::vector<std::string> RunOutputs::numberWarnings(const Grid& grid) const {
  std::vector<std::string> warnings;
  if (!depth_paths_.empty()) warnings.push_back(depthWarning(grid, depth_paths_.front()));
  if (!metre_paths_.empty()) warnings.push_back(metreWarning(grid, metre_paths_.front()));
  std::erase(warnings, std::string());
  return warnings;
}

std::vector<std::string> RunOutputs::lossWarnings(const Grid& grid, LossesOf of) const {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const std::string losses = lossesIn(grid, *formats_[i], of);
    if (!losses.empty()) warnings.push_back("'" + grids_[i].path() + "' cannot hold " + losses);
  }
  return warnings;
}

std::string RunOutputs::openingsText(const Grid& grid) const {
  std::string text;
  for (std::size_t i = 0; i < grids_.size(); ++i) {
    const std::string openings = openingsIn(grid, grids_[i].path(), *formats_[i]);
    if (!openings.empty()) text += openings + "\n";
  }
  return text;
}

std::vector<StagedFiles*> RunOutputs::made() {
  std::vector<StagedFiles*> made;
  for (StagedOutput& grid : grids_)
    if (grid.files().made()) made.push_back(&grid.files());
  for (const auto& file : files_)
    if (file->made()) made.push_back(file.get());
  return made;
}

void RunOutputs::commit() {
  interrupt_.close();
  requireMemoryHeld();
  commitTogether(made());
  if (!guarded_.empty()) outputsAreInPlace();
  std::fputs(report_text_.c_str(), stdout);
}

void commitInTurn(std::span<const std::unique_ptr<RunOutputs>> parts, const ItemLoop& loop) {
  if (parts.empty()) return;
  std::vector<std::vector<StagedFiles*>> groups;
  std::vector<StagedFiles*> all;
  for (const auto& part : parts) {
    groups.push_back(part->made());
    all.insert(all.end(), groups.back().begin(), groups.back().end());
  }
  syncToDisk(all, loop);
  Interrupt& interrupt = parts.front()->interrupt_;
  interrupt.close();
  const std::shared_ptr<Interrupt> reopens(&interrupt, [](Interrupt* closed) { closed->reopen(); });
  requireMemoryHeld();
  moveInTurn(groups);
}

}  // namespace coastmesh
