#include "apps/python/run.hpp"

#include <pybind11/stl.h>

#include <algorithm>
#include <iterator>
#include <thread>

#include "apps/job/mesh_job.hpp"
#include "apps/python/arrays.hpp"
#include "apps/python/background.hpp"
#include "apps/python/keywords.hpp"
#include "apps/python/wording.hpp"
#include "apps/report/mesh_report.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "apps/usage/option_keywords.hpp"
#include "gis/error.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

void reword(MeshJobResult& result, const Wording& inWords, const MemoryFiles& texts) {
  inWords.apply(result.read.warnings);
  inWords.apply(result.read.notes);
  for (Refusal& refusal : result.refusals) {
    refusal.reason = inWords(refusal.reason);
    refusal.source = texts.named(refusal.source);
  }
  for (GridFeature& feature : result.grid.features) feature.source = texts.named(feature.source);
}

}  // namespace

py::list refusalsOf(const MeshResult& result) {
  py::list list;
  for (const Refusal& refusal : result.refusals) {
    py::dict entry;
    entry["source"] = textOf(refusal.source);
    entry["fids"] = refusal.fids;
    entry["reason"] = textOf(refusal.reason);
    entry["place"] = refusal.place ? py::object(py::make_tuple(refusal.place->x, refusal.place->y)) : py::none();
    list.append(entry);
  }
  return list;
}

MeshResult runFromPython(const py::dict& keywords, const MemoryFiles& texts, std::vector<std::string> files,
                         const py::object& graph, const py::object& progress) {
  MeshUsage usage;
  OptionTable options("mesh", "");
  declareMeshOptions(options, usage);
  std::vector<std::string> warnings;
  setFromKeywords(options, keywords, warnings);
  usage.job.input.files = std::move(files);
  if (!graph.is_none()) {
    const auto parts = graph.cast<std::tuple<py::object, py::object, py::object>>();
    usage.job.input.pslg = pslgOf(std::get<0>(parts), std::get<1>(parts), std::get<2>(parts));
  }
  std::ranges::move(options.withoutEffect(), std::back_inserter(warnings));

  const Wording inWords(options, texts);
  MeshJobResult done;
  inWords.around([&] {
    settle(usage);
    runInBackground([&](const JobControl& control) { done = runMeshJob(usage.job, control); }, progress);
  });
  reword(done, inWords, texts);
  if (done.regions == 0 && done.refusals.empty()) throw InputError(inWords(done.last_unwanted));
  std::ranges::move(warningsOf(done), std::back_inserter(warnings));
  inWords.apply(warnings);
  MeshResult result;
  const int threads = usage.job.parallel.threads;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  result.report = texts.named(meshReport(usage.job, done, threads > 0 ? threads : static_cast<int>(cores), warnings));
  result.warnings = std::move(warnings);
  result.complete = done.complete();
  result.refusals = std::move(done.refusals);
  result.grid = std::move(done.grid);
  return result;
}

std::string inKeywordsOfMesh(const std::string& message) {
  MeshUsage usage;
  OptionTable options("mesh", "");
  declareMeshOptions(options, usage);
  return inKeywords(message, options);
}

std::string usageOfMesh() {
  MeshUsage usage;
  OptionTable options("mesh", "");
  declareMeshOptions(options, usage);
  return options.jsonUsage();
}

}  // namespace coastmesh
