#include "apps/usage/sizing_usage.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Stores FROM, TO and SIZE; returns what is wrong with them, empty if nothing.
std::string storeBand(const std::vector<double>& numbers, std::vector<DepthBand>& bands) {
  if (numbers.empty()) return "is not FROM,TO,SIZE";
  const DepthBand band{numbers[0], numbers[1], numbers[2]};
  if (!(band.from_m < band.to_m)) return "ends before it begins";
  if (!(band.size_m > 0.0) || std::isinf(band.size_m)) return "has a size that is not a length above 0";
  bands.push_back(band);
  return {};
}

std::string textOf(double number) {
  std::ostringstream out;
  out << std::setprecision(10) << number;
  return out.str();
}

// Options that request sizes.
const std::vector<std::string> kSizes = {"--size",           "--size-shore",       "--size-features",
                                         "--size-raster",    "--channel-elements", "--wave-elements",
                                         "--slope-elements", "--depth-band",       "--courant-min"};

}  // namespace

void declareSizes(OptionTable& table, SizeOptions& sizes, SizingUsage& usage, const SizeHelp& help,
                  const std::function<SizeChoice()>& choice) {
  const auto chooses = [choice] { return choice() != SizeChoice::None; };
  const auto choosesByDepth = [choice] { return choice() == SizeChoice::FromExtentAndDepths; };
  constexpr NumberRange kAboveZero{0.0, kInfinity, true};
  constexpr NumberRange kNotNegative{0.0, kInfinity};
  table.section(Section::Sizes);
  table.number({"--size", "Size everywhere"}, sizes.size_m, "M", kAboveZero,
               "edge length everywhere, unless another option requests less");
  table.number({"--size-min", "Minimum size"}, sizes.least_m, "M", kNotNegative, help.least).needs(kSizes, chooses);
  table.number({"--size-max", "Maximum size"}, sizes.most_m, "M", kAboveZero, help.most);
  table
      .number({"--grade", "Gradation of sizes"}, sizes.gradation, "G", {0.0, 1.0, true},
              "sizes at two places differ by at most this times their distance", &usage.grade_given)
      .needs(kSizes, chooses);
  table.number({"--size-shore", "Size at the shore"}, sizes.shore_m, "M", kAboveZero, "edge length at the shore");
  table
      .number({"--shore-rate", "Growth away from the shore"}, sizes.shore_rate, "R", {0.0, 1000.0},
              "how fast that size grows with the distance from the shore", &usage.shore_rate_given)
      .needs({"--size-shore"}, chooses);
  table.number({"--channel-elements", "Elements across channels"}, sizes.channel_elements, "N", {0.0, 1000.0},
               "elements across channels and straits; 0: not used");
  table.texts({"--size-features", "Features with sizes"}, sizes.features, kVectorFile, false,
              "points, lines and polygons with a size in metres in the attribute 'size', and its growth with the "
              "distance in 'rate' (default: --grade)");
  table.texts({"--size-raster", "Rasters of sizes"}, sizes.rasters, kRasterFile, false,
              "raster of sizes in metres; of several, the first that covers a place is used");
  table.number({"--wave-elements", "Elements per wavelength"}, sizes.depth.wave_elements, "N", {0.0, 1e9},
               "elements per wavelength of a long wave, given --bathymetry; 0: not used");
  table
      .number({"--wave-period", "Wave period"}, sizes.depth.period_s, "S", {0.1, 1e8},
              "period of that wave; default: the M2 tide")
      .needs({"--wave-elements"}, choosesByDepth);
  table.number({"--slope-elements", "Elements per slope length"}, sizes.depth.slope_elements, "N", {0.0, 1000.0},
               "elements per length of 2 pi times depth over slope; 0: not used");
  table
      .number({"--slope-filter", "Slope filter length"}, sizes.depth.slope_filter_m, "M", kNotNegative,
              "slopes of features shorter than this are ignored; default: --size-min", &usage.filter_given)
      .needs({"--slope-elements"});
  table.numbers(
      {"--depth-band", "Sizes by depth"}, "FROM,TO,SIZE", true,
      [&sizes](const std::vector<double>& numbers) { return storeBand(numbers, sizes.depth.bands); },
      "size where the depth is at least FROM and less than TO, all in metres, depths positive");
  table.number({"--time-step", "Time step"}, sizes.time_step_s, "S", {0.0, 1e6}, help.time_step,
               &usage.time_step_given);
  table
      .number({"--courant", "Maximum Courant number"}, sizes.courant, "C", {1e-3, 1e3},
              "sqrt(9.81 depth) times the time step over the shortest edge of a triangle, with the depth of its "
              "deepest corner")
      .needs({"--time-step"}, [&usage, choosesByDepth] { return !usage.time_step_given && choosesByDepth(); });
  table
      .number(
          {"--courant-min", "Minimum Courant number"}, sizes.least_courant, "C", {0.0, 1e3},
          "elements are so small that this Courant number is reached with the time step, where --size-min allows "
          "that; SCHISM wants 0.4. At most a third of --courant; triangles that miss it are reported, with exit code "
          "1; 0: not used")
      .needs({"--time-step"});
}

