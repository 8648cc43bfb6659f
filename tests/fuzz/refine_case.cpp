#include "tests/fuzz/refine_case.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/quality.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/fuzz/unexpected_defects.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_figures.hpp"

namespace coastmesh {

namespace {

// A broken rule.
struct Broken {
  std::string failure, detail;
};

std::string_view toString(PslgDefect::Kind kind) {
  switch (kind) {
    case PslgDefect::Kind::NotFinite:
      return "not finite";
    case PslgDefect::Kind::OutOfRange:
      return "out of range";
    case PslgDefect::Kind::PointsCoincide:
      return "points coincide";
    case PslgDefect::Kind::SegmentOfNoLength:
      return "segment of no length";
    case PslgDefect::Kind::UnknownVertex:
      return "unknown vertex";
    case PslgDefect::Kind::SegmentsCross:
      return "segments cross";
    case PslgDefect::Kind::SegmentsCoincide:
      return "segments coincide";
    case PslgDefect::Kind::PointOnSegment:
      return "point on segment";
    case PslgDefect::Kind::LabelsContradict:
      return "labels contradict";
    case PslgDefect::Kind::NoArea:
      return "no area";
  }
  return "";
}

// Rounding of coordinates moves a border along its whole length; areas may differ by that much.
double areaRoom(const TriMesh& mesh) {
  double magnitude = 0.0, low_x = mesh.points[0].x, high_x = low_x, low_y = mesh.points[0].y, high_y = low_y;
  for (const Point& p : mesh.points) {
    magnitude = std::max({magnitude, std::abs(p.x), std::abs(p.y)});
    low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
    low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
  }
  const double extent = high_x - low_x + high_y - low_y;
  return 4.0 * std::numeric_limits<double>::epsilon() * magnitude * extent *
         std::sqrt(static_cast<double>(mesh.points.size()));
}

void judge(const std::string& stage, const TriMesh& mesh, const TriMesh& coarse, const RefineCase& c,
           const std::vector<BoundViolation>& unresolved) {
  const auto defects = unexpectedDefects(mesh, c.pslg, c.options, unresolved);
  if (!defects.empty()) {
    std::string detail;
    for (std::size_t i = 0; i < std::min<std::size_t>(5, defects.size()); ++i) detail += describe(defects[i]) + "\n";
    throw Broken{stage + ": " + std::string(toString(defects.front().kind)), detail};
  }
  if (mesh.regions.size() != mesh.triangles.size()) throw Broken{stage + ": regions are not one a triangle", {}};
  if (mesh.input_vertices != c.pslg.points.size()) throw Broken{stage + ": count of input vertices changed", {}};
  const auto before = areasByRegion(coarse), after = areasByRegion(mesh);
  const double room = areaRoom(coarse);
  for (const auto& [region, area] : before) {
    const auto found = after.find(region);
    if (found == after.end() || std::abs(found->second - area) > 1e-9 * area + room)
      throw Broken{stage + ": area of a region changed", "region " + std::to_string(region)};
  }
  if (after.size() != before.size()) throw Broken{stage + ": a region appeared", {}};
}

// Exactly the bound violations without an excuse must be listed.
void judgeListed(const std::string& stage, const TriMesh& mesh, const RefineCase& c,
                 const std::vector<BoundViolation>& unresolved) {
  const std::string wrong = wrongBoundViolations(mesh, c.pslg, c.options, unresolved);
  if (!wrong.empty()) throw Broken{stage + ": wrong bound violations", wrong};
}

// The number of vertices that the input needs at an angle that every method reaches; nullopt if that exceeds the limit.
// Any mesh whose vertices keep a fixed share of the input's spacing apart has at most a fixed multiple of them.
std::optional<std::uint64_t> neededAtLeast(const RefineCase& c, std::uint64_t limit) {
  RefineOptions modest;
  modest.min_angle_deg = 20.0;
  modest.size_max = c.options.size_max;
  modest.algorithm = Algorithm::Optimal;
  modest.max_vertices = limit;
  TriMesh mesh = constrainedDelaunay(c.pslg);
  const RefineStats stats = refine(mesh, c.pslg, modest);
  if (stats.budget_reached) return std::nullopt;
  return mesh.points.size();
}

struct Meshed {
  TriMesh mesh;
  RefineStats refined, coarsened;
};

void checkCounts(const RefineCase& c, const RefineOptions& options, const TriMesh& mesh, const RefineStats& stats) {
  if (stats.steiner_points != mesh.points.size() - c.pslg.points.size())
    throw Broken{"refine: steiner_points is not vertices out minus vertices in", {}};
  if (mesh.points.size() > std::max<std::uint64_t>(options.max_vertices, c.pslg.points.size()))
    throw Broken{"refine: more vertices than the budget allows", std::to_string(mesh.points.size())};
}

std::size_t countBad(const TriMesh& mesh, const RefineOptions& options) {
  const TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max);
  return static_cast<std::size_t>(std::ranges::count_if(mesh.triangles, [&](const Triangle& t) {
    return isBad(mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]], bound);
  }));
}

