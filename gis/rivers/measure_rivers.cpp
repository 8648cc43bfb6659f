#include "gis/rivers/measure_rivers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "gis/error.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/places.hpp"
#include "gis/rivers/river_plane.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// Places at which a line is measured to find its usual width.
constexpr std::size_t kFirstPlaces = 64;
constexpr double kStep = 0.25;  // between stations, of the usual width
constexpr double kMostStations = 1e6;
constexpr std::size_t kMedianArm = 6, kEndArm = 2, kMeanArm = 2;  // stations before and after
// How fast each bank may leave the line.
constexpr double kSlope = 0.25;
// A bank this many times as far as it may be is that of other water.
constexpr double kOpen = 2.0;
// Widths of a part of a line differ by at most this factor, unless it would be shorter than so many widths.
constexpr double kAlike = 1.5, kShortest = 3.0;
constexpr double kLeastShare = 0.1;  // of the usual width
// How far from a place beside the water its banks are sought, in usual widths.
constexpr double kBeside = 4.0;
// The first reach of a search, as a share of the extent of all banks.
constexpr double kLeastReach = 1e-6;

// Distances from the line to the banks, in plane units; that to the right is negative if the line runs on the left one.
struct ToBanks {
  double left = kNan, right = kNan;

  bool known() const { return !std::isnan(left); }
  double width() const { return left + right; }
};

