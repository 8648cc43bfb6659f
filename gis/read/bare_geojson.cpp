#include "gis/read/bare_geojson.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/pslg.hpp"
#include "gis/read/file_bytes.hpp"
#include "gis/read/plain_json.hpp"

namespace coastmesh {

namespace {

// Nested arrays of positions, built from a stream. Level 1 is the outermost array; a MultiPolygon's positions are at
// level 4.
class Coordinates {
 public:
  static constexpr std::size_t kDeepest = 4;

  // `open` and `close` return false if no geometry has such arrays.
  bool open() { return position_.empty() && ++level_ <= kDeepest; }
  void add(double number) { position_.push_back(number); }
  bool close() {
    if (!position_.empty()) {
      if (position_.size() < 2 || (position_level_ != 0 && position_level_ != level_)) return false;
      position_level_ = level_;
      points_.push_back({position_[0], position_[1]});
      position_.clear();
    } else {
      ends_[level_].push_back(level_ + 1 == position_level_ ? points_.size() : ends_[level_ + 1].size());
    }
    --level_;
    return true;
  }
  bool done() const { return level_ == 0; }

  std::size_t positionLevel() const { return position_level_; }
  const std::vector<Point>& points() const { return points_; }
  // The ends of the arrays of a level, as numbers of arrays (or points) of the next.
  const std::vector<std::size_t>& ends(std::size_t level) const { return ends_[level]; }

 private:
  std::size_t level_ = 0, position_level_ = 0;
  std::vector<double> position_;
  std::vector<Point> points_;
  std::array<std::vector<std::size_t>, kDeepest + 2> ends_;
};

// Builds geometries from the events of a JSON parser; a method returns false to stop the parser.
class GeometryHandler final : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return scalar(); }
  bool boolean(bool) override { return scalar(); }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool binary(binary_t&) override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

  bool string(string_t& value) override {
    if (skipped_ > 0) return true;
    if (frames_.empty() || in_coordinates_) return false;
    if (key_ == "type") {
      if (levelOf(value) == kUnknown) return false;
      frames_.back().type = value;
    }
    return true;
  }

  bool key(string_t& value) override {
    if (skipped_ > 0) return true;
    key_ = value;
    // Keys of other kinds of JSON, or of a CRS in the file.
    for (const std::string_view other :
         {"features", "geometry", "properties", "crs", "objects", "arcs", "rings", "paths"}) {
      if (key_ == other) return false;
    }
    return true;
  }

  bool start_object(std::size_t) override {
    if (skipped_ > 0) return ++skipped_ > 0;
    if (in_coordinates_) return false;
    if (!frames_.empty() && !in_geometries_) return ++skipped_ > 0;
    if (frames_.size() == 2) return false;  // a collection of collections
    frames_.emplace_back();
    return true;
  }

  bool end_object() override {
    if (skipped_ > 0) return --skipped_, true;
    const bool taken = take(frames_.back());
    frames_.pop_back();
    complete_ = frames_.empty();
    return taken;
  }

  bool start_array(std::size_t) override {
    if (skipped_ > 0) return ++skipped_ > 0;
    if (in_coordinates_) return frames_.back().coordinates.open();
    if (frames_.empty()) return false;
    if (key_ == "coordinates") {
      in_coordinates_ = true;
      return frames_.back().coordinates.open();
    }
    if (key_ == "geometries") return in_geometries_ = frames_.size() == 1;
    return ++skipped_ > 0;
  }

  bool end_array() override {
    if (skipped_ > 0) return --skipped_, true;
    if (in_coordinates_) {
      Coordinates& coordinates = frames_.back().coordinates;
      if (!coordinates.close()) return false;
      in_coordinates_ = !coordinates.done();
      return true;
    }
    in_geometries_ = false;
    return true;
  }

  std::optional<GeometryParts> result() && {
    if (!complete_) return std::nullopt;
    return std::move(parts_);
  }

 private:
  struct Frame {
    std::string type;
    Coordinates coordinates;
  };
  static constexpr std::size_t kUnknown = 99;

