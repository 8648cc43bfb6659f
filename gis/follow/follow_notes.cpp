#include "gis/follow/follow_notes.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>

namespace coastmesh {

namespace {

constexpr std::size_t kNamedWaters = 3, kNamedStraits = 10;

std::string formatted(const char* format, double a, double b = 0.0) {
  char text[80];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string placeText(const Point& place, const Projection& projection) {
  const Point input = projection.inverse(place);
  return formatted("(%.6g, %.6g)", input.x, input.y);
}

std::string lengthText(double length_m, const Projection& projection) {
  if (projection.isIdentity()) return formatted("%.3g", length_m);
  return length_m < 1000.0 ? formatted("%.0f m", length_m) : formatted("%.3g km", 1e-3 * length_m);
}

std::string noteOn(const std::vector<CutOffWater>& waters, const FollowOptions& options, const Projection& projection) {
  std::string note = std::to_string(waters.size()) + " waters that nothing joins to the others" +
                     (options.keep == KeepWater::Open ? " or to an open boundary" : "") +
                     (options.keep == KeepWater::All ? " are meshed apart" : " are left out");
  for (std::size_t i = 0; i < std::min(kNamedWaters, waters.size()); ++i) {
    note += i == 0 ? ": the largest " : ", ";
    note += projection.isIdentity() ? formatted("%.3g", waters[i].area) : formatted("%.3g km²", 1e-6 * waters[i].area);
    note += " at " + placeText(waters[i].place, projection);
  }
  return note + "; --passages or a smaller --channel-min keep what joins them, --keep-water all keeps them as they are";
}

std::string noteOn(const std::vector<ClosedStrait>& straits, const Projection& projection) {
  std::string note = "straits closed, the longest of " + std::to_string(straits.size()) + ": ";
  for (std::size_t i = 0; i < std::min(kNamedStraits, straits.size()); ++i) {
    if (i > 0) note += "; ";
    note += placeText(straits[i].place, projection) + ", about " + lengthText(straits[i].length_m, projection) +
            " long, " + lengthText(straits[i].width_m, projection) + " wide";
  }
  return note + "; keep them open with --passages";
}

std::string nameOf(const ShoreGuides& guides, std::size_t line) {
  const std::string& name = guides.passages[line].name;
  return name.empty() ? "passage " + std::to_string(line + 1) : "passage '" + name + "'";
}

}  // namespace

std::vector<std::string> notesOf(FollowNotes&& notes, const ShoreGuides& guides, const FollowOptions& options,
                                 const Projection& projection) {
  std::vector<std::string> texts;
  for (const WidenedPassage& passage : notes.widened) {
    texts.push_back(nameOf(guides, passage.line) + " was widened to " + lengthText(passage.width_m, projection) +
                    " along " + lengthText(passage.length_m, projection) + ", up to " +
                    placeText(passage.place, projection));
  }
  for (const std::size_t line : notes.dry)
    texts.push_back(nameOf(guides, line) + " meets no water here: it has no effect");
  std::ranges::stable_sort(notes.straits, std::ranges::greater{}, &ClosedStrait::length_m);
  if (!notes.straits.empty()) texts.push_back(noteOn(notes.straits, projection));
  std::ranges::stable_sort(notes.cut_off, std::ranges::greater{}, &CutOffWater::area);
  if (!notes.cut_off.empty()) texts.push_back(noteOn(notes.cut_off, options, projection));
  return texts;
}

}  // namespace coastmesh
