#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/fuzz/case_file.hpp"
#include "tests/fuzz/case_text.hpp"
#include "tests/fuzz/isolated.hpp"
#include "tests/fuzz/random_case.hpp"

namespace coastmesh {
namespace {

std::vector<std::string> corpusFiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(COASTMESH_CORPUS_DIR))
    if (entry.path().extension() == ".poly") files.push_back(entry.path().filename().string());
  std::ranges::sort(files);
  return files;
}

constexpr unsigned kCpuSeconds = 60;

class Corpus : public ::testing::TestWithParam<std::string> {};

TEST_P(Corpus, Holds) {
  const RefineCase c = readCase(std::string(COASTMESH_CORPUS_DIR) + "/" + GetParam());
  const CaseResult result = runIsolated(c, {.repeat = true}, kCpuSeconds);
  EXPECT_EQ(result.verdict, Verdict::Held) << result.failure << '\n' << result.detail;
}

INSTANTIATE_TEST_SUITE_P(All, Corpus, ::testing::ValuesIn(corpusFiles()), [](const auto& param_info) {
  std::string name = std::filesystem::path(param_info.param).stem().string();
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(Property, RandomInputsHold) {
  constexpr std::uint64_t kRuns = 120;
  std::uint64_t held = 0;
  for (std::uint64_t seed = 0; seed < kRuns; ++seed) {
    Choices choices(seed);
    const RefineCase c = randomCase(choices);
    const CaseResult result = runIsolated(c, {.most_vertices = 2000, .repeat = seed % 16 == 0}, kCpuSeconds);
    held += result.verdict == Verdict::Held;
    EXPECT_NE(result.verdict, Verdict::Failed)
        << "seed " << seed << ": " << caseText(c, result.failure + "\n" + result.detail);
  }
  EXPECT_GT(held, kRuns / 2) << "inputs that are refused test nothing";
}

TEST(Property, ACaseComesBackFromItsFile) {
  const std::string path = ::testing::TempDir() + "/case_" + std::to_string(::getpid()) + ".poly";
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    Choices choices(seed);
    const RefineCase c = randomCase(choices);
    writeCase(c, "a note\nof two lines", path);
    if (c.pslg.points.empty()) continue;
    const RefineCase back = readCase(path);
    EXPECT_EQ(caseText(back, ""), caseText(c, ""));
    EXPECT_EQ(back.pslg.points, c.pslg.points);
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace coastmesh