  // The level of positions in a geometry of this type.
  static std::size_t levelOf(std::string_view type) {
    if (type == "GeometryCollection") return 0;
    if (type == "Point") return 1;
    if (type == "LineString" || type == "MultiPoint") return 2;
    if (type == "Polygon" || type == "MultiLineString") return 3;
    return type == "MultiPolygon" ? 4 : kUnknown;
  }

  bool scalar() const { return !in_coordinates_ && !frames_.empty(); }
  bool number(double value) {
    if (skipped_ > 0 || !in_coordinates_) return scalar();
    if (std::abs(value) > kLargestCoordinate) return false;
    frames_.back().coordinates.add(value);
    return true;
  }

  bool take(const Frame& frame) {
    const Coordinates& coordinates = frame.coordinates;
    const std::size_t level = levelOf(frame.type);
    if (level == kUnknown || (coordinates.positionLevel() != 0 && coordinates.positionLevel() != level)) return false;
    const bool has_empty_position = level > 0 && !coordinates.ends(level).empty();
    if (has_empty_position) return false;
    parts_.coordinates += level > 1 ? coordinates.points().size() : 0;
    if (frame.type == "Polygon") {
      takePolygon(coordinates, 0, coordinates.ends(2).size(), 2);
    } else if (frame.type == "MultiPolygon") {
      std::size_t first = 0;
      for (const std::size_t last : coordinates.ends(2)) {
        takePolygon(coordinates, first, last, 3);
        first = last;
      }
    } else if (frame.type == "LineString") {
      if (!coordinates.points().empty()) parts_.lines.push_back(coordinates.points());
    } else if (frame.type == "MultiLineString") {
      for (std::size_t i = 0; i < coordinates.ends(2).size(); ++i) {
        parts_.lines.push_back(chain(coordinates, coordinates.ends(2), i));
        if (parts_.lines.back().empty()) parts_.lines.pop_back();
      }
    } else if (frame.type != "GeometryCollection") {
      parts_.points.insert(parts_.points.end(), coordinates.points().begin(), coordinates.points().end());
    }
    return true;
  }

  // Adds a polygon of the rings [first, last), which are arrays of `level`.
  void takePolygon(const Coordinates& coordinates, std::size_t first, std::size_t last, std::size_t level) {
    Polygon polygon;
    for (std::size_t r = first; r < last; ++r) {
      Ring ring = chain(coordinates, coordinates.ends(level), r);
      if (ring.empty()) continue;
      closeRing(ring, parts_);
      if (r == first) {
        polygon.outer = std::move(ring);
      } else {
        polygon.holes.push_back(std::move(ring));
      }
    }
    if (!polygon.outer.empty() || !polygon.holes.empty()) parts_.polygons.push_back(std::move(polygon));
  }

  static std::vector<Point> chain(const Coordinates& coordinates, const std::vector<std::size_t>& ends, std::size_t i) {
    const auto begin = coordinates.points().begin();
    return {begin + static_cast<std::ptrdiff_t>(i == 0 ? 0 : ends[i - 1]),
            begin + static_cast<std::ptrdiff_t>(ends[i])};
  }

  std::vector<Frame> frames_;  // open geometries: the file's, then a member of its collection
  std::string key_;
  std::size_t skipped_ = 0;  // depth within a skipped value
  bool in_coordinates_ = false, in_geometries_ = false, complete_ = false;
  GeometryParts parts_;
};

}  // namespace

std::optional<GeometryParts> readBareGeojson(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;  // a pipe can be read only once
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  {
    FileBytes file(path, size);
    GeometryHandler handler;
    const PlainJson read = PlainJsonReader(file, handler).read();
    if (read == PlainJson::Read) return std::move(handler).result();
    if (read == PlainJson::Refused) return std::nullopt;
  }
  FileBytes file(path, size);
  GeometryHandler handler;
  if (!nlohmann::json::sax_parse(ByteIterator(&file), ByteIterator(nullptr), &handler)) return std::nullopt;
  return std::move(handler).result();
}

}  // namespace coastmesh
