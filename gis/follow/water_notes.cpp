#include "gis/follow/water_notes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kNamedWaters = 3, kNamedStraits = 10, kNamedSpits = 5;
// Shares of all water.
constexpr double kLargeWater = 0.005;  // larger waters are named, even if not among the first
constexpr double kWarned = 0.02;       // left out, separated or closed: more than models tolerate

std::string formatted(const char* format, double value) {
  char text[80];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string shareText(double area_m2, const FollowedWaters& waters) {
  const double percent = 100.0 * area_m2 / waters.area_m2;
  return " (" + formatted(percent < 10.0 ? "%.2g %%" : "%.0f %%", percent) + ")";
}

std::string areaText(double area_m2, const FollowedWaters& waters) {
  return areaInWords(area_m2, waters.in_plane) + shareText(area_m2, waters);
}

std::string nameOf(const NotedWater& water, const FollowedWaters& waters) {
  return water.before + shareText(water.area_m2, waters) + water.after;
}

// The largest waters, what separates them from the others, and options that change that.
std::string namesOf(const NotedWaters& some, bool by_way, bool widens, const FollowedWaters& waters) {
  std::string names;
  std::size_t named = 0;
  for (const NotedWater& water : some.largest) {
    if (named >= kNamedWaters && water.area_m2 < kLargeWater * waters.area_m2) break;
    names += (named++ == 0 ? "" : "; ") + nameOf(water, waters);
  }
  if (by_way)
    names += std::string("; --passages or a smaller --channel-min keep the connection open") +
             (widens ? ", a smaller --strait-min widens it" : "");
  return names;
}

std::string whatIsMeshed(const FollowOptions& options) { return options.of_land ? "the land" : "the water"; }

std::string noteOnCutOff(const FollowedWaters& waters, const FollowOptions& options) {
  const NotedWaters& cut_off = waters.cut_off;
  std::string note =
      areaText(cut_off.area_m2, waters) + " of " + whatIsMeshed(options) +
      (options.keep == KeepWater::All ? " is meshed apart, " : " is left out, ") + std::to_string(cut_off.count) +
      (options.of_land ? forCount(cut_off.count, " piece", " pieces") : forCount(cut_off.count, " water", " waters")) +
      " without a connection to the " +
      (options.keep == KeepWater::Largest || waters.none_kept_open ? "largest" : "others") + ": the largest " +
      namesOf(cut_off, waters.cut_off_by_way, waters.cut_off_widens, waters);
  if (options.keep != KeepWater::All) note += "; --keep-water all keeps them as they are";
  return note;
}

std::string noteOnApart(const FollowedWaters& waters, const FollowOptions& options) {
  return whatIsMeshed(options) + " is meshed in " + std::to_string(waters.apart.count + waters.with_apart) +
         " parts without a connection: besides the largest " +
         namesOf(waters.apart, waters.closed_m2 > 0.0, waters.apart_widens, waters) +
         "; --keep-water largest leaves them out";
}

std::string noteOnJoined(const FollowedWaters& waters) {
  const NotedWaters& joined = waters.joined;
  std::string note =
      "straits that are the only connection between waters were widened to an element instead of closed, for the "
      "largest of " +
      std::to_string(joined.count) + forCount(joined.count, " water: ", " waters: ");
  for (std::size_t i = 0; i < std::min(kNamedStraits, joined.largest.size()); ++i)
    note += (i == 0 ? "" : "; ") + nameOf(joined.largest[i], waters);
  return note + "; a larger --strait-min closes them";
}

// `least`: the least width, in elements, of what is removed to the benefit of what is meshed, or of this.
std::string whatChangesArea(bool is_more, double least, bool of_land) {
  if (is_more && least == 0.0)
    return of_land ? "water smaller than an element is filled, and land narrower than one is widened"
                   : "islands smaller than an element are removed, and water narrower than one is widened";
  return (is_more != of_land ? "land narrower than " : "water narrower than ") +
         (least > 1.0 ? formatted("%.3g elements", least) : "an element") +
         (is_more ? (of_land ? " that ends in land is filled" : " that ends in water is removed")
                  : (of_land ? " is removed" : " is closed"));
}

// `begin`, their number, `most` of them at most, and `end`.
std::string noteOn(const std::string& begin, const NotedLengths& items, std::size_t most, const std::string& end) {
  std::string note = begin + std::to_string(items.count) + ": ";
  for (std::size_t i = 0; i < std::min(most, items.longest.size()); ++i)
    note += (i == 0 ? "" : "; ") + items.longest[i].text;
  return note + end;
}

std::string noteOnMet(const NotedLengths& met) {
  return "the shore passes through " + std::to_string(met.count) +
         forCount(met.count, " point or end of a line", " points or ends of lines") +
         " less than a quarter of an element off it, the farthest " + met.longest.front().text;
}

std::string noteOnTooSmall(const FollowedWaters& waters, const FollowOptions& options) {
  const NotedWaters& small = waters.too_small;
  return std::to_string(small.count) +
         (options.of_land ? forCount(small.count, " piece of land", " pieces of land")
                          : forCount(small.count, " water", " waters")) +
         " narrower than an element" + forCount(small.count, " stays", " stay") +
         " about as in the input, with shorter edges: " + forCount(small.count, "", "the largest ") +
         namesOf(small, false, false, waters);
}

std::string noteOnIslands(const FollowedWaters& waters) {
  const NotedWaters& islands = waters.islands;
  std::string note = "islands narrower than an element were removed, the largest of " + std::to_string(islands.count) +
                     " that are larger than two: ";
  for (std::size_t i = 0; i < std::min(kNamedSpits, islands.largest.size()); ++i)
    note += (i == 0 ? "" : "; ") + islands.largest[i].before + islands.largest[i].after;
  return note + "; --land-min 0 keeps them";
}

double leftOut(const FollowedWaters& waters, const FollowOptions& options) {
  return options.keep == KeepWater::All ? 0.0 : waters.cut_off.area_m2;
}

}  // namespace

