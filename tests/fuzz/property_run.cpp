// Runs random inputs through the core and its checker, up to a number of runs or seconds. Writes each failure in the
// corpus format, as found and reduced. Exit code 1 if anything failed.
#include <sys/wait.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "tests/fuzz/case_file.hpp"
#include "tests/fuzz/isolated.hpp"
#include "tests/fuzz/random_case.hpp"
#include "tests/fuzz/reduce_case.hpp"
#include "tests/fuzz/shared_block.hpp"

namespace {

using namespace coastmesh;

struct Settings {
  std::uint64_t runs = 10000;
  std::uint64_t first = 0;  // number of the first run
  std::uint64_t seed = 1;
  double seconds = 1e9;  // wall clock
  std::uint64_t most_vertices = 60000;
  std::uint64_t usual_vertices = 100;
  unsigned cpu_seconds = 60;  // for one run
  int reduce_trials = 2000;
  unsigned reduce_each = 3;  // failures of one kind that are reduced; the rest are counted
  std::string out = "failures";
  std::vector<std::string> files;
  std::vector<std::string> bytes;
};

// Shared by the worker with its parent.
struct Progress {
  std::uint64_t current;  // the run in progress
  std::array<std::uint64_t, 4> by_verdict;
  std::uint64_t vertices;
  bool failed;  // the worker ended because the current run failed
};

CaseLimits limitsOf(std::uint64_t run, const Settings& settings) {
  // Large meshes and repetitions are expensive, so only some runs have them.
  const bool large = run % 64 == 5;
  return {.most_vertices = large ? settings.most_vertices : std::min(settings.usual_vertices, settings.most_vertices),
          .repeat = run % 16 == 0};
}

RefineCase caseOf(std::uint64_t run, const Settings& settings) {
  Choices choices(settings.seed * 0x9E3779B97F4A7C15ull + run);
  return randomCase(choices);
}

std::string fileName(const std::string& failure, const std::string& name) {
  std::string slug = failure;
  for (char& c : slug)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '-';
  return slug.substr(0, 60) + "_" + name;
}

class Failures {
 public:
  explicit Failures(const Settings& settings) : settings_(settings) {}

  std::size_t count() const { return count_; }
  const std::map<std::string, unsigned>& byKind() const { return by_kind_; }

  // Runs a failed case once more, on its own, and writes it to a file.
  void add(const RefineCase& c, const CaseLimits& limits, const std::string& name) {
    const CaseResult result = runIsolated(c, limits, settings_.cpu_seconds);
    if (result.verdict != Verdict::Failed) {
      std::printf("%s failed, but not when run again\n", name.c_str());
      write(c, "failed once only", fileName("once", name));
      ++count_;
      return;
    }
    ++count_;
    std::printf("%s failed: %s\n  %s\n", name.c_str(), result.failure.c_str(), result.detail.c_str());
    if (++by_kind_[result.failure] > settings_.reduce_each) return;
    write(c, result.failure + "\n" + result.detail, fileName(result.failure, name));
    if (settings_.reduce_trials == 0) return;
    const auto still_fails = [&](const RefineCase& smaller) {
      return runIsolated(smaller, limits, settings_.cpu_seconds).failure == result.failure;
    };
    // A run that does not end takes the full time limit in every trial.
    const int trials = result.failure == "does not end" ? settings_.reduce_trials / 10 : settings_.reduce_trials;
    const RefineCase small = reduceCase(c, still_fails, trials);
    const CaseResult last = runIsolated(small, limits, settings_.cpu_seconds);
    write(small, last.failure + "\n" + last.detail, fileName(result.failure, name + "-small"));
    std::printf("  smaller: %zu points, %zu segments\n", small.pslg.points.size(), small.pslg.segments.size());
    std::fflush(stdout);
  }

 private:
  void write(const RefineCase& c, const std::string& note, const std::string& name) {
    std::filesystem::create_directories(settings_.out);
    writeCase(c, note, settings_.out + "/" + name + ".poly");
  }

