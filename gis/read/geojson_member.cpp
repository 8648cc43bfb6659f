#include "gis/read/geojson_member.hpp"

#include <exception>
#include <nlohmann/json.hpp>
#include <utility>

#include "gis/read/file_bytes.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::json;

// Ends the parsing of a file.
struct Found : std::exception {
  explicit Found(Json found) : member(std::move(found)) {}

  Json member;
};

}  // namespace

std::optional<std::string> geojsonMember(const std::string& path, const std::string& name) {
  bool is_it = false;
  const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key && depth == 1) is_it = parsed == name;
    const bool at_end = event == Event::value || event == Event::object_end || event == Event::array_end;
    if (is_it && depth == 1 && at_end) throw Found(std::move(parsed));
    return is_it || depth == 0;
  };
  constexpr std::uintmax_t kBlock = std::uintmax_t{1} << 16;
  FileBytes file(path, kBlock);
  try {
    [[maybe_unused]] const Json rest = Json::parse(ByteIterator(&file), ByteIterator(nullptr), keep, false);
  } catch (const Found& found) {
    return found.member.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return std::nullopt;
}

bool isBareGeometry(const std::string& path) {
  const std::optional<std::string> type = geojsonMember(path, "type");
  return type && *type != R"("Feature")" && *type != R"("FeatureCollection")";
}

}  // namespace coastmesh
