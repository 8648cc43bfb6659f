#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// Which options on sizes were given, if their values do not show it.
struct SizingUsage {
  bool filter_given = false;
  bool coast_given = false;
  bool grade_given = false;
  bool shore_rate_given = false;
  bool time_step_given = false;
};

// Whether sizes are to be chosen for a sea model, and from what.
enum class SizeChoice { None, FromExtent, FromExtentAndDepths };

// What some of the options on sizes do, which differs between commands.
struct SizeHelp {
  std::string least, most, time_step;
};

// Declares the options that request sizes, without those on coasts; otherwise as below.
void declareSizes(OptionTable& table, SizeOptions& sizes, SizingUsage& usage, const SizeHelp& help,
                  const std::function<SizeChoice()>& choice);

// Declares the options on the size of elements; `sizes` and `usage` must outlive the parsing. `choice` is called once
// parsed: options that need sizes have an effect if they are chosen.
void declareSizing(OptionTable& table, SizeOptions& sizes, SizingUsage& usage,
                   const std::function<SizeChoice()>& choice);

// To be called once parsed. `depths`: where sizes find depths. Throws OptionError for options that cannot be combined.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, SizeChoice choice, SizeOptions& sizes);

// A note for each requested size, or growth of sizes, that a bound on all sizes overrides.
std::vector<std::string> notesOnOverriddenSizes(const SizingUsage& usage, const SizeOptions& sizes);

}  // namespace coastmesh
