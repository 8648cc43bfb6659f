#include "gis/format/poly_io.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>

#include "gis/coast/segment_tags.hpp"
#include "gis/error.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/hole_points.hpp"

namespace coastmesh {

namespace {

constexpr char kComment = '#';

struct VertexHeader {
  std::uint64_t count, attributes;
  bool markers;
};

VertexHeader readVertexHeader(TextReader& file) {
  file.needLine();
  VertexHeader header{file.count(), 0, false};
  // A bare 0 means "see the .node file".
  const std::uint64_t dimensions = file.hasWord() ? file.count() : 2;
  if (dimensions != 2) file.fail("vertices must have 2 dimensions, not " + std::to_string(dimensions));
  header.attributes = file.hasWord() ? file.count() : 0;
  header.markers = file.hasWord() && file.count() > 0;
  return header;
}

Point readPlace(TextReader& file) {
  const double x = file.number(), y = file.number();
  const Point place{x, y};
  if (!isInRange(place)) file.fail("the coordinates lie beyond -1e70 to 1e70, where lengths can be computed");
  return place;
}

IdMap readVertices(TextReader& file, const VertexHeader& header, Pslg& pslg) {
  std::vector<std::int64_t> ids;
  for (std::uint64_t i = 0; i < header.count; ++i) {
    file.needLine();
    ids.push_back(file.integer());
    pslg.points.push_back(readPlace(file));
  }
  return IdMap(std::move(ids), file, "vertex");
}

IdMap readNodeFile(const std::string& poly_path, Pslg& pslg, std::uint64_t& attributes) {
  const std::string path = std::filesystem::path(poly_path).replace_extension(".node").string();
  if (!std::filesystem::exists(path)) {
    throw InputError("'" + poly_path + "' says that its vertices are in '" + path + "', which does not exist");
  }
  TextReader file(path, kComment);
  const VertexHeader header = readVertexHeader(file);
  attributes = header.attributes;
  return readVertices(file, header, pslg);
}

VertexId readEnd(TextReader& file, const IdMap& vertices) {
  const std::int64_t id = file.integer();
  const VertexId v = vertices.indexOf(id);
  if (v == kNone) file.fail("there is no vertex " + std::to_string(id));
  return v;
}

void readSegments(TextReader& file, const IdMap& vertices, Pslg& pslg) {
  file.needLine();
  const std::uint64_t count = file.count();
  const bool markers = file.hasWord() && file.count() > 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    Segment segment;
    segment.a = readEnd(file, vertices);
    segment.b = readEnd(file, vertices);
    if (markers && file.hasWord()) {
      const std::int64_t tag = file.integer();
      if (tag < std::numeric_limits<std::int32_t>::min() || tag > std::numeric_limits<std::int32_t>::max()) {
        file.fail("the marker " + std::to_string(tag) + " is too large");
      }
      segment.tag = static_cast<std::int32_t>(tag);
    }
    pslg.segments.push_back(segment);
  }
}

// False at the end of the file.
bool readHoles(TextReader& file, Pslg& pslg) {
  if (!file.nextLine()) return false;  // Triangle requires the count, other programs omit it
  const std::uint64_t count = file.count();
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    pslg.holes.push_back(readPlace(file));
  }
  return true;
}

bool isOfUser(std::int32_t marker) { return marker != 0 && marker != 1 && !isOpenTag(marker) && !isLineTag(marker); }

}  // namespace

Pslg readPoly(const std::string& path, PolyExtras* ignored) {
  Pslg pslg;
  TextReader file(path, kComment);
  const VertexHeader header = readVertexHeader(file);
  std::uint64_t attributes = header.attributes;
  const IdMap vertices = header.count == 0 ? readNodeFile(path, pslg, attributes) : readVertices(file, header, pslg);
  readSegments(file, vertices, pslg);
  const bool goes_on = readHoles(file, pslg);
  if (ignored == nullptr) return pslg;
  ignored->attributes = attributes > 0;
  ignored->markers = std::ranges::any_of(pslg.segments, isOfUser, &Segment::tag);
  ignored->regions = goes_on && file.nextLine() ? file.count() : 0;
  return pslg;
}

std::string textOf(const PolyExtras& extras) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (extras.regions > 0)
    add(std::to_string(extras.regions) +
        forCount(extras.regions, " region with its attribute and limit of areas",
                 " regions with their attributes and limits of areas") +
        " (--size-max limits sizes)");
  if (extras.attributes) add("attributes of points");
  if (extras.markers) add("markers of segments, which name no types of boundaries here");
  return text;
}

void writePoly(const Pslg& pslg, const std::string& path) {
  TextWriter file(path);
  file << pslg.points.size() << " 2 0 0\n";
  for (std::size_t i = 0; i < pslg.points.size(); ++i) {
    file << i + 1 << ' ' << pslg.points[i].x << ' ' << pslg.points[i].y << '\n';
  }
  file << pslg.segments.size() << " 1\n";
  for (std::size_t i = 0; i < pslg.segments.size(); ++i) {
    const Segment& s = pslg.segments[i];
    file << i + 1 << ' ' << s.a + 1 << ' ' << s.b + 1 << ' ' << s.tag << '\n';
  }
  std::vector<Point> holes = pslg.holes;
  const std::vector<Point> unlabelled = holePoints(pslg);
  holes.insert(holes.end(), unlabelled.begin(), unlabelled.end());
  file << holes.size() << '\n';
  for (std::size_t i = 0; i < holes.size(); ++i) file << i + 1 << ' ' << holes[i].x << ' ' << holes[i].y << '\n';
  file.close();
}

}  // namespace coastmesh
