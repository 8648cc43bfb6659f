// libFuzzer target: bytes become a small input of the core with options; see random_case.hpp. Prints a failure in the
// corpus format and aborts.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

#include "tests/fuzz/case_text.hpp"
#include "tests/fuzz/random_case.hpp"
#include "tests/fuzz/refine_case.hpp"

namespace {

// Prints at the end how many inputs were accepted.
class Tally {
 public:
  ~Tally() {
    std::fprintf(stderr, "%llu inputs, %llu accepted\n", static_cast<unsigned long long>(all_),
                 static_cast<unsigned long long>(accepted_));
  }
  void add(bool accepted) {
    ++all_;
    accepted_ += accepted;
  }

 private:
  unsigned long long all_ = 0, accepted_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coastmesh;
  static Tally tally;
  Choices choices(std::span<const std::uint8_t>(data, size));
  const RefineCase c = randomCase(choices);
  const CaseResult result = runCase(c, {.most_vertices = 200});
  tally.add(result.verdict != Verdict::Refused);
  if (result.verdict != Verdict::Failed) return 0;
  std::fprintf(stderr, "%s", caseText(c, result.failure + "\n" + result.detail).c_str());
  std::abort();
}
