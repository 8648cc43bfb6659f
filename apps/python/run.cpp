#include "apps/python/run.hpp"

#include <cpl_vsi.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>

#include "apps/python/arrays.hpp"
#include "apps/python/keywords.hpp"
#include "apps/report/mesh_report.hpp"
#include "apps/report/mesh_warnings.hpp"
#include "apps/usage/mesh_usage.hpp"
#include "apps/usage/option_keywords.hpp"
#include "core/run_control.hpp"
#include "gis/error.hpp"

namespace py = pybind11;

namespace coastmesh {

namespace {

constexpr auto kPollEvery = std::chrono::milliseconds(50);  // maximum delay of Ctrl-C and of progress calls

// The job on a thread of its own, and what it reports.
class Background {
 public:
  explicit Background(const MeshJob& job) : thread_([this, &job] { work(job); }) {}
  ~Background() {
    cancelled_ = true;
    thread_.join();
  }
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;

  // True once the job has ended; false after kPollEvery.
  bool wait() {
    std::unique_lock lock(mutex_);
    return ended_changed_.wait_for(lock, kPollEvery, [this] { return ended_; });
  }

  // Gets the last phase and share reported; false if nothing is new.
  bool takeProgress(std::string& phase, double& share) {
    const std::lock_guard lock(mutex_);
    phase = phase_;
    share = share_;
    return std::exchange(news_, false);
  }

  // To be called once it has ended. Throws what the job threw.
  MeshJobResult take() {
    if (error_) std::rethrow_exception(error_);
    return std::move(result_);
  }

 private:
  void work(const MeshJob& job) {
    const JobControl control{[this] { return cancelled_.load(std::memory_order_relaxed); },
                             [this](std::string_view phase, double share) {
                               const std::lock_guard lock(mutex_);
                               phase_ = phase;
                               share_ = share;
                               news_ = true;
                             }};
    try {
      result_ = runMeshJob(job, control);
    } catch (...) {
      error_ = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      ended_ = true;
    }
    ended_changed_.notify_all();
  }

  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable ended_changed_;
  bool ended_ = false;
  std::string phase_;
  double share_ = 0.0;
  bool news_ = false;
  MeshJobResult result_;
  std::exception_ptr error_;
  std::thread thread_;  // last: it uses all of the above
};

// GeoJSON text as a file in memory, for GDAL.
class MemoryFile {
 public:
  static constexpr const char* kName = "GeoJSON";

  explicit MemoryFile(std::string text) : text_(std::move(text)) {
    static std::atomic<unsigned> number{0};
    path_ = "/vsimem/coastmesh-" + std::to_string(number++) + "/input.geojson";
    VSILFILE* file = VSIFileFromMemBuffer(path_.c_str(), reinterpret_cast<GByte*>(text_.data()), text_.size(), FALSE);
    if (file == nullptr) throw std::bad_alloc();
    VSIFCloseL(file);
  }
  ~MemoryFile() { VSIUnlink(path_.c_str()); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }
  // `text` with the file's path replaced by kName.
  std::string named(std::string text) const {
    for (std::size_t at = text.find(path_); at != std::string::npos; at = text.find(path_, at)) {
      text.replace(at, path_.size(), kName);
    }
    return text;
  }

 private:
  std::string text_;
  std::string path_;
};

// Rewords messages of the library for Python: options as keywords, the file in memory by its name.
class Wording {
 public:
  Wording(const OptionTable& options, const std::optional<MemoryFile>& geojson)
      : options_(options), geojson_(geojson) {}

  std::string operator()(const std::string& message) const {
    return inKeywords(geojson_ ? geojson_->named(message) : message, options_);
  }
  void apply(std::vector<std::string>& messages) const {
    for (std::string& message : messages) message = (*this)(message);
  }
  void apply(MeshJobResult& result) const {
    apply(result.read.warnings);
    apply(result.read.notes);
    for (Refusal& refusal : result.refusals) refusal.reason = (*this)(refusal.reason);
    if (!geojson_) return;
    for (Refusal& refusal : result.refusals) refusal.source = geojson_->named(refusal.source);
    for (GridFeature& feature : result.grid.features) feature.source = geojson_->named(feature.source);
  }

 private:
  const OptionTable& options_;
  const std::optional<MemoryFile>& geojson_;
};

MeshJobResult runInBackground(const MeshJob& job, const py::object& progress) {
  Background background(job);
  const auto reportProgress = [&] {
    std::string phase;
    double share = 0.0;
    if (!progress.is_none() && background.takeProgress(phase, share)) progress(phase, share);
  };
  // If a signal or `progress` raises, the destructor stops the job. It waits with the GIL held, which is safe: the
  // job's threads never take it.
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release release;
      ended = background.wait();
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    reportProgress();
  }
  return background.take();
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

MeshResult runFromPython(const py::dict& keywords, std::vector<std::string> files, std::optional<std::string> text,
                         const py::object& graph, const py::object& progress) {
  MeshUsage usage;
  OptionTable options("mesh", "");
  declareMeshOptions(options, usage);
  std::vector<std::string> warnings;
  setFromKeywords(options, keywords, warnings);
  std::optional<MemoryFile> geojson;
  if (text) {
    geojson.emplace(std::move(*text));
    files = {geojson->path()};
  }
  usage.job.input.files = std::move(files);
  if (!graph.is_none()) {
    const auto parts = graph.cast<std::tuple<py::object, py::object, py::object>>();
    usage.job.input.pslg = pslgOf(std::get<0>(parts), std::get<1>(parts), std::get<2>(parts));
  }
  std::ranges::move(options.withoutEffect(), std::back_inserter(warnings));

  const Wording inWords(options, geojson);
  MeshJobResult done = [&] {
    try {
      settle(usage);
      return runInBackground(usage.job, progress);
    } catch (const OptionError& error) {
      throw OptionError(inWords(error.what()));
    } catch (const InputError& error) {
      throw InputError(inWords(error.what()));
    }
  }();
  inWords.apply(done);
  if (done.regions == 0 && done.refusals.empty()) throw InputError(inWords(done.last_unwanted));
  if (geojson) usage.job.input.files = {MemoryFile::kName};
  std::ranges::move(warningsOf(done), std::back_inserter(warnings));
  inWords.apply(warnings);
  MeshResult result;
  const int threads = usage.job.parallel.threads;
  const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
  result.report = meshReport(usage.job, done, threads > 0 ? threads : static_cast<int>(cores), warnings);
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

std::string usageOfOptions() {
  MeshUsage usage;
  OptionTable options("mesh", "");
  declareMeshOptions(options, usage);
  return options.jsonUsage();
}

}  // namespace coastmesh