struct Station {
  Point place;
  Point left;  // unit vector
  ToBanks to;
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Banks in the working plane.
class PlaneBanks {
 public:
  PlaneBanks(const RiverBanks& banks, const RiverPlane& plane) {
    std::vector<Box> boxes;
    for (const auto& [a, b] : banks.edges) {
      const Point p = plane.forward(a), q = plane.forward(b);
      if (!std::isfinite(p.x + p.y + q.x + q.y)) continue;  // far from the lines, which the plane is made for
      edges_.emplace_back(p, q);
      boxes.push_back(Box::of(p, q));
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    const Box all = tree_.bounds();
    most_ = all.empty() ? 0.0 : 2.0 * (all.xmax - all.xmin + all.ymax - all.ymin);
  }

  // A line beside the water, but closer to it than the water is wide, counts as in it. `about`: a length to begin with.
  ToBanks across(const Point& place, const Point& left, double about) const {
    if (!tree_.bounds().grownBy(about).meets(Box::of(place, place))) return {};
    if (!holds(place)) return beside(crossings(place, left, kBeside * about));
    for (double reach = std::max(about, kLeastReach * most_); reach < 2.0 * most_; reach *= 2.0) {
      const std::vector<double> found = crossings(place, left, reach);
      const auto after = std::ranges::lower_bound(found, 0.0);
      if (after != found.begin() && after != found.end()) return {*after, -*std::prev(after)};
    }
    return {};
  }

 private:
  // Even-odd, along a ray.
  bool holds(const Point& p) const {
    bool inside = false;
    tree_.visit({p.x, p.y, tree_.bounds().xmax, p.y}, [&](std::uint32_t i) {
      const auto& [a, b] = edges_[i];
      if ((a.y > p.y) == (b.y > p.y)) return;
      if (p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    });
    return inside;
  }

  // Where the banks cross a line through the place, as distances along it, in their order.
  std::vector<double> crossings(const Point& place, const Point& along, double reach) const {
    std::vector<double> found;
    tree_.visit(Box::of(place + (-reach) * along, place + reach * along), [&](std::uint32_t i) {
      const auto& [a, b] = edges_[i];
      const double from = cross(along, a - place), to = cross(along, b - place);
      if ((from > 0.0) == (to > 0.0)) return;
      const Point at = a + (from / (from - to)) * (b - a);
      const double distance = dot(at - place, along);
      if (std::abs(distance) <= reach) found.push_back(distance);
    });
    std::ranges::sort(found);
    return found;
  }

  static ToBanks beside(const std::vector<double>& found) {
    const auto after = std::ranges::lower_bound(found, 0.0);
    ToBanks nearest;
    double gap = kInfinity;
    if (found.end() - after >= 2 && after[0] < after[1] - after[0]) nearest = {after[1], -after[0]}, gap = after[0];
    if (after - found.begin() >= 2 && -after[-1] < std::min(gap, after[-1] - after[-2]))
      nearest = {after[-1], -after[-2]};
    return nearest;
  }

  std::vector<std::pair<Point, Point>> edges_;
  BoxTree tree_;
  double most_ = 0.0;
};

// A line in the plane, by distances along it.
class PlaneLine {
 public:
  explicit PlaneLine(std::vector<Point> points) : points_(std::move(points)), along_(1, 0.0) {
    for (std::size_t i = 0; i + 1 < points_.size(); ++i)
      along_.push_back(along_.back() + distance(points_[i], points_[i + 1]));
  }

  double length() const { return along_.back(); }

  Point at(double along) const {
    const auto after = std::ranges::upper_bound(along_, along);
    const std::size_t i =
        std::clamp<std::size_t>(static_cast<std::size_t>(after - along_.begin()), 1, points_.size() - 1) - 1;
    const double edge = along_[i + 1] - along_[i];
    return points_[i] + std::clamp((along - along_[i]) / edge, 0.0, 1.0) * (points_[i + 1] - points_[i]);
  }

  // Stations from one end to the other, with directions over `arm` before and after.
  std::vector<Station> stations(std::size_t steps, double arm) const {
    std::vector<Station> all;
    for (std::size_t i = 0; i <= steps; ++i) {
      const double along = length() * static_cast<double>(i) / static_cast<double>(steps);
      const Point forward = at(std::min(along + arm, length())) - at(std::max(along - arm, 0.0));
      const double norm = std::sqrt(squaredLength(forward));
      // Where the line turns back on itself, the direction before it goes on.
      const Point left =
          norm > 0.0 ? Point{-forward.y / norm, forward.x / norm} : (all.empty() ? Point{0.0, 1.0} : all.back().left);
      all.push_back({at(along), left, {}});
    }
    return all;
  }

 private:
  std::vector<Point> points_;
  std::vector<double> along_;
};

class RiverMeasurer {
 public:
  RiverMeasurer(const RiverBanks& banks, const RiverPlane& plane) : plane_(plane), banks_(banks, plane) {}

  MeasuredRivers measure(const RiverLine& line) const {
    MeasuredRivers made;
    const PlaneLine course(inPlane(line));
    if (course.length() == 0.0) {  // reported with all other such lines
      made.lines.push_back(line);
      return made;
    }
    const double given = line.width_m * plane_.scaleAt(course.at(0.0));
    std::vector<Station> stations = measured(course, given);
    const double step = course.length() / static_cast<double>(stations.size() - 1);
    std::vector<std::uint8_t> between(stations.size());  // banks
    for (std::size_t i = 0; i < stations.size(); ++i) between[i] = stations[i].to.known() ? 1 : 0;
    const double scale = plane_.scaleAt(stations.front().place);
    made.length_m = course.length() / scale;
    if (std::ranges::count(between, 1) == 0) {
      if (std::isnan(line.width_m))
        throw InputError(nameOf(line) + " has no width, and no part of it is between banks: near (" +
                         placeInWords(line.points.front()) + "); give it a width, or --width for all without");
      made.without = 1;
      made.lines.push_back(line);
      return made;
    }
    fillUnknown(stations, given);
    smooth(stations);
    limitSlopes(stations, step);
    noteMeasured(stations, between, made);
    addParts(line, stations, step, made.lines);
    return made;
  }

 private:
  std::vector<Point> inPlane(const RiverLine& line) const {
    std::vector<Point> points;
    for (const Point& p : line.points) {
      const Point place = plane_.forward(p);
      if (!std::isfinite(place.x) || !std::isfinite(place.y))
        throw InputError(nameOf(line) + " has a place, (" + placeInWords(p) + "), that cannot be projected");
      if (points.empty() || !(points.back() == place)) points.push_back(place);
    }
    if (points.size() == 1) points.push_back(points.front());
    return points;
  }

  void measureAt(std::vector<Station>& stations, double about) const {
    for (Station& station : stations) station.to = banks_.across(station.place, station.left, about);
  }

  // Stations a share of the usual width apart: of that between banks, else of the given one.
  std::vector<Station> measured(const PlaneLine& course, double given) const {
    const double begin = std::isnan(given) ? course.length() / static_cast<double>(kFirstPlaces) : given;
    std::vector<Station> first = course.stations(kFirstPlaces, 0.5 * begin);
    measureAt(first, begin);
    std::vector<double> widths;
    for (const Station& station : first)
      if (station.to.known()) widths.push_back(station.to.width());
    if (widths.empty() && std::isnan(given)) return first;
    const double usual = widths.empty() ? given : median(widths);
    const double steps = std::clamp(std::ceil(course.length() / (kStep * usual)), 4.0, kMostStations);
    std::vector<Station> stations = course.stations(static_cast<std::size_t>(steps), 0.5 * usual);
    measureAt(stations, usual);
    return stations;
  }

  void noteMeasured(const std::vector<Station>& stations, const std::vector<std::uint8_t>& between,
                    MeasuredRivers& made) const {
    made.measured_m =
        made.length_m * static_cast<double>(std::ranges::count(between, 1)) / static_cast<double>(stations.size());
    made.least_width_m = kInfinity;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      if (between[i] == 0) continue;
      const double width = stations[i].to.width() / plane_.scaleAt(stations[i].place);
      made.least_width_m = std::min(made.least_width_m, width);
      made.most_width_m = std::max(made.most_width_m, width);
    }
  }

  static void fillUnknown(std::vector<Station>& stations, double given) {
    if (!std::isnan(given)) {
      for (Station& station : stations)
        if (!station.to.known()) station.to = {0.5 * given, 0.5 * given};
      return;
    }
    // The width of the nearest station that has one; of two as near, of the one before.
    std::vector<std::size_t> after(stations.size(), stations.size());
    for (std::size_t i = stations.size(); i-- > 0;)
      after[i] = stations[i].to.known() ? i : (i + 1 < stations.size() ? after[i + 1] : stations.size());
    std::optional<std::size_t> before;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      if (after[i] == i) {
        before = i;
        continue;
      }
      const bool from_before = before && (after[i] == stations.size() || i - *before <= after[i] - i);
      const double half = 0.5 * stations[from_before ? *before : after[i]].to.width();
      stations[i].to = {half, half};
    }
  }

