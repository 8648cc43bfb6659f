#include "gis/format/read_vtu.hpp"

#include <cpl_conv.h>
#include <cpl_minixml.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/bulk_list.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/file/depth_names.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/single_precision.hpp"
#include "gis/file/whole_file.hpp"
#include "gis/format/grid_names.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

constexpr std::int64_t kVertexCell = 1, kLineCell = 3, kTriangleCell = 5, kPixelCell = 8, kQuadCell = 9;

std::string decodeBase64(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int held = 0;
  for (const char c : text) {
    int value = -1;
    if (c >= 'A' && c <= 'Z') value = c - 'A';
    if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
    if (c >= '0' && c <= '9') value = c - '0' + 52;
    if (c == '+') value = 62;
    if (c == '/') value = 63;
    if (c == '=') held = 0;   // the end of a part; another may follow
    if (value < 0) continue;  // blanks between lines
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    bytes.push_back(static_cast<char>(bits >> held & 0xff));
  }
  return bytes;
}

template <typename T>
std::vector<double> valuesOf(std::string_view bytes) {
  std::vector<double> values(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values[i] = std::is_same_v<T, float> ? shortestDecimal(static_cast<float>(value)) : static_cast<double>(value);
  }
  return values;
}

// The file as a tree of elements and the bytes of its appended arrays.
class VtuFile {
 public:
  explicit VtuFile(const std::string& path) : path_(path), bytes_(wholeFile(path)) {
    std::string head = bytes_;
    if (const std::size_t appended = bytes_.find("<AppendedData"); appended != std::string::npos) {
      const std::size_t mark = bytes_.find('_', bytes_.find('>', appended));
      if (mark == std::string::npos) fail("its appended data does not start");
      base64_ = bytes_.substr(appended, mark - appended).find("base64") != std::string::npos;
      appended_ = mark + 1;
      head = bytes_.substr(0, appended) + "</VTKFile>";
    }
    const OgrErrors errors;
    root_.reset(CPLParseXMLString(head.c_str()));
    if (!root_) fail("it is not XML (" + errors.text() + ")");
    const CPLXMLNode* const file_node = CPLGetXMLNode(root_.get(), "=VTKFile");
    if (file_node == nullptr) fail("it has no VTKFile");
    const std::string_view compressor = CPLGetXMLValue(file_node, "compressor", "");
    deflated_ = compressor == "vtkZLibDataCompressor";
    if (!compressor.empty() && !deflated_)
      fail("its arrays are compressed with " + std::string(compressor) + "; save it with ZLib or without compression");
    if (std::string_view(CPLGetXMLValue(file_node, "byte_order", "LittleEndian")) != "LittleEndian")
      fail("it is big-endian; save it as little-endian");
    header_ = std::string_view(CPLGetXMLValue(file_node, "header_type", "UInt32")) == "UInt64" ? 8 : 4;
    grid_ = CPLGetXMLNode(file_node, "UnstructuredGrid");
    piece_ = grid_ == nullptr ? nullptr : CPLGetXMLNode(grid_, "Piece");
    if (piece_ == nullptr) fail("it has no unstructured grid");
    for (const CPLXMLNode* node = piece_->psNext; node != nullptr; node = node->psNext)
      if (node->eType == CXT_Element && std::string_view(node->pszValue) == "Piece") fail("it has several pieces");
  }

  [[noreturn]] void fail(const std::string& what) const { throw InputError("'" + path_ + "': " + what); }

  // The array called `name`; if that is empty, the first of the section, since that of points has no fixed name.
  // Nullopt if there is none.
  std::optional<std::vector<double>> array(const char* section, std::string_view name) const {
    const bool in_grid = std::string_view(section) == "FieldData";
    const CPLXMLNode* const parent = CPLGetXMLNode(in_grid ? grid_ : piece_, section);
    if (parent == nullptr) return std::nullopt;
    for (const CPLXMLNode* node = parent->psChild; node != nullptr; node = node->psNext) {
      if (node->eType != CXT_Element || std::string_view(node->pszValue) != "DataArray") continue;
      if (name.empty() || name == CPLGetXMLValue(node, "Name", "")) return decode(node);
    }
    return std::nullopt;
  }

