#include "apps/job/group_bytes.hpp"

#include "apps/job/bytes.hpp"

namespace coastmesh {

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& seconds) requires std::is_same_v<std::remove_cvref_t<decltype(seconds)>, MeshSeconds> {
  auto& [triangulate, refine, coarsen, optimise, stitch] = seconds;
  return std::tie(triangulate, refine, coarsen, optimise, stitch);
}
auto partsOf(auto& water) requires std::is_same_v<std::remove_cvref_t<decltype(water)>, NotedWater> {
  auto& [area_m2, before, after] = water;
  return std::tie(area_m2, before, after);
}
auto partsOf(auto& waters) requires std::is_same_v<std::remove_cvref_t<decltype(waters)>, NotedWaters> {
  auto& [count, area_m2, largest] = waters;
  return std::tie(count, area_m2, largest);
}
auto partsOf(auto& item) requires std::is_same_v<std::remove_cvref_t<decltype(item)>, NotedLength> {
  auto& [length_m, text] = item;
  return std::tie(length_m, text);
}
auto partsOf(auto& items) requires std::is_same_v<std::remove_cvref_t<decltype(items)>, NotedLengths> {
  auto& [count, longest] = items;
  return std::tie(count, longest);
}
auto partsOf(auto& waters) requires std::is_same_v<std::remove_cvref_t<decltype(waters)>, FollowedWaters> {
  auto& [area_m2, cut_off, apart, joined, too_small, islands, straits, spits, met, with_apart, closed_m2,
         cut_off_by_way, cut_off_widens, apart_widens, none_kept_open, in_plane] = waters;
  return std::tie(area_m2, cut_off, apart, joined, too_small, islands, straits, spits, met, with_apart, closed_m2,
                  cut_off_by_way, cut_off_widens, apart_widens, none_kept_open, in_plane);
}
auto partsOf(auto& raised) requires std::is_same_v<std::remove_cvref_t<decltype(raised)>, RaisedShore> {
  auto& [length_m, raised_m, most_m] = raised;
  return std::tie(length_m, raised_m, most_m);
}
// All members but the log.
auto partsOf(auto& result) requires std::is_same_v<std::remove_cvref_t<decltype(result)>, GroupResult> {
  auto& [grid, edits, edit_places, projection, projection_reason, surface, least_scale, greatest_scale, refine,
         short_of, quality, size_max, input_area_m2, digest, clean_s, size_s, check_s, mesh_s, pieces, log,
         estimated_vertices, refusal, over_budget, lacks_memory, refusal_place, unwanted, notes, warnings, idle,
         took_part, waters, raised_shore, asked] = result;
  return std::tie(grid, edits, edit_places, projection, projection_reason, surface, least_scale, greatest_scale, refine,
                  short_of, quality, input_area_m2, digest, clean_s, size_s, check_s, mesh_s, pieces,
                  estimated_vertices, refusal, over_budget, lacks_memory, refusal_place, unwanted, notes, warnings,
                  size_max, idle, took_part, waters, raised_shore, asked);
}

namespace {

void passGroup(auto& writer, const GroupResult& result) {
  writer.pass(result);
  writer.pass(result.log.work());
}

}  // namespace

std::string bytesOf(const GroupResult& result) {
  ByteWriter writer;
  passGroup(writer, result);
  return writer.take();
}

void putBytesOf(const GroupResult& result, const std::function<void(std::string_view)>& put) {
  BasicByteWriter<PutSink> writer({&put});
  passGroup(writer, result);
}

GroupResult groupFrom(std::string_view bytes, const std::string& what) {
  ByteReader reader(bytes, what);
  GroupResult result;
  reader.pass(result);
  double work = 0.0;
  reader.pass(work);
  if (!reader.atEnd()) throw InputError(what + " is damaged");
  result.log.addAlone("regions", work);
  return result;
}

}  // namespace coastmesh
