#include "apps/python/edit.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include "apps/python/background.hpp"
#include "apps/python/keywords.hpp"
#include "apps/python/wording.hpp"
#include "apps/usage/cut_usage.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/merge_usage.hpp"
#include "apps/usage/remesh_usage.hpp"
#include "apps/usage/rivers_usage.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

// A mesh that a function was given: one at hand, or a file. The caller keeps what is at hand.
class GivenMesh {
 public:
  GivenMesh(const py::object& given, const std::string& name) {
    if (py::isinstance<MeshResult>(given)) {
      at_hand_ = given.cast<const MeshResult*>();
      name_ = name;
    } else {
      name_ = given.cast<std::string>();
    }
  }

  const std::string& name() const { return name_; }  // in messages

  // A copy of its own for the caller.
  Grid read(const std::string& crs, const Warn& warn) const {
    if (at_hand_ == nullptr) return readMeshFile({name_, crs}, warn);
    Grid grid = at_hand_->grid;
    assumeCrs(grid, {name_, crs}, warn);
    return grid;
  }

 private:
  const MeshResult* at_hand_ = nullptr;
  std::string name_;
};

std::int64_t indexOf(std::uint32_t number) { return number == kNone ? -1 : std::int64_t{number}; }

std::vector<std::int64_t> indices(const std::vector<std::uint32_t>& numbers) {
  std::vector<std::int64_t> all(numbers.size());
  std::ranges::transform(numbers, all.begin(), indexOf);
  return all;
}

void setMerged(const std::vector<MergeSource>& sources, std::vector<std::int64_t>& mesh,
               std::vector<std::int64_t>& source) {
  mesh.resize(sources.size());
  source.resize(sources.size());
  std::ranges::transform(sources, mesh.begin(), [](const MergeSource& one) { return indexOf(one.mesh); });
  std::ranges::transform(sources, source.begin(), [](const MergeSource& one) { return indexOf(one.number); });
}

void setSources(MeshResult& result, const EditSources& sources) {
  if (sources.merged_nodes.empty()) {
    result.node_source = indices(sources.nodes);
    result.triangle_source = indices(sources.triangles);
  } else {
    setMerged(sources.merged_nodes, result.node_mesh, result.node_source);
    setMerged(sources.merged_triangles, result.triangle_mesh, result.triangle_source);
  }
}

using Settle = std::function<std::vector<std::string>()>;  // returns warnings
using Edit =
    std::function<EditedMesh(Grid& grid, const std::string& name, const Warn& warn, const JobControl& control)>;

// `crs`: an option that is set once `settle` is called.
MeshResult runEdit(OptionTable& options, const EditArguments& given, const std::string& crs, const Settle& settle,
                   const Edit& edit) {
  MeshResult result;
  std::vector<std::string>& warnings = result.warnings;
  setFromKeywords(options, given.keywords, warnings);
  std::ranges::move(options.withoutEffect(), std::back_inserter(warnings));

  const Wording inWords(options, given.texts);
  const GivenMesh mesh(given.mesh, "mesh");
  const Warn warn = [&warnings](const std::string& text) { warnings.push_back(text); };
  EditedMesh edited;
  inWords.around([&] {
    std::ranges::move(settle(), std::back_inserter(warnings));
    const auto work = [&](const JobControl& control) {
      control.progress("read", 0.0);
      result.grid = mesh.read(crs, warn);
      control.progress("read", 1.0);
      edited = edit(result.grid, mesh.name(), warn, control);
    };
    runInBackground(work, given.progress);
  });
  std::ranges::move(edited.warnings, std::back_inserter(warnings));
  inWords.apply(warnings);
  for (GridFeature& feature : result.grid.features) feature.source = given.texts.named(feature.source);
  result.summary = inWords(edited.summary);
  result.report = editReport(edited, warnings);
  result.complete = edited.complete();
  if (!edited.finish.mended) setSources(result, edited.sources);
  return result;
}

// The usage of a function whose options `declare` declares.
template <typename Usage>
std::string usageOf(const std::string& name, void (*declare)(OptionTable&, Usage&)) {
  Usage usage;
  OptionTable options(name, "");
  declare(options, usage);
  return options.jsonUsage();
}

}  // namespace

MeshResult cutFromPython(const EditArguments& given) {
  CutUsage usage;
  OptionTable options("cut", "");
  declareCutOptions(options, usage);
  const auto settled = [&] {
    settle(usage);
    return std::vector<std::string>();
  };
  return runEdit(options, given, usage.mesh.crs, settled,
                 [&](Grid& grid, const std::string& name, const Warn&, const JobControl& control) {
                   return runCutJob(grid, name, usage.job, control);
                 });
}

MeshResult remeshFromPython(const EditArguments& given) {
  RemeshUsage usage;
  OptionTable options("remesh", "");
  declareRemeshOptions(options, usage);
  return runEdit(
      options, given, usage.mesh.crs, [&] { return settle(usage); },
      [&](Grid& grid, const std::string& name, const Warn&, const JobControl& control) {
        return runRemeshJob(grid, name, usage.job, control);
      });
}

MeshResult mergeFromPython(const EditArguments& given, const py::list& inserted) {
  MergeUsage usage;
  OptionTable options("merge", "");
  declareMergeOptions(options, usage);
  std::vector<GivenMesh> meshes;
  for (const py::handle one : inserted) {
    const auto [mesh, name] = one.cast<std::pair<py::object, std::string>>();
    meshes.emplace_back(mesh, name);
  }
  const auto merge = [&](Grid& grid, const std::string& name, const Warn& warn, const JobControl& control) {
    std::vector<MeshToInsert> to_insert;
    for (const GivenMesh& mesh : meshes)
      to_insert.push_back({mesh.name(), [&] { return mesh.read(usage.mesh.crs, warn); }});
    return runMergeJob(grid, name, to_insert, usage.job, warn, control);
  };
  return runEdit(
      options, given, usage.mesh.crs, [] { return std::vector<std::string>(); }, merge);
}

MeshResult riversFromPython(const EditArguments& given, const std::vector<std::string>& lines) {
  RiversUsage usage;
  OptionTable options("rivers", "");
  declareRiversOptions(options, usage);
  const auto settled = [&] {
    settle(usage);
    return std::vector<std::string>();
  };
  const auto add = [&](Grid& grid, const std::string& name, const Warn& warn, const JobControl& control) {
    return runRiversJob(grid, name, lines, usage.job, warn, control);
  };
  return runEdit(options, given, usage.mesh.crs, settled, add);
}

MeshResult readFromPython(const std::string& path, const py::object& crs) {
  MeshFile file{path, {}};
  OptionTable options("read", "");
  declareAssumedCrs(options, file.crs);
  MeshResult result;
  py::dict keywords;
  keywords["assume_crs"] = crs;
  setFromKeywords(options, keywords, result.warnings);
  const MemoryFiles none;
  const Wording inWords(options, none);
  const Warn warn = [&result](const std::string& text) { result.warnings.push_back(text); };
  const py::gil_scoped_release release;
  inWords.around([&] { result.grid = readMeshFile(file, warn); });
  inWords.apply(result.warnings);
  return result;
}

std::string usageOfCut() { return usageOf("cut", declareCutOptions); }
std::string usageOfRemesh() { return usageOf("remesh", declareRemeshOptions); }
std::string usageOfMerge() { return usageOf("merge", declareMergeOptions); }
std::string usageOfRivers() { return usageOf("rivers", declareRiversOptions); }

}  // namespace coastmesh