  // The names of a section's arrays, in the file's order.
  std::vector<std::string> names(const char* section) const {
    std::vector<std::string> all;
    const CPLXMLNode* const parent = CPLGetXMLNode(piece_, section);
    for (const CPLXMLNode* node = parent == nullptr ? nullptr : parent->psChild; node != nullptr; node = node->psNext)
      if (node->eType == CXT_Element && std::string_view(node->pszValue) == "DataArray")
        all.emplace_back(CPLGetXMLValue(node, "Name", ""));
    return all;
  }

  std::vector<double> need(const char* section, std::string_view name, std::size_t size) const {
    auto values = array(section, name);
    if (!values) fail("there is no array \"" + std::string(name) + "\" in " + section);
    if (values->size() != size)
      fail("the array \"" + std::string(name) + "\" in " + section + " has " + std::to_string(values->size()) +
           " values where " + std::to_string(size) + " are expected");
    return std::move(*values);
  }

  std::size_t count(const char* attribute) const {
    const std::string_view text = CPLGetXMLValue(piece_, attribute, "");
    std::size_t value = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc() || value > bytes_.size())
      fail("its " + std::string(attribute) + " is \"" + std::string(text) + '"');
    return value;
  }

 private:
  std::vector<double> decode(const CPLXMLNode* node) const {
    const std::string_view format = CPLGetXMLValue(node, "format", "");
    const std::string_view type = CPLGetXMLValue(node, "type", "");
    const std::string_view text = CPLGetXMLValue(node, nullptr, "");
    if (format == "ascii") return decodeText(text);
    if (format == "binary") return decodeBytes(block(decodeBase64(text), 0), type);
    if (format != "appended") fail("an array of format \"" + std::string(format) + "\"");
    const std::string_view offset_text = CPLGetXMLValue(node, "offset", "");
    std::size_t offset = 0;
    if (std::from_chars(offset_text.data(), offset_text.data() + offset_text.size(), offset).ec != std::errc() ||
        appended_ == 0 || offset > bytes_.size() - appended_)
      fail("an array lies beyond its end");
    if (base64_) return decodeBytes(block(decodeBase64(std::string_view(bytes_).substr(appended_ + offset)), 0), type);
    return decodeBytes(block(bytes_, appended_ + offset), type);
  }

  // The number at `at`, which is moved behind it.
  std::uint64_t headerAt(const std::string& bytes, std::size_t& at) const {
    if (bytes.size() - at < header_) fail("an array lies beyond its end");
    std::uint64_t value = 0;
    std::memcpy(&value, bytes.data() + at, header_);
    at += header_;
    return value;
  }

  // The bytes of an array; their number precedes them.
  std::string block(const std::string& bytes, std::size_t at) const {
    if (deflated_) return inflatedBlocks(bytes, at);
    const std::uint64_t size = headerAt(bytes, at);
    if (size > bytes.size() - at) fail("an array lies beyond its end");
    return bytes.substr(at, size);
  }

  // The bytes of a compressed array: before them the number of its blocks, the bytes of a whole one, those of the last
  // if it is not whole, and the compressed bytes of each.
  std::string inflatedBlocks(const std::string& bytes, std::size_t at) const {
    constexpr std::uint64_t kMostOfOne = 1100;  // bytes that zlib makes of one
    const std::uint64_t blocks = headerAt(bytes, at), whole = headerAt(bytes, at), last = headerAt(bytes, at);
    if (blocks > (bytes.size() - at) / header_) fail("an array lies beyond its end");
    std::vector<std::uint64_t> sizes;
    for (std::uint64_t i = 0; i < blocks; ++i) sizes.push_back(headerAt(bytes, at));
    std::string all;
    for (std::uint64_t i = 0; i < blocks; ++i) {
      if (sizes[i] > bytes.size() - at) fail("an array lies beyond its end");
      const std::uint64_t length = i + 1 == blocks && last > 0 ? last : whole;
      if (length / kMostOfOne > sizes[i]) fail("a compressed array is damaged");
      const std::size_t begin = all.size();
      all.resize(begin + length);
      std::size_t made = 0;
      if (CPLZLibInflate(bytes.data() + at, sizes[i], all.data() + begin, length, &made) == nullptr || made != length)
        fail("a compressed array is damaged");
      at += sizes[i];
    }
    return all;
  }

  std::vector<double> decodeText(std::string_view text) const {
    std::vector<double> values;
    const char* at = text.data();
    const char* const end = at + text.size();
    while (true) {
      while (at != end && std::strchr(" \t\r\n", *at) != nullptr) ++at;
      if (at == end) return values;
      double value = 0.0;
      const auto [next, error] = std::from_chars(at, end, value);
      if (error != std::errc()) fail("an array holds a value that is not a number");
      values.push_back(value);
      at = next;
    }
  }

  std::vector<double> decodeBytes(const std::string& bytes, std::string_view type) const {
    static_assert(std::endian::native == std::endian::little);
    if (type == "Float64") return valuesOf<double>(bytes);
    if (type == "Float32") return valuesOf<float>(bytes);
    if (type == "Int64") return valuesOf<std::int64_t>(bytes);
    if (type == "UInt64") return valuesOf<std::uint64_t>(bytes);
    if (type == "Int32") return valuesOf<std::int32_t>(bytes);
    if (type == "UInt32") return valuesOf<std::uint32_t>(bytes);
    if (type == "UInt8") return valuesOf<std::uint8_t>(bytes);
    if (type == "Int8") return valuesOf<std::int8_t>(bytes);
    fail("an array of type \"" + std::string(type) + '"');
  }

  struct FreeXml {
    void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
  };

  std::string path_, bytes_;
  std::unique_ptr<CPLXMLNode, FreeXml> root_;
  const CPLXMLNode* grid_ = nullptr;
  const CPLXMLNode* piece_ = nullptr;
  std::size_t appended_ = 0;  // where the appended arrays start; 0 if there are none
  bool base64_ = false;
  bool deflated_ = false;  // arrays are compressed
  std::size_t header_ = 4;
};

