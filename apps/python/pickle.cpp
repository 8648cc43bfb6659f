#include "apps/python/pickle.hpp"

#include <cstring>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Each names every member, so that a new one does not compile until it is here.
auto partsOf(auto& crs) requires std::is_same_v<std::remove_cvref_t<decltype(crs)>, Crs> {
  auto& [wkt, authority, geographic, semi_major_m, flattening] = crs;
  return std::tie(wkt, authority, geographic, semi_major_m, flattening);
}
auto partsOf(auto& boundary) requires std::is_same_v<std::remove_cvref_t<decltype(boundary)>, Boundary> {
  auto& [role, closed, nodes, ibtype, back_nodes, repeats_first, weir] = boundary;
  return std::tie(role, closed, nodes, ibtype, back_nodes, repeats_first, weir);
}
auto partsOf(auto& line) requires std::is_same_v<std::remove_cvref_t<decltype(line)>, GridLine> {
  auto& [kind, name, closed, nodes] = line;
  return std::tie(kind, name, closed, nodes);
}
auto partsOf(auto& feature) requires std::is_same_v<std::remove_cvref_t<decltype(feature)>, GridFeature> {
  auto& [fid, source, attributes, region] = feature;
  return std::tie(fid, source, attributes, region);
}
auto partsOf(auto& grid) requires std::is_same_v<std::remove_cvref_t<decltype(grid)>, Grid> {
  auto& [title, crs, nodes, z, size_m, triangles, feature_of, piece_of, min_angle_deg, area_m2, features, boundaries,
         lines, notes] = grid;
  return std::tie(title, crs, nodes, z, size_m, triangles, feature_of, piece_of, min_angle_deg, area_m2, features,
                  boundaries, lines, notes);
}
auto partsOf(auto& refusal) requires std::is_same_v<std::remove_cvref_t<decltype(refusal)>, Refusal> {
  auto& [source, fids, reason, place, over_budget] = refusal;
  return std::tie(source, fids, reason, place, over_budget);
}
auto partsOf(auto& result) requires std::is_same_v<std::remove_cvref_t<decltype(result)>, MeshResult> {
  auto& [grid, report, warnings, refusals, complete] = result;
  return std::tie(grid, report, warnings, refusals, complete);
}

template <typename T>
concept Plain = std::is_arithmetic_v<T> || std::is_enum_v<T> || std::is_same_v<T, Point> ||
    std::is_same_v<T, std::array<std::uint32_t, 3>>;

class Writer {
 public:
  std::string take() { return std::move(bytes_); }

  template <Plain T>
  void pass(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void pass(const std::string& text) { passAll(text); }
  template <typename T>
  void pass(const std::vector<T>& values) {
    passAll(values);
  }
  template <typename A, typename B>
  void pass(const std::pair<A, B>& both) {
    pass(both.first);
    pass(both.second);
  }
  template <typename T>
  void pass(const std::optional<T>& value) {
    pass(value.has_value());
    if (value) pass(*value);
  }
  template <typename T>
  void pass(const T& whole) requires requires {
    partsOf(whole);
  }
  {
    std::apply([this](const auto&... parts) { (pass(parts), ...); }, partsOf(whole));
  }

 private:
  template <typename Items>
  void passAll(const Items& items) {
    pass(static_cast<std::uint64_t>(items.size()));
    if constexpr (Plain<typename Items::value_type>) {
      bytes_.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
    } else {
      for (const auto& item : items) pass(item);
    }
  }

  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}
  bool atEnd() const { return at_ == bytes_.size(); }

  template <Plain T>
  void pass(T& value) {
    copy(&value, sizeof value);
  }
  void pass(std::string& text) { passAll(text); }
  template <typename T>
  void pass(std::vector<T>& values) {
    passAll(values);
  }
  template <typename A, typename B>
  void pass(std::pair<A, B>& both) {
    pass(both.first);
    pass(both.second);
  }
  template <typename T>
  void pass(std::optional<T>& value) {
    bool has = false;
    pass(has);
    if (has) pass(value.emplace());
  }
  template <typename T>
  void pass(T& whole) requires requires {
    partsOf(whole);
  }
  {
    std::apply([this](auto&... parts) { (pass(parts), ...); }, partsOf(whole));
  }

 private:
  void copy(void* to, std::size_t size) {
    if (size > bytes_.size() - at_) throw InputError("the pickled mesh ends too early");
    if (size > 0) std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
  }
  template <typename Items>
  void passAll(Items& items) {
    std::uint64_t count = 0;
    pass(count);
    // Every item takes a byte at least.
    if (count > bytes_.size() - at_) throw InputError("the pickled mesh ends too early");
    items.resize(count);
    if constexpr (Plain<typename Items::value_type>) {
      copy(items.data(), items.size() * sizeof(items[0]));
    } else {
      for (auto& item : items) pass(item);
    }
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

}  // namespace

std::string bytesOf(const MeshResult& result) {
  Writer writer;
  writer.pass(std::string(COASTMESH_VERSION));
  writer.pass(result);
  return writer.take();
}

MeshResult resultOf(const std::string& bytes) {
  Reader reader(bytes);
  std::string version;
  reader.pass(version);
  if (version != COASTMESH_VERSION) {
    throw InputError("the mesh was pickled by coastmesh " + version + ", this is " + COASTMESH_VERSION +
                     "; keep meshes in files instead");
  }
  MeshResult result;
  reader.pass(result);
  if (!reader.atEnd()) throw InputError("the pickled mesh is longer than it should be");
  return result;
}

}  // namespace coastmesh