void declareSizing(OptionTable& table, SizeOptions& sizes, SizingUsage& usage,
                   const std::function<SizeChoice()>& choice) {
  const SizeHelp help{
      "no size is smaller; with --coast follow edges shorter than 0.7 of it are avoided, "
      "at the shore too; those left are reported, with exit code 1 if one is shorter than half of it",
      "no size is larger; without any other size, no edge is longer",
      "no element is smaller than --courant allows for this time step: sizes are at least 5/3 of that, as the "
      "shortest edges come out at 0.6 of the size; triangles that miss it are reported, with exit code 1; 0: "
      "not used"};
  declareSizes(table, sizes, usage, help, choice);
  const auto follows = [&usage, choice] { return !usage.coast_given && choice() != SizeChoice::None; };
  table.section(Section::Coast);
  table.choice(
      {"--coast", "Detail of the coast"}, "keep", {"keep", "follow"},
      [&sizes, &usage](const std::string& chosen) {
        usage.coast_given = true;
        sizes.coast = chosen == "follow" ? CoastDetail::Follow : CoastDetail::Keep;
      },
      "keep the coast as it is, or generalise it to follow the sizes: its edges become about that long, and water, "
      "land and islands narrower than an element are removed");
  table
      .number({"--channel-min", "Narrowest channel"}, sizes.follow.channel_min, "N", {0.0, 100.0},
              "with --coast follow: close water narrower than N times the size there; 0 closes none")
      .needs({"--coast follow"}, follows);
  table
      .number({"--strait-min", "Narrowest strait"}, sizes.follow.strait_min, "N", {0.0, 100.0},
              "with --coast follow: a narrow connection of waters, in the data at least N times the size there wide, "
              "is widened to --channel-min times the size instead of closed, if this takes less than a quarter of the "
              "water behind it; N of --channel-min or more widens none")
      .needs({"--coast follow"}, follows);
  table
      .number({"--land-min", "Narrowest land"}, sizes.follow.land_min, "N", {0.0, 100.0},
              "with --coast follow: remove spits and capes narrower than N times the size there, unless that joins "
              "large waters which only narrow water connects; 0 keeps them")
      .needs({"--coast follow"}, follows);
  table
      .choice(
          {"--keep-water", "Waters to keep"}, "auto", {"auto", "largest", "open", "all"},
          [&sizes](const std::string& chosen) {
            sizes.keep_water_given = chosen != "auto";
            sizes.follow.keep = chosen == "largest" ? KeepWater::Largest
                                : chosen == "open"  ? KeepWater::Open
                                                    : KeepWater::All;
          },
          "with --coast follow: which parts of the water to keep if closing divides it: largest; open: those at an "
          "open boundary, or the largest if there are none; all; auto: all, but with --target those at an open "
          "boundary, without parts less than a tenth as large as the largest of them (or the largest part of all if "
          "they are less than a tenth of the water)")
      .needs({"--coast follow"}, follows);
  table
      .texts({"--passages", "Passages to keep open"}, sizes.passages, kVectorFile, false,
             "with --coast follow: lines along which water stays open, widened to --passage-elements where it is "
             "narrower; their attribute 'name' is reported")
      .needs({"--coast follow"}, follows);
  table
      .number({"--passage-elements", "Elements across passages"}, sizes.passage_elements, "N", {0.5, 100.0},
              "elements across passages")
      .needs({"--passages"});
  table
      .texts({"--barriers", "Barriers"}, sizes.barriers, kVectorFile, false,
             "with --coast follow: lines along which water is closed, half an element wide")
      .needs({"--coast follow"}, follows);
}