// Reads the triangles and quadrilaterals, and returns the index of each in the file's cells.
std::vector<std::size_t> readFaces(const VtuFile& file, Grid& grid) {
  const std::size_t cells = file.count("NumberOfCells");
  const std::vector<double> ends = file.need("Cells", "offsets", cells), types = file.need("Cells", "types", cells);
  const auto corners = file.array("Cells", "connectivity");
  if (!corners) file.fail("there is no array \"connectivity\" in Cells");
  std::vector<std::size_t> of_cell;
  for (std::size_t c = 0; c < cells; ++c) {
    if (!(types[c] >= 0.0 && types[c] < 256.0)) file.fail("cell " + std::to_string(c + 1) + " is of no type");
    const auto type = static_cast<std::int64_t>(types[c]);
    if (type == kVertexCell || type == kLineCell) continue;
    if (type != kTriangleCell && type != kQuadCell && type != kPixelCell)
      file.fail("cell " + std::to_string(c + 1) + " is of type " + std::to_string(type) +
                "; only triangles (5) and quadrilaterals (8 and 9) can be read");
    const std::size_t count = type == kTriangleCell ? 3 : 4;
    const double begin = c == 0 ? 0.0 : ends[c - 1];
    if (ends[c] - begin != static_cast<double>(count) || begin < 0.0 || ends[c] > static_cast<double>(corners->size()))
      file.fail("cell " + std::to_string(c + 1) + " does not have " + std::to_string(count) + " nodes");
    std::array<std::uint32_t, 4> nodes;
    for (std::size_t i = 0; i < count; ++i) {
      const double node = (*corners)[static_cast<std::size_t>(begin) + i];
      if (!(node >= 0.0 && node < static_cast<double>(grid.nodes.size())))
        file.fail("cell " + std::to_string(c + 1) + " names a node that is not there");
      nodes[i] = static_cast<std::uint32_t>(node);
    }
    if (type == kPixelCell) std::swap(nodes[2], nodes[3]);  // its nodes are row by row
    addElement(grid, std::span(nodes).first(count));
    of_cell.push_back(c);
  }
  return of_cell;
}