  const Settings& settings_;
  std::size_t count_ = 0;
  std::map<std::string, unsigned> by_kind_;
};

constexpr std::uint64_t kReportEach = 10000;

[[noreturn]] void work(std::uint64_t from, const Settings& settings, Progress& progress,
                       std::chrono::steady_clock::time_point end) {
  for (std::uint64_t run = from; run < settings.first + settings.runs; ++run) {
    if (std::chrono::steady_clock::now() > end) break;
    progress.current = run;
    limitCpuTime(settings.cpu_seconds);
    const CaseResult result = runCase(caseOf(run, settings), limitsOf(run, settings));
    ++progress.by_verdict[static_cast<std::size_t>(result.verdict)];
    progress.vertices += result.vertices;
    if ((run + 1 - settings.first) % kReportEach == 0) {
      std::printf("up to run %llu\n", static_cast<unsigned long long>(run + 1));
      std::fflush(stdout);
    }
    if (result.verdict != Verdict::Failed) continue;
    progress.failed = true;
    _exit(0);
  }
  _exit(0);
}

void runRandom(const Settings& settings, Failures& failures) {
  const auto begin = std::chrono::steady_clock::now();
  const auto end = begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                               std::chrono::duration<double>(settings.seconds));
  SharedBlock<Progress> progress;
  std::uint64_t crashes = 0;
  for (std::uint64_t from = settings.first; from < settings.first + settings.runs;) {
    progress->failed = false;
    std::fflush(nullptr);
    const pid_t worker = fork();
    if (worker < 0) throw std::runtime_error("cannot start a child process");
    if (worker == 0) work(from, settings, *progress, end);
    int status = 0;
    if (waitpid(worker, &status, 0) != worker) throw std::runtime_error("cannot wait for a child process");
    const bool died = !howItDied(status).empty();
    if (!died && !progress->failed) break;
    crashes += died;
    const std::uint64_t run = progress->current;
    failures.add(caseOf(run, settings), limitsOf(run, settings),
                 std::to_string(settings.seed) + "-" + std::to_string(run));
    from = run + 1;
  }
  const auto& by = progress->by_verdict;
  const std::uint64_t all = by[0] + by[1] + by[2] + by[3] + crashes;
  const double accepted = all == 0 ? 0.0 : 100.0 * static_cast<double>(all - by[0]) / static_cast<double>(all);
  std::printf(
      "%llu runs in %.0f s: %llu held, %llu refused, %llu too large, %llu failed, %llu crashed or did not end; "
      "%.1f %% accepted, %llu vertices in all\n",
      static_cast<unsigned long long>(all),
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
      static_cast<unsigned long long>(by[1]), static_cast<unsigned long long>(by[0]),
      static_cast<unsigned long long>(by[2]), static_cast<unsigned long long>(by[3]),
      static_cast<unsigned long long>(crashes), accepted, static_cast<unsigned long long>(progress->vertices));
  for (const auto& [kind, count] : failures.byKind()) std::printf("%6u  %s\n", count, kind.c_str());
}

void runGiven(const RefineCase& c, const std::string& path, const Settings& settings, Failures& failures) {
  const CaseLimits limits{.most_vertices = settings.most_vertices, .repeat = true};
  const CaseResult result = runIsolated(c, limits, settings.cpu_seconds);
  if (result.verdict == Verdict::Failed) {
    failures.add(c, limits, std::filesystem::path(path).stem().string());
    return;
  }
  const char* verdicts[] = {"refused: ", "held", "too large", "failed"};
  std::printf("%s: %s%s, %llu vertices\n", path.c_str(), verdicts[static_cast<unsigned>(result.verdict)],
              result.failure.c_str(), static_cast<unsigned long long>(result.vertices));
}

std::vector<std::uint8_t> readBytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("cannot read '" + path + "'");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Runs random inputs through the core and its checker.");
  app.add_option("--runs", settings.runs, "random runs")->capture_default_str();
  app.add_option("--first", settings.first, "number of the first run")->capture_default_str();
  app.add_option("--seed", settings.seed, "seed of all runs")->capture_default_str();
  app.add_option("--seconds", settings.seconds, "stop after this time")->capture_default_str();
  app.add_option("--most-vertices", settings.most_vertices, "cut one run in 64 off here")->capture_default_str();
  app.add_option("--usual-vertices", settings.usual_vertices, "and the others here")->capture_default_str();
  app.add_option("--cpu-seconds", settings.cpu_seconds, "for one run")->capture_default_str();
  app.add_option("--reduce-trials", settings.reduce_trials, "for one failure; 0: keep it as it is")
      ->capture_default_str();
  app.add_option("--reduce-each", settings.reduce_each, "failures of a kind to write")->capture_default_str();
  app.add_option("--out", settings.out, "folder for failures")->capture_default_str();
  app.add_option("--case", settings.files, "run these files of the corpus instead");
  app.add_option("--bytes", settings.bytes, "run these inputs of the fuzzer instead");
  CLI11_PARSE(app, argc, argv);
  try {
    Failures failures(settings);
    for (const std::string& path : settings.files) runGiven(readCase(path), path, settings, failures);
    for (const std::string& path : settings.bytes) {
      const std::vector<std::uint8_t> bytes = readBytes(path);
      Choices choices{std::span<const std::uint8_t>(bytes)};
      runGiven(randomCase(choices), path, settings, failures);
    }
    if (settings.files.empty() && settings.bytes.empty()) runRandom(settings, failures);
    return failures.count() == 0 ? 0 : 1;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  }
}
