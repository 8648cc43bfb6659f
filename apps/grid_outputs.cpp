#include "apps/grid_outputs.hpp"

#include <filesystem>
#include <set>

#include "apps/command_line.hpp"

namespace coastmesh {

namespace {

std::filesystem::path canonical(const std::string& path) {
  std::error_code error;
  const std::filesystem::path real = std::filesystem::weakly_canonical(path, error);
  return error ? std::filesystem::path(path) : real;
}

void requireApart(const std::vector<std::string>& paths, const std::vector<std::string>& inputs) {
  std::set<std::filesystem::path> sources;
  for (const std::string& input : inputs) sources.insert(canonical(input));
  std::set<std::filesystem::path> targets;
  for (const std::string& path : paths) {
    if (sources.contains(canonical(path))) throw UsageError("'" + path + "' is input and output at once");
    if (!targets.insert(canonical(path)).second) throw UsageError("'" + path + "' is given as an output twice");
  }
}

}  // namespace

GridOutputs::GridOutputs(const std::vector<std::string>& paths, const std::string& format, bool overwrite,
                         const std::vector<std::string>& inputs, Interrupt& interrupt) {
  if (!format.empty() && paths.size() > 1) {
    throw UsageError("--format goes with one output; choose the formats of several by their endings");
  }
  requireApart(paths, inputs);
  for (const std::string& path : paths) {
    paths_.push_back(path);
    formats_.push_back(&gridFormatFor(path, format));
    outputs_.emplace_back(path, *formats_.back(), overwrite);
    if (gridFormatFor(path, format).says_depth) depth_paths_.push_back(path);
    interrupt.guard(outputs_.back().stagingFolder());
  }
}

std::string GridOutputs::depthWarning(const Grid& grid) const {
  if (!grid.z.empty() || depth_paths_.empty()) return {};
  return "the mesh has no depths: '" + depth_paths_.front() + "' says 0 everywhere; give --bathymetry";
}

std::vector<std::string> GridOutputs::lossWarnings(const Grid& grid, LossesOf of) const {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const std::string losses = lossesIn(grid, *formats_[i], of);
    if (!losses.empty()) warnings.push_back("'" + paths_[i] + "' cannot hold " + losses);
  }
  return warnings;
}

void GridOutputs::write(std::size_t index, const Grid& grid) { outputs_[index].write(grid); }

void GridOutputs::commit() {
  for (StagedOutput& output : outputs_) output.commit();
}

}  // namespace coastmesh