std::vector<double> readCellData(const VtuFile& file, const char* name, const std::vector<std::size_t>& cells) {
  const auto values = file.array("CellData", name);
  if (!values || (!cells.empty() && cells.back() >= values->size())) return {};
  std::vector<double> out;
  for (const std::size_t cell : cells) out.push_back((*values)[cell]);
  return out;
}

// A boundary or line, as `writeVtu` stores it in the field data.
struct Chain {
  std::vector<std::uint32_t> nodes;
  std::size_t kind = 0;
  bool closed = false;
};

std::vector<Chain> readChains(const VtuFile& file, const std::string& of, const std::string& what, std::size_t kinds,
                              std::size_t node_count) {
  const auto array = [&](const std::string& name) { return file.array("FieldData", of + '_' + name); };
  const auto nodes = array("nodes"), ends = array("ends"), kind_of = array(what), closed = array("closed");
  std::vector<Chain> chains;
  if (!nodes || !ends || !kind_of || !closed) return chains;
  if (kind_of->size() != ends->size() || closed->size() != ends->size())
    file.fail("its arrays of each " + of + " do not go together");
  std::size_t at = 0;
  for (std::size_t i = 0; i < ends->size(); ++i) {
    const double kind = (*kind_of)[i];
    if (!(kind >= 0.0 && kind < static_cast<double>(kinds)) || !((*ends)[i] <= static_cast<double>(nodes->size())))
      file.fail(of + ' ' + std::to_string(i + 1) + " is of no kind that is known");
    Chain& chain = chains.emplace_back();
    chain.kind = static_cast<std::size_t>(kind);
    chain.closed = (*closed)[i] != 0.0;
    for (; static_cast<double>(at) < (*ends)[i]; ++at) {
      if (!((*nodes)[at] >= 0.0 && (*nodes)[at] < static_cast<double>(node_count)))
        file.fail(of + ' ' + std::to_string(i + 1) + " names a node that is not there");
      chain.nodes.push_back(static_cast<std::uint32_t>((*nodes)[at]));
    }
  }
  return chains;
}

// Texts are stored as bytes, each ended by a zero.
std::vector<std::string> readTexts(const VtuFile& file, const char* name) {
  std::vector<std::string> texts;
  std::string text;
  for (const double byte : file.array("FieldData", name).value_or(std::vector<double>())) {
    if (!(byte >= 0.0 && byte < 256.0)) file.fail("its texts hold a value that is not a byte");
    if (byte != 0.0) {
      text.push_back(static_cast<char>(static_cast<unsigned char>(byte)));
    } else {
      texts.push_back(std::exchange(text, {}));
    }
  }
  return texts;
}

void readBoundaries(const VtuFile& file, Grid& grid) {
  const auto types = file.array("FieldData", "boundary_ibtypes");
  const std::vector<std::string> names = readTexts(file, "boundary_names");
  for (Chain& chain : readChains(file, "boundary", "roles", kBoundaryRoles.size(), grid.nodes.size())) {
    const std::size_t b = grid.boundaries.size();
    const bool known = types && b < types->size() && (*types)[b] >= 0.0 && (*types)[b] < 1000.0;
    grid.boundaries.push_back(
        {kBoundaryRoles[chain.kind], chain.closed, std::move(chain.nodes), known ? static_cast<int>((*types)[b]) : -1});
    if (b < names.size()) grid.boundaries.back().name = names[b];
  }
}

void readLines(const VtuFile& file, Grid& grid) {
  const std::vector<std::string> names = readTexts(file, "line_names");
  for (Chain& chain : readChains(file, "line", "kinds", kLineKinds.size(), grid.nodes.size())) {
    const std::size_t i = grid.lines.size();
    if (chain.nodes.size() < (chain.closed ? 3u : 2u))
      file.fail("line " + std::to_string(i + 1) + " has too few nodes");
    grid.lines.push_back(
        {kLineKinds[chain.kind], i < names.size() ? names[i] : "", chain.closed, std::move(chain.nodes)});
  }
}

