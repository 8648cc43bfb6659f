#include "gis/format/poly_io.hpp"

#include <filesystem>
#include <limits>

#include "gis/error.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
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

IdMap readNodeFile(const std::string& poly_path, Pslg& pslg) {
  const std::string path = std::filesystem::path(poly_path).replace_extension(".node").string();
  if (!std::filesystem::exists(path)) {
    throw InputError("'" + poly_path + "' says that its vertices are in '" + path + "', which does not exist");
  }
  TextReader file(path, kComment);
  return readVertices(file, readVertexHeader(file), pslg);
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

void readHoles(TextReader& file, Pslg& pslg) {
  if (!file.nextLine()) return;  // Triangle requires the count, other programs omit it
  const std::uint64_t count = file.count();
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    pslg.holes.push_back(readPlace(file));
  }
}

}  // namespace

Pslg readPoly(const std::string& path) {
  Pslg pslg;
  TextReader file(path, kComment);
  const VertexHeader header = readVertexHeader(file);
  const IdMap vertices = header.count == 0 ? readNodeFile(path, pslg) : readVertices(file, header, pslg);
  readSegments(file, vertices, pslg);
  readHoles(file, pslg);
  return pslg;
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