  // The median of neighbours leaves out what is short, as mouths of tributaries; their mean has no steps.
  static void smooth(std::vector<Station>& stations) {
    for (double ToBanks::*side : {&ToBanks::left, &ToBanks::right}) {
      std::vector<double> given, some;
      for (const Station& station : stations) given.push_back(station.to.*side);
      const auto take = [&](std::size_t first, std::size_t last) {
        some.assign(given.begin() + static_cast<std::ptrdiff_t>(first),
                    given.begin() + static_cast<std::ptrdiff_t>(last + 1));
      };
      for (std::size_t i = 0; i < given.size(); ++i) {
        // At an end, of as many neighbours as tell the end itself from them.
        const std::size_t arm = std::clamp<std::size_t>(std::min(i, given.size() - 1 - i), kEndArm, kMedianArm);
        take(i - std::min(i, arm), std::min(i + arm, given.size() - 1));
        stations[i].to.*side = median(some);
      }
      for (std::size_t i = 0; i < given.size(); ++i) given[i] = stations[i].to.*side;
      for (std::size_t i = 0; i < given.size(); ++i) {
        const std::size_t arm = std::min({kMeanArm, i, given.size() - 1 - i});  // as many before as after
        take(i - arm, i + arm);
        double sum = 0.0;
        for (const double value : some) sum += value;
        stations[i].to.*side = sum / static_cast<double>(some.size());
      }
    }
  }

