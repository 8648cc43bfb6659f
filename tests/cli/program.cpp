#include "tests/cli/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace coastmesh::test {

namespace fs = std::filesystem;

namespace {

// A child process whose output goes to files.
class Child {
 public:
  explicit Child(std::vector<std::string> words) {
    std::string name = (fs::temp_directory_path() / "coastmesh-run-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a run");
    folder_ = name;
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const int flags = O_WRONLY | O_CREAT | O_TRUNC;
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, out().c_str(), flags, 0600);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, err().c_str(), flags, 0600);
    // Shells start background jobs with SIGINT ignored, and the tests may be such a job.
    sigset_t stopping;
    sigemptyset(&stopping);
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&stopping, number);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setsigdefault(&attributes, &stopping);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
    const int failed = posix_spawn(&pid_, words.front().c_str(), &actions, &attributes, pointers.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (failed != 0) throw std::runtime_error("cannot start " + words.front());
  }
  ~Child() { fs::remove_all(folder_); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string output() const { return readText(out()); }
  bool ended() const {
    siginfo_t info{};
    return waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_;
  }
  void signal(int number) const { kill(pid_, number); }

  ProgramRun wait() {
    int status = 0;
    waitpid(pid_, &status, 0);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, output(), readText(err())};
  }

 private:
  std::string out() const { return (folder_ / "out").string(); }
  std::string err() const { return (folder_ / "err").string(); }

  fs::path folder_;
  pid_t pid_ = -1;
};

std::vector<std::string> withProgram(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{COASTMESH_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

}  // namespace

ProgramRun runProgram(const std::vector<std::string>& arguments) { return Child(withProgram(arguments)).wait(); }

ProgramRun runShell(const std::string& script) { return Child({"/bin/sh", "-c", script, COASTMESH_PROGRAM}).wait(); }

ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::string& awaited, int signal_number) {
  Child child(withProgram(arguments));
  while (!child.ended() && child.output().find(awaited) == std::string::npos) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  child.signal(signal_number);
  return child.wait();
}

ProgramRun runAndSignal(const std::vector<std::string>& arguments, const std::function<bool()>& due,
                        int signal_number) {
  Child child(withProgram(arguments));
  while (!child.ended() && !due()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  child.signal(signal_number);
  return child.wait();
}

std::string programVersion() {
  const std::string text = runProgram({"--version"}).output;  // "coastmesh 1.2.3"
  const std::size_t from = text.rfind(' ') + 1;
  return text.substr(from, text.find_last_not_of('\n') + 1 - from);
}

std::string withVersion(std::string bytes, const std::string& version) {
  const std::size_t at = bytes.find(programVersion());
  const std::uint64_t size = version.size();
  if (at == bytes.npos || at < sizeof size) throw std::runtime_error("no version in the file");
  bytes.replace(at, programVersion().size(), version);
  return bytes.replace(at - sizeof size, sizeof size, reinterpret_cast<const char*>(&size), sizeof size);
}

std::string inputFile(const std::string& name) {
  const fs::path path = fs::path(COASTMESH_CLI_INPUTS) / name;
  if (!fs::exists(path)) throw std::runtime_error("no input " + path.string());
  return path.string();
}

std::string readText(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void writeText(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

std::string geoJsonPolygons(const std::vector<std::vector<LonLatRing>>& polygons) {
  using Json = nlohmann::json;
  Json features = Json::array();
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    Json rings = Json::array();
    for (LonLatRing ring : polygons[i]) {
      ring.push_back(ring.front());
      rings.push_back(ring);
    }
    features.push_back({{"type", "Feature"},
                        {"id", i},
                        {"properties", {{"name", "part " + std::to_string(i)}}},
                        {"geometry", {{"type", "Polygon"}, {"coordinates", rings}}}});
  }
  return Json{{"type", "FeatureCollection"}, {"features", features}}.dump();
}

ProgramTest::ProgramTest() {
  std::string name = (fs::temp_directory_path() / "coastmesh-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a test");
  folder_ = name;
}

ProgramTest::~ProgramTest() { fs::remove_all(folder_); }

std::string ProgramTest::write(const std::string& name, const std::string& text) const {
  writeText(folder_ / name, text);
  return file(name);
}

std::set<std::string> ProgramTest::names() const {
  std::set<std::string> found;
  for (const auto& entry : fs::directory_iterator(folder_)) found.insert(entry.path().filename().string());
  return found;
}

std::string ProgramTest::lake() const {
  const LonLatRing shore{{-87.50, 41.600}, {-87.49, 41.598}, {-87.478, 41.601}, {-87.475, 41.61},
                         {-87.48, 41.617}, {-87.49, 41.619}, {-87.501, 41.614}};
  const LonLatRing island{{-87.49, 41.605}, {-87.487, 41.609}, {-87.484, 41.606}};
  return write("lake.geojson", geoJsonPolygons({{shore, island}}));
}

testing::AssertionResult isOneErrorLine(const std::string& errors) {
  const bool one = errors.starts_with("coastmesh: error: ") && errors.ends_with('\n') &&
                   errors.find('\n') == errors.size() - 1 && errors.size() > 25;
  if (one) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "not one error line: " << errors;
}

}  // namespace coastmesh::test