// z, from arrays of nodes and the third of each node's coordinates. Depths are taken before the third coordinates,
// which may be those of a surface, but elevations after them: ParaView gives this name to a share of a height.
void readElevation(const VtuFile& file, const std::vector<double>& places, bool on_globe, Grid& grid) {
  const std::size_t nodes = grid.nodes.size();
  const auto take = [&](const auto& isWanted) {
    for (const std::string& name : file.names("PointData")) {
      if (!isWanted(lowerCase(name))) continue;
      auto values = file.array("PointData", name);
      if (!values || values->size() != nodes) continue;
      grid.z = std::move(*values);
      return lowerCase(name);
    }
    return std::string();
  };
  if (!take([](const std::string& name) { return name == "z"; }).empty()) return;
  // "h" is often the depth of the water at some time.
  const std::string depth =
      take([](const std::string& name) { return name != "h" && depthNameOf(name) == DepthName::Depth; });
  if (!depth.empty()) {
    // Rasters of bathymetry have elevations, so the word may mean these.
    const bool are_elevations =
        depth == "bathymetry" && std::ranges::none_of(grid.z, [](double value) { return value > 0.0; });
    for (double& z : grid.z) z = are_elevations ? z : 0.0 - z;
    return;
  }
  bool raised = false;
  for (std::size_t i = 0; i < nodes && !on_globe && !raised; ++i) raised = places[3 * i + 2] != 0.0;
  if (!raised) {
    take([](const std::string& name) { return depthNameOf(name) == DepthName::Elevation; });
    return;
  }
  for (std::size_t i = 0; i < nodes; ++i) grid.z.push_back(places[3 * i + 2]);
}

// Node data with the name of an attribute that models know.
void readFields(const VtuFile& file, Grid& grid) {
  for (const std::string& name : file.names("PointData")) {
    const FieldName* const known = findFieldName(name);
    if (known == nullptr || findField(grid, std::string(known->name)) != nullptr) continue;
    auto values = file.array("PointData", name);
    if (!values || values->size() != grid.nodes.size()) continue;
    NodeField& field = grid.node_fields.emplace_back(NodeField{std::string(known->name), std::string(known->unit)});
    field.values = std::move(*values);
  }
}

}  // namespace

Grid readVtu(const std::string& path, const Crs& unsaid) {
  const VtuFile file(path);
  Grid grid;
  const std::size_t nodes = file.count("NumberOfPoints");
  const std::vector<double> places = file.need("Points", {}, 3 * nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    if (!std::isfinite(places[3 * i]) || !std::isfinite(places[3 * i + 1]))
      file.fail("node " + std::to_string(i + 1) + " has no finite coordinates");
    grid.nodes.push_back({places[3 * i], places[3 * i + 1]});
  }
  const auto lon = file.array("PointData", kVtuLongitude), lat = file.array("PointData", kVtuLatitude);
  const bool on_globe = lon && lat && lon->size() == nodes && lat->size() == nodes;
  for (std::size_t i = 0; on_globe && i < nodes; ++i) grid.nodes[i] = {(*lon)[i], (*lat)[i]};
  grid.crs = on_globe ? wgs84() : readPrjBeside(path, unsaid);
  const std::vector<std::size_t> cells = readFaces(file, grid);
  readElevation(file, places, on_globe, grid);
  readFields(file, grid);
  const auto readInto = [&](BulkList<double>& values, const char* name) {
    const std::vector<double> read = readCellData(file, name, cells);
    values.assign(read.begin(), read.end());
  };
  readInto(grid.min_angle_deg, "min_angle");
  readInto(grid.area_m2, "area_m2");
  addFeatures(readCellData(file, "src_fid", cells), readCellData(file, "region", cells),
              readTexts(file, "region_names"), grid);
  giveToHalves(Elements(grid), grid);
  readBoundaries(file, grid);
  readLines(file, grid);
  return grid;
}

}  // namespace coastmesh
