#include "gis/crs/crs_map.hpp"

#include <cpl_conv.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

Point transform(OGRCoordinateTransformation& by, const Point& p) {
  double x = p.x, y = p.y;
  if (by.Transform(1, &x, &y)) return {x, y};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {nan, nan};
}

std::string named(const OGRSpatialReference& srs) { return srs.GetName() ? srs.GetName() : "unnamed"; }

std::string wktOf(const OGRSpatialReference& srs) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", nullptr};
  srs.exportToWkt(&text, options);
  std::string wkt = text ? text : "";
  CPLFree(text);
  return wkt;
}

OGRSpatialReference fromWkt(const std::string& wkt, bool traditional) {
  OGRSpatialReference srs;
  srs.importFromWkt(wkt.c_str());
  if (traditional) srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs;
}

using Transformation = std::unique_ptr<OGRCoordinateTransformation>;

struct Pair {
  Transformation forward, inverse;
};

// The last four things that a thread made, since a run alternates between a few.
template <typename Made>
class LastFour {
 public:
  // The first that passes the test, or null.
  template <typename Test>
  Made* find(const Test& test) {
    const auto found = std::ranges::find_if(made_, [&](const auto& one) { return one && test(*one); });
    return found == made_.end() ? nullptr : &**found;
  }
  Made& add(Made&& made) {
    return made_[std::exchange(oldest_, (oldest_ + 1) % made_.size())].emplace(std::move(made));
  }

 private:
  std::array<std::optional<Made>, 4> made_;
  std::size_t oldest_ = 0;
};

}  // namespace

// What a thread needs to make its own transformation.
struct CrsMap::Ends {
  std::string from, to;
  bool from_traditional = false, to_traditional = false;

  bool operator==(const Ends&) const = default;
};

namespace {

Pair makePair(const CrsMap::Ends& ends) {
  const OGRSpatialReference from = fromWkt(ends.from, ends.from_traditional),
                            to = fromWkt(ends.to, ends.to_traditional);
  Pair pair{Transformation(OGRCreateCoordinateTransformation(&from, &to)),
            Transformation(OGRCreateCoordinateTransformation(&to, &from))};
  for (const Transformation* t : {&pair.forward, &pair.inverse})
    if (*t) (*t)->SetEmitErrors(false);
  return pair;
}

// The transformations of one thread.
class Kept {
 public:
  // Makes the thread's PROJ context first, so that it outlives the transformations; otherwise their destruction would
  // make a new context that is never freed.
  Kept() { OGRSpatialReference().SetWellKnownGeogCS("WGS84"); }

  const Pair& get(const std::shared_ptr<const CrsMap::Ends>& ends) {
    if (const Entry* const same = entries_.find([&](const Entry& entry) { return entry.ends == ends; }))
      return same->pair;
    // Of another map between the same CRS.
    if (Entry* const equal = entries_.find([&](const Entry& entry) { return *entry.ends == *ends; })) {
      equal->ends = ends;
      return equal->pair;
    }
    return entries_.add({ends, makePair(*ends)}).pair;
  }

 private:
  struct Entry {
    std::shared_ptr<const CrsMap::Ends> ends;
    Pair pair;
  };
  LastFour<Entry> entries_;
};

const Pair& pairOfThread(const std::shared_ptr<const CrsMap::Ends>& ends) {
  thread_local Kept kept;
  return kept.get(ends);
}

}  // namespace

CrsMap::CrsMap(const OGRSpatialReference& from, const OGRSpatialReference& to) {
  const auto isTraditional = [](const OGRSpatialReference& srs) {
    return srs.GetAxisMappingStrategy() == OAMS_TRADITIONAL_GIS_ORDER;
  };
  ends_ = std::make_shared<const Ends>(Ends{wktOf(from), wktOf(to), isTraditional(from), isTraditional(to)});
  const OgrErrors errors;
  const Pair& pair = pairOfThread(ends_);
  if (!pair.forward || !pair.inverse) {
    throw InputError("PROJ has no transformation from the CRS " + named(from) + " to " + named(to) +
                     (errors.text().empty() ? "" : " (" + errors.text() + ")"));
  }
}

Point CrsMap::forward(const Point& p) const { return transform(*pairOfThread(ends_).forward, p); }

// For some projections (equal-area ones, by series) PROJ's forward and inverse differ by a tenth of a millimetre, so
// that points that make the round trip would shift against others. We subtract the error of a second round trip.
Point CrsMap::inverse(const Point& p) const {
  const Pair& pair = pairOfThread(ends_);
  const auto size = [](const Point& q) { return std::max(std::abs(q.x), std::abs(q.y)); };
  const auto miss = [&](const Point& image) { return std::hypot(image.x - p.x, image.y - p.y); };
  const Point first = transform(*pair.inverse, p);
  const Point image = transform(*pair.forward, first);
  constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
  if (!(miss(image) > kRounding * size(p))) return first;
  const Point again = transform(*pair.inverse, image);
  const Point step{again.x - first.x, again.y - first.y};
  constexpr double kSmall = 1e-6;  // relative; a larger step is a full turn of longitude, or NaN
  if (!(size(step) <= kSmall * size(first))) return first;
  const Point better{first.x - step.x, first.y - step.y};
  return miss(transform(*pair.forward, better)) < miss(image) ? better : first;
}

void CrsMap::forward(std::span<double> x, std::span<double> y) const {
  std::vector<int> ok(x.size());
  pairOfThread(ends_).forward->Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr, nullptr, ok.data());
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!ok[i]) x[i] = y[i] = std::numeric_limits<double>::quiet_NaN();
}

std::shared_ptr<const CrsMap> mapToGeographic(const Crs& crs) {
  struct Entry {
    std::string authority, wkt;
    std::shared_ptr<const CrsMap> map;
  };
  thread_local LastFour<Entry> kept;
  const auto isOfCrs = [&](const Entry& entry) { return entry.authority == crs.authority && entry.wkt == crs.wkt; };
  if (const Entry* const known = kept.find(isOfCrs)) return known->map;
  return kept.add({crs.authority, crs.wkt, std::make_shared<const CrsMap>(toOgr(crs), geographicBase(crs))}).map;
}

OGRSpatialReference geographicBase(const Crs& crs) {
  const OGRSpatialReference srs = toOgr(crs);
  const OgrErrors kept_from_the_user;
  const std::unique_ptr<OGRSpatialReference> base(srs.CloneGeogCS());
  if (!base) throw InputError("the CRS " + nameOf(crs) + " has no longitudes and latitudes");
  OGRSpatialReference result(*base);
  // Degrees, even if the base of the projected CRS uses another unit (grads, for some French ones).
  result.SetAngularUnits(SRS_UA_DEGREE, CPLAtof(SRS_UA_DEGREE_CONV));
  result.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return result;
}

}  // namespace coastmesh
