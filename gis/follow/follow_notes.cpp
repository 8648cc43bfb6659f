#include "gis/follow/follow_notes.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <map>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

constexpr const char* kNoEffect = " meets no water that is meshed: it has no effect";
constexpr std::size_t kNamedPoints = 5;

std::string formatted(const char* format, double a, double b = 0.0) {
  char text[80];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

std::string placeText(const Point& place, const Projection& projection) {
  return "(" + roughPlaceInWords(projection.inverse(place)) + ")";
}

std::string lengthText(double length_m, const Projection& projection) {
  if (projection.isIdentity()) return formatted(length_m < 1e3 ? "%.3g" : "%.0f", length_m);
  if (length_m < 1e3) return formatted("%.0f m", length_m);
  return formatted(length_m < 1e6 ? "%.3g km" : "%.0f km", 1e-3 * length_m);
}

std::string wayText(const WaterWay& way, const Projection& projection) {
  return lengthText(way.width_m, projection) + " wide";
}

NotedWater notedOf(const DetachedWater& apart, const FollowOptions& options, bool has_barriers,
                   const Projection& projection) {
  const auto& [water, way] = apart;
  std::string where = " at " + placeText(water.inside.front(), projection);
  if (water.at_open) where += ", which has an open boundary";
  where += way.exists ? (options.of_land ? ", behind land " : ", behind water ") + wayText(way, projection) + " at " +
                            placeText(way.place, projection)
                      : std::string(", without a connection in the data") + (has_barriers ? " or behind barriers" : "");
  return {water.area, areaInWords(water.area, projection.isIdentity()), where};
}

bool isWidenedByStraitMin(const DetachedWater& apart, const FollowOptions& options) {
  const auto& [water, way] = apart;
  return way.exists && way.least < options.strait_min && isWorthWidening(way, water.area);
}

// A strait that was widened, and the waters that it joins.
struct JoiningStrait {
  const JoinedWater* largest;
  double area = 0.0;
  std::size_t waters = 0;
};

// A strait is known by its narrowest place.
std::vector<JoiningStrait> joiningStraits(const std::vector<JoinedWater>& joined) {
  std::vector<JoiningStrait> straits;
  std::map<std::pair<double, double>, std::size_t> strait_at;
  for (const JoinedWater& water : joined) {
    const Point& place = water.way.place;
    const auto [at, is_first] = strait_at.try_emplace({place.x, place.y}, straits.size());
    if (is_first) straits.push_back({&water});
    JoiningStrait& strait = straits[at->second];
    if (water.area > strait.largest->area) strait.largest = &water;
    strait.area += water.area;
    ++strait.waters;
  }
  return straits;
}

NotedWater notedOf(const JoiningStrait& strait, const Projection& projection) {
  const WaterWay& way = strait.largest->way;
  return {strait.area,
          placeText(way.place, projection) + ", " + wayText(way, projection) + ", about " +
              lengthText(way.length_m, projection) + " long, to " + areaInWords(strait.area, projection.isIdentity()),
          strait.waters > 1 ? " in " + std::to_string(strait.waters) + " waters" : ""};
}

FollowedWaters followedOf(const FollowNotes& notes, const FollowOptions& options, bool has_barriers,
                          const Projection& projection) {
  FollowedWaters waters;
  waters.area_m2 = notes.area;
  waters.in_plane = projection.isIdentity();
  for (const DetachedWater& apart : notes.cut_off) {
    waters.cut_off.add(notedOf(apart, options, has_barriers, projection));
    waters.cut_off_by_way |= apart.way.exists;
    waters.cut_off_widens |= isWidenedByStraitMin(apart, options);
    waters.none_kept_open |= options.keep == KeepWater::Modelled && apart.water.at_open;
  }
  for (const DetachedWater& apart : notes.apart) {
    waters.apart.add(notedOf(apart, options, has_barriers, projection));
    if (apart.way.exists) waters.closed_m2 += apart.water.area;
    waters.apart_widens |= isWidenedByStraitMin(apart, options);
  }
  waters.with_apart = notes.apart.empty() ? 0 : 1;
  for (const JoiningStrait& strait : joiningStraits(notes.joined))
    waters.joined.add(notedOf(strait, projection), strait.waters);
  for (const SmallWater& water : notes.too_small)
    waters.too_small.add(
        {water.area, areaInWords(water.area, projection.isIdentity()), " at " + placeText(water.place, projection)});
  for (const ClosedStrait& strait : notes.straits)
    waters.straits.add({strait.length_m, placeText(strait.place, projection) + ", about " +
                                             lengthText(strait.length_m, projection) + " long, " +
                                             lengthText(strait.width_m, projection) + " wide"});
  for (const DroppedSpit& spit : notes.spits)
    waters.spits.add({spit.length_m, placeText(spit.place, projection) + ", about " +
                                         lengthText(spit.length_m, projection) + " long"});
  return waters;
}

// "passage 'Solent'", "barrier 2".
std::string nameOf(const std::string& kind, const std::vector<ShoreLine>& lines, std::size_t line) {
  const std::string& name = lines[line].name;
  return kind + " " + (name.empty() ? std::to_string(line + 1) : "'" + name + "'");
}

void notePassages(const PassageEffects& effects, const std::vector<ShoreLine>& passages, const Projection& projection,
                  CleanReport& report) {
  for (const WidenedPassage& passage : effects.widened) {
    const std::string name = nameOf("passage", passages, passage.line);
    report.notes.push_back(name + " was widened to " + lengthText(passage.width_m, projection) + " along " +
                           lengthText(passage.length_m, projection) + ", up to " +
                           placeText(passage.place, projection));
    if (passage.dug_m > 0.0)
      report.warnings.push_back(name + " was dug through land: " + lengthText(passage.dug_m, projection) +
                                " of it, the longest piece, at " + placeText(passage.dug_at, projection));
  }
  for (const auto& [line, place, length_m] : effects.ends)
    report.warnings.push_back(nameOf("passage", passages, line) + " goes on for " + lengthText(length_m, projection) +
                              " beyond the water, from " + placeText(place, projection) +
                              ", and reaches none that is meshed together with it: nothing was dug there");
  for (const std::size_t line : effects.dry) report.idle.push_back(nameOf("passage", passages, line) + kNoEffect);
}

}  // namespace