Meshed meshAndJudge(const RefineCase& c, const TriMesh& coarse, const CaseLimits& limits) {
  Meshed meshed;
  RefineOptions options = c.options;
  options.max_vertices = std::min<std::uint64_t>(options.max_vertices, limits.most_vertices);
  meshed.mesh = coarse;
  meshed.refined = refine(meshed.mesh, c.pslg, options);
  checkCounts(c, options, meshed.mesh, meshed.refined);
  judge("refine", meshed.mesh, coarse, c, meshed.refined.unresolved);
  judgeListed("refine", meshed.mesh, c, meshed.refined.unresolved);
  if (!c.coarsen) return meshed;
  const std::size_t before = meshed.mesh.points.size();
  const std::size_t bad = countBad(meshed.mesh, options);
  meshed.coarsened = coarsen(meshed.mesh, c.pslg, options);
  judge("coarsen", meshed.mesh, coarse, c, meshed.coarsened.unresolved);
  judgeListed("coarsen", meshed.mesh, c, meshed.coarsened.unresolved);
  if (meshed.mesh.points.size() > before)
    throw Broken{"coarsen: more vertices than before",
                 std::to_string(before) + " before, " + std::to_string(meshed.mesh.points.size()) + " after"};
  // A flip beside a bad triangle may turn it into two, but good triangles stay good.
  if (meshed.coarsened.unresolved.size() > 2 * bad)
    throw Broken{"coarsen: more bound violations than before", std::to_string(bad) + " bad triangles before, " +
                                                                   std::to_string(meshed.coarsened.unresolved.size()) +
                                                                   " after"};
  return meshed;
}

CaseResult judgeCase(const RefineCase& c, const TriMesh& coarse, const CaseLimits& limits) {
  RefineCase plain = c;
  plain.options = {.min_angle_deg = 0.0};
  judge("triangulate", coarse, coarse, plain, {});
  const Meshed meshed = meshAndJudge(c, coarse, limits);
  if (limits.repeat) {
    const Meshed again = meshAndJudge(c, constrainedDelaunay(c.pslg), limits);
    if (digestOf(again.mesh) != digestOf(meshed.mesh)) throw Broken{"another mesh the second time", {}};
  }
  CaseResult result;
  result.vertices = meshed.mesh.points.size();
  if (!meshed.refined.budget_reached || c.options.max_vertices <= limits.most_vertices) return result;
  result.verdict = Verdict::TooLarge;
  constexpr std::uint64_t kMostTimes = 100, kRoom = 1000;
  if (limits.most_vertices <= kRoom) return result;
  const auto needed = neededAtLeast(c, limits.most_vertices);
  if (needed && kRoom + kMostTimes * *needed < limits.most_vertices)
    throw Broken{
        "refine: more vertices than the input explains",
        std::to_string(*needed) + " at 20 degrees, more than " + std::to_string(limits.most_vertices) + " here"};
  return result;
}

}  // namespace

CaseResult runCase(const RefineCase& refine_case, const CaseLimits& limits) {
  CaseResult result;
  try {
    TriMesh coarse;
    try {
      coarse = constrainedDelaunay(refine_case.pslg);
    } catch (const BadPslg& e) {
      result.verdict = Verdict::Refused;
      result.failure = toString(e.defect.kind);
      return result;
    }
    result = judgeCase(refine_case, coarse, limits);
  } catch (const Broken& broken) {
    result.verdict = Verdict::Failed;
    result.failure = broken.failure;
    result.detail = broken.detail;
  } catch (const std::exception& e) {
    result.verdict = Verdict::Failed;
    result.failure = std::string("exception: ") + e.what();
  }
  return result;
}

std::string_view nameOf(Algorithm algorithm) {
  switch (algorithm) {
    case Algorithm::Circumcenter:
      return "circumcenter";
    case Algorithm::Offcenter:
      return "offcenter";
    case Algorithm::Optimal:
      return "optimal";
    case Algorithm::Relocate:
      return "relocate";
  }
  return "";
}

}  // namespace coastmesh
