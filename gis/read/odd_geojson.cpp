#include "gis/read/odd_geojson.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/read/file_bytes.hpp"

namespace coastmesh {

namespace {

struct GeometryType {
  std::string_view name;
  std::size_t level;  // nesting depth of its positions, the position's own array included
};

constexpr std::string_view kCollection = "GeometryCollection";
constexpr std::array<GeometryType, 6> kTypes = {
    {{"Point", 1}, {"LineString", 2}, {"MultiPoint", 2}, {"Polygon", 3}, {"MultiLineString", 3}, {"MultiPolygon", 4}}};

// Ignores case, as OGR does.
bool isSame(std::string_view a, std::string_view b) {
  return std::ranges::equal(a, b, [](char x, char y) {
    return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
  });
}

// An array of coordinates that is empty or has values in it: usually a position.
struct Innermost {
  std::vector<std::size_t> path;  // its index, from 0, in each enclosing array
  std::string text;
  bool empty = false;
  bool odd = false;  // fewer than two values, or something that is not a number

  std::size_t level() const { return path.size() + 1; }
};

// The arrays of one geometry's coordinates, from a stream. They are judged at its end, because the type may come last.
class CoordinateArrays {
 public:
  void open() {
    if (!arrays_.empty()) ++arrays_.back().arrays;
    arrays_.emplace_back();
  }
  // REQUIRES, for `add` too: an array is open.
  void close() {
    const Array& array = arrays_.back();
    if (array.values > 0 || array.arrays == 0) note(array);
    arrays_.pop_back();
  }
  void add(const std::string& text, bool number) {
    constexpr std::size_t kShown = 60;
    Array& array = arrays_.back();
    if (array.text.size() < kShown) array.text += (array.text.empty() ? "" : ", ") + text;
    array.odd = array.odd || !number;
    ++array.values;
  }
  bool isOpen() const { return !arrays_.empty(); }

  // The first that is not a position at `level`, or null. Empty arrays further out are valid: empty rings, geometries.
  const Innermost* firstOdd(std::size_t level) const {
    const auto at = std::ranges::find_if(found_, [level](const Innermost& found) {
      return found.empty ? found.level() >= std::max<std::size_t>(level, 2) : found.odd || found.level() != level;
    });
    return at == found_.end() ? nullptr : &*at;
  }

 private:
  struct Array {
    std::size_t arrays = 0, values = 0;  // in it
    bool odd = false;                    // a value is not a number
    std::string text;                    // of its values
  };

  void note(const Array& array) {
    constexpr std::size_t kMost = 16;  // four valid levels have at most 12: when it is full, one too deep is in it
    const bool empty = array.values == 0, odd = array.odd || array.values < 2 || array.arrays > 0;
    const bool known = std::ranges::any_of(found_, [&](const Innermost& other) {
      return other.level() == arrays_.size() && other.empty == empty && other.odd == odd;
    });
    if (known || found_.size() == kMost) return;
    Innermost& found = found_.emplace_back(Innermost{{}, "[" + array.text + "]", empty, odd});
    for (std::size_t i = 0; i + 1 < arrays_.size(); ++i) found.path.push_back(arrays_[i].arrays - 1);
  }

  std::vector<Array> arrays_;     // open ones
  std::vector<Innermost> found_;  // the first of each combination of level, odd and empty
};

std::string placeInArrays(std::string_view type, const std::vector<std::size_t>& path) {
  const auto number = [&](std::size_t i) { return std::to_string(path[i] + 1); };
  const auto ring = [&](std::size_t i) { return path[i] == 0 ? "outer ring" : "hole " + std::to_string(path[i]); };
  if (isSame(type, "MultiPoint")) return "point " + number(0);
  if (isSame(type, "LineString")) return "vertex " + number(0);
  if (isSame(type, "MultiLineString")) return "line " + number(0) + ", vertex " + number(1);
  if (isSame(type, "Polygon")) return ring(0) + ", vertex " + number(1);
  if (isSame(type, "MultiPolygon")) return "polygon " + number(0) + ", " + ring(1) + ", vertex " + number(2);
  return "its point";
}

// Checks geometries from the events of a JSON parser, and stops it at the first feature that has an odd one.
class OddityFinder : public nlohmann::json_sax<nlohmann::json> {
 public:
  bool null() override { return value("null", false); }
  bool boolean(bool given) override { return value(given ? "true" : "false", false); }
  bool number_integer(number_integer_t given) override {
    if (isMember(Kind::Feature, "id") || isMember(Kind::Root, "id")) id_ = given;
    return value(std::to_string(given), true);
  }
  bool number_unsigned(number_unsigned_t given) override {
    if (given <= static_cast<number_unsigned_t>(std::numeric_limits<std::int64_t>::max())) {
      return number_integer(static_cast<number_integer_t>(given));
    }
    return value(std::to_string(given), true);
  }
  bool number_float(number_float_t, const string_t& given) override { return value(given, true); }
  bool binary(binary_t&) override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override { return false; }

  bool string(string_t& given) override {
    if (skipped_ == 0 && !levels_.empty() && !coordinates().isOpen() && levels_.back().key == "type") {
      levels_.back().type = given;
    }
    constexpr std::size_t kShown = 24;
    return value('"' + oneLine(given, kShown) + '"', false);
  }

  bool key(string_t& given) override {
    if (skipped_ == 0) levels_.back().key = given;
    return true;
  }

