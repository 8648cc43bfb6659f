// Notes and warnings on waters cover all groups of features, and so do the shares of water that they state.
#include "gis/follow/water_notes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "gis/crs/geodesy.hpp"
#include "gis/follow/follow_notes.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FollowedWaters group(double area_m2, const std::vector<double>& cut_off) {
  FollowedWaters waters;
  waters.area_m2 = area_m2;
  for (const double area : cut_off) waters.cut_off.add({area, areaInWords(area, false), " at (0, 0)"});
  return waters;
}

TEST(WaterNotes, AThirdOfALakeBesideASeaIsNoWarning) {
  const FollowOptions largest{.keep = KeepWater::Largest};
  FollowedWaters lake = group(7e6, {2e6, 0.1e6});
  EXPECT_THAT(noteWaters(lake, largest).warnings, ElementsAre(HasSubstr("2.1 km² (30 %) of the water is left out")));
  FollowedWaters all = group(993e6, {});
  all.append(std::move(lake));
  const NotesAndWarnings texts = noteWaters(all, largest);
  EXPECT_THAT(texts.warnings, IsEmpty());
  EXPECT_THAT(texts.notes, ElementsAre(HasSubstr("2.1 km² (0.21 %) of the water is left out, 2 waters")));
  EXPECT_THAT(texts.notes[0], HasSubstr("the largest 2 km² (0.2 %) at (0, 0); 0.1 km² (0.01 %) at (0, 0)"));
}

JoinedWater joinedAt(const Point& place, double length_m, double area_m2) {
  JoinedWater water;
  water.way.exists = true;
  water.way.place = place;
  water.way.width_m = 100.0;
  water.way.length_m = length_m;
  water.area = area_m2;
  return water;
}

TEST(WaterNotes, AStraitToSeveralWatersIsNamedOnce) {
  FollowNotes notes;
  notes.area = 1000.0;
  notes.joined = {joinedAt({1, 2}, 10.0, 30.0), joinedAt({3, 4}, 20.0, 50.0), joinedAt({1, 2}, 30.0, 40.0),
                  joinedAt({1, 2}, 40.0, 10.0)};
  CleanReport report;
  noteFollowing(std::move(notes), {}, {}, Projection::plane(), report);
  EXPECT_THAT(noteWaters(report.waters, {}).notes,
              ElementsAre(HasSubstr("for the largest of 4 waters: (1, 2), 100 wide, about 30 long, to 80 (8 %) in 3 "
                                    "waters; (3, 4), 100 wide, about 20 long, to 50 (5 %); a larger")));
}

// A way that would take much more land than there is water behind it stays closed with any --strait-min.
TEST(WaterNotes, OptionsThatWouldNotHelpAreNotNamed) {
  const auto noteOn = [](double least, double widening_m2) {
    FollowNotes notes;
    notes.area = 1000.0;
    DetachedWater& water = notes.cut_off.emplace_back();
    water.water.area = 40.0;
    water.water.inside = {{5, 6}};
    water.way.exists = true;
    water.way.least = least;
    water.way.widening_m2 = widening_m2;
    CleanReport report;
    noteFollowing(std::move(notes), {}, {.strait_min = 0.4}, Projection::plane(), report);
    const NotesAndWarnings texts = noteWaters(report.waters, {.keep = KeepWater::Largest});
    return texts.warnings.empty() ? "" : texts.warnings.front();
  };
  EXPECT_THAT(noteOn(0.3, 5.0), HasSubstr("keep the connection open, a smaller --strait-min widens it"));
  for (const std::string& note : {noteOn(0.3, 50.0), noteOn(0.5, 5.0)}) {
    EXPECT_THAT(note, HasSubstr("--channel-min keep the connection open"));
    EXPECT_THAT(note, ::testing::Not(HasSubstr("--strait-min")));
  }
}

TEST(WaterNotes, LargeNumbersHaveNoExponents) {
  Coastline coast;
  coast.crs = wgs84();
  coast.features.emplace_back().lines = {{{0.0, 0.0}, {1.0, 1.0}}};
  const Projection earth = Projection::fitted(coast, {0}), plane = Projection::plane();
  EXPECT_EQ(metPoint({}, 999.0, earth).text.find("999 m at"), 0u);
  EXPECT_EQ(metPoint({}, 999e3, earth).text.find("999 km at"), 0u);
  EXPECT_EQ(metPoint({}, 4512e3, earth).text.find("4512 km at"), 0u);
  EXPECT_EQ(metPoint({}, 0.5, plane).text.find("0.5 at"), 0u);
  EXPECT_EQ(metPoint({}, 4512.0, plane).text.find("4512 at"), 0u);
  EXPECT_EQ(areaInWords(1612.0, true), "1612");
  EXPECT_EQ(areaInWords(1612e6, false), "1612 km²");
}