std::string areaInWords(double area_m2, bool in_plane) {
  if (in_plane) return formatted(area_m2 < 1000.0 ? "%.3g" : "%.0f", area_m2);
  const double area_km2 = 1e-6 * area_m2;
  return formatted(area_km2 < 1000.0 ? "%.3g km²" : "%.0f km²", area_km2);
}

NotesAndWarnings noteWaters(const FollowedWaters& waters, const FollowOptions& options) {
  NotesAndWarnings all;
  const auto listFor = [&](double lost_m2) -> std::vector<std::string>& {
    return lost_m2 > kWarned * waters.area_m2 ? all.warnings : all.notes;
  };
  if (waters.met.count > 0) all.notes.push_back(noteOnMet(waters.met));
  if (waters.straits.count > 0)
    all.notes.push_back(
        noteOn("straits closed, the longest of ", waters.straits, kNamedStraits, "; keep them open with --passages"));
  if (waters.spits.count > 0)
    all.notes.push_back(noteOn("land narrower than an element that ended in water was removed, the longest of ",
                               waters.spits, kNamedSpits, "; --land-min 0 keeps such breakwaters and spits"));
  if (waters.islands.count > 0) all.notes.push_back(noteOnIslands(waters));
  if (waters.too_small.count > 0) all.notes.push_back(noteOnTooSmall(waters, options));
  if (waters.joined.count > 0) all.notes.push_back(noteOnJoined(waters));
  if (waters.apart.count > 0) listFor(waters.closed_m2).push_back(noteOnApart(waters, options));
  if (waters.cut_off.count > 0) listFor(leftOut(waters, options)).push_back(noteOnCutOff(waters, options));
  return all;
}

std::string warningOfArea(const FollowedWaters& waters, const FollowOptions& options, double meshed_m2) {
  const double gained = meshed_m2 + leftOut(waters, options) - waters.area_m2;
  if (!(std::abs(gained) > kWarned * waters.area_m2)) return {};
  const bool is_more = gained > 0.0;
  const double least = is_more ? options.land_min : options.channel_min;
  std::string text = whatIsMeshed(options) + " has " + areaText(std::abs(gained), waters) +
                     (is_more ? " more" : " less") +
                     " area than in the input: " + whatChangesArea(is_more, least, options.of_land) +
                     "; smaller sizes (--size-shore, --size-max)";
  if (least > 0.0) text += is_more ? " or a smaller --land-min" : " or a smaller --channel-min";
  return text + " keep more of it";
}

}  // namespace coastmesh