  bool start_object(std::size_t) override {
    if (skipped_ > 0) return ++skipped_ > 0;
    if (levels_.empty()) return push(Kind::Root);
    if (coordinates().isOpen()) {
      coordinates().add("{…}", false);
      return ++skipped_ > 0;
    }
    Level& top = levels_.back();
    if (top.kind == Kind::Features) {
      id_.reset();
      return push(Kind::Feature);
    }
    if (top.kind == Kind::Geometries) {
      ++top.members;
      return push(Kind::Geometry);
    }
    if (isMember(Kind::Feature, "geometry") || isMember(Kind::Root, "geometry")) return push(Kind::Geometry);
    return ++skipped_ > 0;
  }

  bool end_object() override {
    if (skipped_ > 0) return --skipped_, true;
    const Level& top = levels_.back();
    const bool is_geometry = top.kind == Kind::Geometry || (top.kind == Kind::Root && top.has_coordinates);
    if (is_geometry && oddity_.empty()) judge(top);
    const bool ends = top.kind == Kind::Feature || top.kind == Kind::Root;
    const bool is_feature = top.kind == Kind::Feature;
    levels_.pop_back();
    if (ends && !oddity_.empty()) return false;
    features_ += is_feature ? 1 : 0;
    return true;
  }

  bool start_array(std::size_t) override {
    if (skipped_ > 0) return ++skipped_ > 0;
    if (levels_.empty()) return false;
    Level& top = levels_.back();
    if (coordinates().isOpen()) return coordinates().open(), true;
    if (isMember(Kind::Root, "features")) return push(Kind::Features);
    const bool geometry = top.kind == Kind::Geometry || top.kind == Kind::Root;
    if (geometry && top.key == "geometries") {
      top.has_members = true;
      return push(Kind::Geometries);
    }
    if (geometry && top.key == "coordinates") {
      top.has_coordinates = true;
      return coordinates().open(), true;
    }
    refuseNoObject("[…]");
    return ++skipped_ > 0;
  }

  bool end_array() override {
    if (skipped_ > 0) return --skipped_, true;
    if (coordinates().isOpen()) {
      coordinates().close();
    } else {
      levels_.pop_back();
    }
    return true;
  }

  // Of the parsed file; nullopt if nothing is odd.
  std::optional<std::string> result() const {
    if (oddity_.empty()) return std::nullopt;
    return "feature " + std::to_string(id_.value_or(features_)) + ": " + oddity_;
  }

 private:
  enum class Kind { Root, Features, Feature, Geometry, Geometries };
  struct Level {
    Kind kind;
    std::string key, type;
    std::size_t members = 0;  // of a collection, so far
    bool has_coordinates = false, has_members = false;
    CoordinateArrays coordinates;
  };

  // REQUIRES: something is open.
  CoordinateArrays& coordinates() { return levels_.back().coordinates; }

  bool push(Kind kind) {
    constexpr std::size_t kDeepest = 64;  // nested collections
    if (levels_.size() == kDeepest) return false;
    levels_.emplace_back().kind = kind;
    return true;
  }

  bool isMember(Kind kind, std::string_view key) const {
    return skipped_ == 0 && !levels_.empty() && levels_.back().kind == kind && levels_.back().key == key;
  }

  bool value(const std::string& text, bool number) {
    if (skipped_ > 0 || levels_.empty()) return true;
    if (coordinates().isOpen()) {
      coordinates().add(text, number);
    } else if (text != "null") {
      refuseNoObject(text);
    }
    return true;
  }

  void refuseNoObject(const std::string& text) {
    if (oddity_.empty() && (isMember(Kind::Feature, "geometry") || isMember(Kind::Geometries, ""))) {
      oddity_ = "its geometry is not an object (" + text + ")";
    }
  }

  // The collections around the geometry on top, with its number in each.
  std::string memberInWords() const {
    std::string text;
    for (const Level& level : levels_) {
      if (level.kind == Kind::Geometries) text += "geometry " + std::to_string(level.members) + " of its collection, ";
    }
    return text;
  }

  void judge(const Level& geometry) {
    const std::string member = memberInWords();
    if (isSame(geometry.type, kCollection)) {
      if (!geometry.has_members) oddity_ = member + "a " + std::string(kCollection) + ", has no geometries";
      return;
    }
    const auto type =
        std::ranges::find_if(kTypes, [&](const GeometryType& t) { return isSame(t.name, geometry.type); });
    if (type == kTypes.end()) {
      oddity_ = member + "of the type '" + oneLine(geometry.type, 40) + "', is not a geometry of GeoJSON";
    } else if (!geometry.has_coordinates) {
      oddity_ = member + "a " + geometry.type + ", has no coordinates";
    } else if (const Innermost* odd = geometry.coordinates.firstOdd(type->level)) {
      oddity_ = member;
      oddity_ += odd->level() == type->level
                     ? placeInArrays(type->name, odd->path) + ", is not a place (" + odd->text + ")"
                     : odd->text + " lies in " + std::to_string(odd->level() - 1) +
                           forCount(odd->level() - 1, " array", " arrays") + " of the coordinates of its " +
                           geometry.type + ", not in " + std::to_string(type->level - 1);
    }
  }

  std::vector<Level> levels_;  // open ones
  std::size_t skipped_ = 0;    // depth within a skipped value
  std::int64_t features_ = 0;  // complete ones
  std::optional<std::int64_t> id_;
  std::string oddity_;
};

}  // namespace

std::optional<std::string> oddGeojson(const std::string& path) {
  VSIStatBufL stat;
  if (VSIStatL(path.c_str(), &stat) != 0) return std::nullopt;
  FileBytes file(path, static_cast<std::uintmax_t>(stat.st_size));
  OddityFinder finder;
  nlohmann::json::sax_parse(ByteIterator(&file), ByteIterator(nullptr), &finder);
  return finder.result();
}

}  // namespace coastmesh