  // Banks leave the line gradually. Where one does so much faster, as in the water of another river, the one before it
  // goes on to the one after it.
  static void limitSlopes(std::vector<Station>& stations, double step) {
    for (double ToBanks::*side : {&ToBanks::left, &ToBanks::right}) {
      std::vector<double> gradual;
      for (const Station& station : stations) gradual.push_back(station.to.*side);
      limitSlopes(gradual, step);
      std::optional<std::size_t> before;
      for (std::size_t i = 0; i <= stations.size(); ++i) {
        const bool is_bank = i < stations.size() && stations[i].to.*side <= std::max(kOpen * gradual[i], gradual[i]);
        if (i < stations.size() && !is_bank) continue;
        for (std::size_t k = before ? *before + 1 : 0; k < i; ++k) {
          const double from = gradual[before.value_or(i)], to = is_bank ? gradual[i] : from;
          const double share = before ? static_cast<double>(k - *before) / static_cast<double>(i - *before) : 0.0;
          gradual[k] = std::min(gradual[k], from + share * (to - from));
        }
        before = i;
      }
      limitSlopes(gradual, step);
      for (std::size_t i = 0; i < stations.size(); ++i) stations[i].to.*side = gradual[i];
    }
  }

  static void limitSlopes(std::vector<double>& distances, double step) {
    const auto limit = [&](double& of, double beside) { of = std::min(of, beside + kSlope * step); };
    for (std::size_t i = 1; i < distances.size(); ++i) limit(distances[i], distances[i - 1]);
    for (std::size_t i = distances.size() - 1; i-- > 0;) limit(distances[i], distances[i + 1]);
  }

  // The line in the middle of its banks, in parts of alike widths.
  void addParts(const RiverLine& line, const std::vector<Station>& stations, double step,
                std::vector<RiverLine>& parts) const {
    std::vector<double> widths;
    for (const Station& station : stations) widths.push_back(station.to.width());
    std::vector<double> sorted = widths;
    const double least = kLeastShare * median(sorted);
    std::vector<Point> points;
    for (std::size_t i = 0; i < stations.size(); ++i) {
      widths[i] = std::max(widths[i], least);
      const ToBanks& to = stations[i].to;
      points.push_back(stations[i].place + 0.5 * (to.left - to.right) * stations[i].left);
    }
    std::size_t first = 0;
    double low = widths[0], high = widths[0];
    for (std::size_t i = 1; i < points.size(); ++i) {
      low = std::min(low, widths[i]), high = std::max(high, widths[i]);
      const auto stepsOf = [&](double width) { return kShortest * width / step; };
      const bool is_last = i + 1 == points.size();
      const bool ends = high > kAlike * low && static_cast<double>(i - first) >= stepsOf(high) &&
                        static_cast<double>(points.size() - 1 - i) >= stepsOf(high);
      if (!ends && !is_last) continue;
      parts.push_back(part(line, points, widths, first, i));
      first = i;
      low = high = widths[i];
    }
  }

  RiverLine part(const RiverLine& line, const std::vector<Point>& points, const std::vector<double>& widths,
                 std::size_t first, std::size_t last) const {
    RiverLine made = line;
    made.points.clear();
    for (std::size_t i = first; i <= last; ++i) {
      made.points.push_back(plane_.inverse(points[i]));
      made.widths_m.push_back(widths[i] / plane_.scaleAt(points[i]));
    }
    std::vector<double> some = made.widths_m;
    made.width_m = median(some);
    return made;
  }

  const RiverPlane& plane_;
  const PlaneBanks banks_;
};

}  // namespace

MeasuredRivers measureRivers(std::vector<RiverLine> lines, const RiverBanks& banks, const Crs& crs,
                             const ItemLoop& loop) {
  const RiverPlane plane(lines, crs);
  const RiverMeasurer measurer(banks, plane);
  std::vector<MeasuredRivers> of_lines(lines.size());
  forEachByStretches(loop, lines.size(), [&](std::size_t i) { of_lines[i] = measurer.measure(lines[i]); });
  MeasuredRivers all;
  for (MeasuredRivers& made : of_lines) {
    std::ranges::move(made.lines, std::back_inserter(all.lines));
    all.length_m += made.length_m;
    all.measured_m += made.measured_m;
    all.without += made.without;
    if (made.measured_m == 0.0) continue;
    all.least_width_m = all.most_width_m == 0.0 ? made.least_width_m : std::min(all.least_width_m, made.least_width_m);
    all.most_width_m = std::max(all.most_width_m, made.most_width_m);
  }
  return all;
}

}  // namespace coastmesh