void settleSizing(const SizingUsage& usage, const DepthOptions& depths, SizeChoice choice, SizeOptions& sizes) {
  sizes.bathymetry = depths.files;
  sizes.gaps = depths.fill == DepthFill::None      ? GapFill::None
               : depths.fill == DepthFill::Nearest ? GapFill::Nearest
                                                   : GapFill::Mean;
  sizes.depth.positive_down = depths.positive_down;
  sizes.depth.water_level_m = depths.water_level_m;
  sizes.depth.least_depth_m = std::max(sizes.depth.least_depth_m, depths.min_depth_m);
  if (choice != SizeChoice::None) {
    constexpr double kGradation = 0.2, kWaveElements = 100.0, kTimeStep = 5.0;
    sizes.choose = true;
    sizes.gradation = usage.grade_given ? sizes.gradation : kGradation;
    if (choice == SizeChoice::FromExtentAndDepths) {
      sizes.depth.wave_elements = kWaveElements;
      if (!usage.time_step_given) sizes.time_step_s = kTimeStep;
    }
    if (!usage.coast_given) sizes.coast = CoastDetail::Follow;
    sizes.given = {usage.shore_rate_given, usage.grade_given, usage.time_step_given, usage.coast_given};
  }
  if (sizes.least_courant > 0.0 && sizes.time_step_s > 0.0) {
    // Few triangles have a shortest edge that is longer than the size by more than this leaves.
    constexpr double kLongestOfSize = 1.15, kMost = 1.0 / 3.0;
    if (sizes.least_courant > kMost * sizes.courant)
      throw OptionError("--courant-min " + textOf(sizes.least_courant) + " needs a --courant of at least " +
                        textOf(sizes.least_courant / kMost) +
                        ", or no sizes are between them; implicit models such as SCHISM take 20");
    sizes.depth.crossing_s = sizes.time_step_s / (kLongestOfSize * sizes.least_courant);
  }
  if (!usage.filter_given) sizes.depth.slope_filter_m = sizes.least_m;
  if (sizes.least_m > sizes.most_m) throw OptionError("--size-min is more than --size-max");
  if ((sizes.depth.any() || sizes.time_step_s > 0.0) && sizes.bathymetry.empty()) {
    throw OptionError(
        "--wave-elements, --slope-elements, --depth-band and --time-step need depths: give a raster with "
        "--bathymetry");
  }
  if (sizes.time_step_s > 0.0 && !sizes.any())
    throw OptionError("--time-step only keeps sizes from being too small: ask for some size besides, such as --size");
  if (sizes.coast == CoastDetail::Follow && !sizes.any())
    throw OptionError("--coast follow needs sizes to follow: give --size, or others");
  if (sizes.least_m == 0.0 && (sizes.depth.slope_elements > 0.0 || sizes.channel_elements > 0.0))
    throw OptionError("--slope-elements and --channel-elements can ask for lengths near 0: give --size-min");
}

std::vector<std::string> notesOnOverriddenSizes(const SizingUsage& usage, const SizeOptions& sizes) {
  std::vector<std::string> notes;
  const auto note = [&](const std::string& asked, bool is_more, const char* bound, double limit) {
    notes.push_back(asked + " is " + (is_more ? "more" : "less") + " than " + bound + " " + textOf(limit) +
                    ", which overrides it");
  };
  const auto compare = [&](const std::string& asked, double size_m) {
    if (!std::isfinite(size_m)) return;
    if (size_m > sizes.most_m) note(asked, true, "--size-max", sizes.most_m);
    if (size_m < sizes.least_m) note(asked, false, "--size-min", sizes.least_m);
    if (size_m > sizes.size_m) note(asked, true, "--size", sizes.size_m);
  };
  compare("--size " + textOf(sizes.size_m), sizes.size_m);
  compare("--size-shore " + textOf(sizes.shore_m), sizes.shore_m);
  for (const DepthBand& band : sizes.depth.bands)
    compare("--depth-band " + textOf(band.from_m) + "," + textOf(band.to_m) + "," + textOf(band.size_m), band.size_m);
  if (usage.shore_rate_given && (sizes.choose || std::isfinite(sizes.shore_m)) && sizes.shore_rate > sizes.gradation)
    note("--shore-rate " + textOf(sizes.shore_rate), true, "--grade", sizes.gradation);
  return notes;
}

}  // namespace coastmesh