NotedLength metPoint(const Point& place, double apart_m, const Projection& projection) {
  return {apart_m, lengthText(apart_m, projection) + " at " + placeText(place, projection)};
}

std::string warningOf(const ShortSegments& segments, const Projection& projection) {
  return "the coast could not follow the sizes everywhere: " + std::to_string(segments.count) +
         forCount(segments.count, " segment is", " segments are") + " much shorter, the shortest at " +
         placeText(segments.place, projection) + ", " + lengthText(segments.length_m, projection) +
         " long where the size is " + lengthText(segments.size_m, projection) +
         "; other sizes or another frame may avoid that";
}

void noteLostIslands(const std::vector<IslandRing>& before, const Domain& domain, const SizeFunction& size,
                     FollowedWaters& waters, const ItemLoop& loop) {
  constexpr double kNoted = 2.0;  // elements, as `noteWaters` says
  if (before.empty()) return;
  const ScaleTable scales(domain.projection, boxAround(domain.pslg.points, loop));
  for (const LostIsland& island : lostIslands(before, domain.pslg, size, scales, kNoted, loop)) {
    waters.islands.add({island.area_m2, areaInWords(island.area_m2, domain.projection.isIdentity()),
                        " at " + placeText(island.place, domain.projection)});
  }
}

void noteLostLines(const LostLines& lost, const Domain& domain, CleanReport& report) {
  constexpr double kNoted = 0.5;  // elements; shorter losses are not reported
  for (const auto& [tag, part] : lost.lines) {
    if (part.elements < kNoted) continue;
    std::string name = "a line in the water";
    if (isLineTag(tag)) {
      const DomainLine& line = domain.lines[lineOfTag(tag)];
      if (line.use == FeatureUse::Region || line.use == FeatureUse::Area) continue;
      name = std::string(line.use == FeatureUse::Weir ? "weir" : "constraint") +
             (line.name.empty() ? "" : " '" + line.name + "'");
    }
    report.warnings.push_back(
        name + ": " + lengthText(part.length_m, domain.projection) + " of it, at " +
        placeText(part.first, domain.projection) +
        ", runs through water that is closed or hardly off its shore, and is left out; --passages "
        "keeps the water open");
  }
  if (lost.points.empty()) return;
  std::string places;
  for (std::size_t i = 0; i < std::min(kNamedPoints, lost.points.size()); ++i)
    places += (i == 0 ? "" : ", ") + placeText(lost.points[i], domain.projection);
  report.warnings.push_back(std::to_string(lost.points.size()) +
                            forCount(lost.points.size(), " point lies", " points lie") +
                            " in water that is closed, and " + forCount(lost.points.size(), "is", "are") +
                            " left out: " + places + "; --passages keeps the water open");
}

void noteFollowing(FollowNotes&& notes, const ShoreGuides& guides, const FollowOptions& options,
                   const Projection& projection, CleanReport& report) {
  std::vector<std::string>& texts = report.notes;
  notePassages(notes.passages, guides.passages, projection, report);
  for (const auto& [line, end] : notes.open_barriers) {
    const std::string name = nameOf("barrier", guides.barriers, line);
    if (end) {
      texts.push_back(name + " ends in the water, at " + placeText(*end, projection) +
                      ", an element or more from the shore: the water goes round it, unless the gap there is so "
                      "narrow that it is closed");
    } else {
      report.idle.push_back(name + kNoEffect);
    }
  }
  report.waters.append(followedOf(notes, options, !guides.barriers.empty(), projection));
}

}  // namespace coastmesh
