#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/job/mesh_job_result.hpp"

namespace coastmesh {

enum class FeatureState {
  Made,
  Short,    // made, but misses a requirement
  Skipped,  // its outputs existed already
  Refused,  // cannot be meshed
};
std::string_view toString(FeatureState state);

// The result for one of many features that are meshed separately.
struct FeatureOutcome {
  std::string name, source;
  std::int64_t fid = 0;
  std::vector<std::string> outputs;
  FeatureState state = FeatureState::Made;
  std::string reason;        // of a refusal
  bool over_budget = false;  // refused because its sizes require many more vertices than `--max-vertices`
  MeshQuality quality;
  std::uint64_t digest = 0;
  std::vector<std::string> warnings, notes;
};
// True if it was meshed in this run.
bool isMeshed(const FeatureOutcome& feature);

struct FeatureSums {
  std::uint64_t made = 0, short_of = 0, skipped = 0, refused = 0;  // `made` without those that are short
  std::uint64_t over_budget = 0;                                   // of those refused
  MeshQuality quality;                                             // of what was meshed

  std::uint64_t meshed() const { return made + short_of; }
};
FeatureSums sumsOf(const std::vector<FeatureOutcome>& features);

// The report as JSON text, its keys as documented in apps/README.md. `seconds`: wall-clock.
struct PerFeatureTimes {
  double read = 0.0, total = 0.0;
};
std::string perFeatureReport(const std::vector<std::string>& files, const ReadReport& read, const Crs& crs,
                             const std::vector<FeatureOutcome>& features, const std::vector<std::string>& warnings,
                             const PerFeatureTimes& seconds, int threads);

// A few lines for people.
std::string perFeatureSummary(const std::vector<FeatureOutcome>& features, double seconds);

}  // namespace coastmesh
