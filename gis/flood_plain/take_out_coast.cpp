#include "gis/flood_plain/take_out_coast.hpp"

#include <vector>

#include "core/pslg.hpp"
#include "gis/coast/segment_tags.hpp"

namespace coastmesh {

void takeOutCoast(Domain& domain) {
  Pslg& pslg = domain.pslg;
  const auto isCoast = [&](const Segment& s) {
    return isLineTag(s.tag) && domain.lines[lineOfTag(s.tag)].use == FeatureUse::Area;
  };
  std::vector<bool> goes(pslg.points.size(), false);
  for (const Segment& s : pslg.segments) {
    if (!isCoast(s)) continue;
    domain.coast.emplace_back(pslg.points[s.a], pslg.points[s.b]);
    goes[s.a] = goes[s.b] = true;
  }
  if (domain.coast.empty()) return;
  std::erase_if(pslg.segments, isCoast);
  for (const Segment& s : pslg.segments) goes[s.a] = goes[s.b] = false;
  for (const VertexId v : domain.asked) goes[v] = false;
  std::vector<VertexId> number(pslg.points.size(), 0);
  VertexId kept = 0;
  for (VertexId v = 0; v < goes.size(); ++v) {
    if (goes[v]) continue;
    number[v] = kept;
    pslg.points[kept] = pslg.points[v];
    domain.input_points[kept] = domain.input_points[v];
    ++kept;
  }
  pslg.points.resize(kept);
  domain.input_points.resize(kept);
  for (Segment& s : pslg.segments) s.a = number[s.a], s.b = number[s.b];
  for (VertexId& v : domain.asked) v = number[v];
}

}  // namespace coastmesh