TEST(WaterNotes, ManyLittleLossesAreOneWarning) {
  FollowedWaters all;
  for (int i = 1; i <= 100; ++i) all.append(group(10e6, {i == 50 ? 0.5e6 : 0.2e6 + i}));
  const NotesAndWarnings texts = noteWaters(all, {.keep = KeepWater::Largest});
  ASSERT_THAT(texts.warnings, ElementsAre(HasSubstr("20.3 km² (2 %) of the water is left out, 100 waters")));
  EXPECT_THAT(texts.warnings[0], HasSubstr("the largest 0.5 km² (0.05 %) at (0, 0); 0.2 km²"));
  EXPECT_EQ(all.cut_off.largest.size(), NotedWaters::kMost);
  EXPECT_EQ(all.cut_off.largest.back().area_m2, 0.2e6 + 82);
}

TEST(WaterNotes, ManyGroupsAreOneNoteOfEachKind) {
  FollowedWaters all;
  for (int i = 1; i <= 30; ++i) {
    FollowedWaters lake = group(1e6, {});
    const double length_m = 100.0 * ((7 * i) % 31);
    lake.straits.add({length_m, "strait " + std::to_string(i)});
    lake.straits.add({1.0, "a short one"});
    lake.spits.add({length_m, "spit " + std::to_string(i)});
    lake.met.add({length_m, "point " + std::to_string(i)});
    lake.too_small.add({1e6, "1 km²", " at (" + std::to_string(i) + ", 0)"});
    all.append(std::move(lake));
  }
  EXPECT_EQ(all.straits.longest.size(), NotedLengths::kMost);
  const NotesAndWarnings texts = noteWaters(all, {});
  EXPECT_THAT(texts.warnings, IsEmpty());
  ASSERT_EQ(texts.notes.size(), 4u);
  EXPECT_THAT(texts.notes[0], HasSubstr("through 30 points or ends of lines less than a quarter of an element off it, "
                                        "the farthest point 22"));
  EXPECT_THAT(texts.notes[1], HasSubstr("straits closed, the longest of 60: strait 22; strait 13; strait 4; strait "));
  EXPECT_THAT(texts.notes[1], HasSubstr("; keep them open with --passages"));
  EXPECT_THAT(texts.notes[2], HasSubstr("was removed, the longest of 30: spit 22; spit 13; spit 4; spit 26; spit 17; "
                                        "--land-min 0 keeps"));
  EXPECT_THAT(texts.notes[3], HasSubstr("30 waters narrower than an element stay about as in the input, with shorter "
                                        "edges: the largest 1 km² (3.3 %) at (1, 0); 1 km² (3.3 %) at (2, 0)"));
}

TEST(WaterNotes, AreasThatChangeByMoreThanTwoPercentAreWarnedOf) {
  const FollowedWaters waters = group(1e10, {1e9});
  const FollowOptions largest{.keep = KeepWater::Largest};
  EXPECT_EQ(warningOfArea(waters, largest, 8.9e9), "");  // another warning reports the tenth that is left out
  EXPECT_EQ(warningOfArea(waters, largest, 9.1e9), "");
  EXPECT_EQ(warningOfArea(waters, {}, 9.9e9), "");
  EXPECT_EQ(warningOfArea(waters, largest, 1e9),
            "the water has 8000 km² (80 %) less area than in the input: water narrower than an element is closed; "
            "smaller sizes (--size-shore, --size-max) or a smaller --channel-min keep more of it");
  EXPECT_EQ(warningOfArea(waters, {.land_min = 5.0}, 1.03e10),
            "the water has 300 km² (3 %) more area than in the input: land narrower than 5 elements that ends in water "
            "is removed; smaller sizes (--size-shore, --size-max) or a smaller --land-min keep more of it");
  EXPECT_EQ(warningOfArea(waters, {.land_min = 0.0}, 1.03e10),
            "the water has 300 km² (3 %) more area than in the input: islands smaller than an element are removed, and "
            "water narrower than one is widened; smaller sizes (--size-shore, --size-max) keep more of it");
  EXPECT_EQ(warningOfArea(waters, {.channel_min = 0.0, .of_land = true}, 9e9),
            "the land has 1000 km² (10 %) less area than in the input: land narrower than an element is removed; "
            "smaller sizes (--size-shore, --size-max) keep more of it");
}

}  // namespace
}  // namespace coastmesh
