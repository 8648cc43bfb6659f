#include "gis/fields/fort13.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/file/list_reader.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

constexpr std::string_view kNodeNumbers = "condensed_nodes";

// The fields of one attribute, and what it is where nothing else is said.
struct Attribute {
  std::vector<const NodeField*> fields;
  std::vector<double> usual;

  bool isUsual(std::size_t node) const {
    for (std::size_t k = 0; k < fields.size(); ++k)
      if (fields[k]->values[node] != usual[k]) return false;
    return true;
  }
};

// In the order of their first values.
std::vector<Attribute> attributesOf(const Grid& grid) {
  std::vector<Attribute> attributes;
  for (const NodeField& field : grid.node_fields) {
    const auto isIt = [&](const Attribute& other) { return other.fields.front()->name == field.name; };
    auto found = std::ranges::find_if(attributes, isIt);
    if (found == attributes.end()) found = attributes.insert(found, Attribute{});
    found->fields.push_back(&field);
  }
  for (Attribute& attribute : attributes) {
    std::ranges::stable_sort(attribute.fields, {}, &NodeField::component);
    for (const NodeField* field : attribute.fields)
      attribute.usual.push_back(0.0 + (std::isnan(field->usual) ? mostFrequentOf(*field) : field->usual));  // never -0
  }
  return attributes;
}

std::string oneLine(std::string text, std::string_view otherwise) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text.find_first_not_of(" \t") == std::string::npos ? std::string(otherwise) : text;
}

// The next line that is not blank, without blanks around it.
std::string nameLine(ListReader& file) {
  file.text().needLine();
  return std::string(trimmed(file.text().line()));
}

// What the file says of an attribute before its values.
struct Header {
  std::string name, unit;
  std::vector<double> usual;
  bool was_read = false;
};

Header readHeader(ListReader& file, std::string name) {
  constexpr std::uint64_t kMostValues = 1000;
  Header header{std::move(name), {}, {}};
  if (!file.text().nextPhysicalLine()) file.fail("it ends within the attribute " + header.name);
  header.unit = std::string(trimmed(file.text().line()));
  file.needStatement();
  const std::uint64_t count = file.count();
  if (count == 0 || count > kMostValues)
    file.fail(header.name + " has " + std::to_string(count) + forCount(count, " value", " values") + " for each node");
  file.needStatement();
  for (std::uint64_t k = 0; k < count; ++k) header.usual.push_back(file.number());
  return header;
}

// Adds the fields of an attribute, with its usual values. Returns their first number.
std::size_t addFields(const Header& header, Grid& grid) {
  const std::size_t first = grid.node_fields.size(), count = header.usual.size();
  for (std::size_t k = 0; k < count; ++k) {
    const auto component = static_cast<std::uint32_t>(count == 1 ? 0 : k + 1);
    grid.node_fields.push_back({header.name, header.unit, component, header.usual[k], {}});
    grid.node_fields.back().values.assign(grid.nodes.size(), header.usual[k]);
  }
  return first;
}

void readValues(ListReader& file, const IdMap& index, std::vector<Header>& headers, Grid& grid) {
  const std::string name = nameLine(file);
  const auto header = std::ranges::find(headers, name, &Header::name);
  if (header == headers.end()) file.fail("the attribute " + name + " is not among those that it begins with");
  if (std::exchange(header->was_read, true)) file.fail("the attribute " + name + " has values twice");
  const bool kept = name != kNodeNumbers;
  const std::size_t first = kept ? addFields(*header, grid) : 0;
  file.needStatement();
  const std::uint64_t rows = file.count();
  for (std::uint64_t row = 0; row < rows; ++row) {
    file.needStatement();
    const std::int64_t id = file.integer();
    const std::uint32_t node = index.indexOf(id);
    if (node == kNone) file.fail("there is no node " + std::to_string(id));
    for (std::size_t k = 0; k < header->usual.size(); ++k) {
      const double value = file.number();
      if (kept) grid.node_fields[first + k].values[node] = value;
    }
  }
}

void writeHeader(TextWriter& file, const Attribute& attribute) {
  const NodeField& field = *attribute.fields.front();
  file << field.name << '\n' << oneLine(field.unit, "unitless") << '\n' << attribute.fields.size() << '\n';
  for (std::size_t k = 0; k < attribute.usual.size(); ++k) file << (k > 0 ? " " : "") << attribute.usual[k];
  file << '\n';
}

void writeValues(TextWriter& file, const Attribute& attribute, std::size_t nodes, const ItemLoop& loop) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t node = 0; node < nodes; ++node)
    if (!attribute.isUsual(node)) others.push_back(node);
  file << attribute.fields.front()->name << '\n' << others.size() << '\n';
  file.rows(loop, others.size(), [&](TextBlock& text, std::size_t i) {
    text << others[i] + 1;
    for (const NodeField* field : attribute.fields) text << ' ' << 0.0 + field->values[others[i]];
    text << '\n';
  });
}

}  // namespace

void writeFort13(const std::string& path, const Grid& grid, const ItemLoop& loop) {
  std::vector<Attribute> attributes = attributesOf(grid);
  const auto own = std::ranges::stable_partition(
      attributes, [](const Attribute& attribute) { return attribute.fields.front()->name != kFloodPlain; });
  TextWriter file(path);
  file << oneLine(grid.title, "coastmesh") << '\n'
       << grid.nodes.size() << '\n'
       << attributes.size() - own.size() << '\n';
  const std::span<const Attribute> all(attributes), counted = all.first(all.size() - own.size());
  for (const Attribute& attribute : counted) writeHeader(file, attribute);
  for (const Attribute& attribute : counted) writeValues(file, attribute, grid.nodes.size(), loop);
  for (const Attribute& attribute : all.last(own.size())) {
    writeHeader(file, attribute);
    writeValues(file, attribute, grid.nodes.size(), loop);
  }
  file.close();
}

void readFort13(const std::string& path, const std::vector<std::int64_t>& ids, Grid& grid) {
  ListReader file(path);
  file.text().nextPhysicalLine();  // the title, even if it is blank
  file.needStatement();
  const std::uint64_t nodes = file.count();
  if (nodes != ids.size())
    file.fail("it has attributes of " + std::to_string(nodes) + forCount(nodes, " node", " nodes") +
              ", but the mesh beside it has " + std::to_string(ids.size()) +
              ": give it another name if it belongs to another mesh");
  const IdMap index(ids, file.text(), "node");
  file.needStatement();
  const std::uint64_t count = file.count();
  std::vector<Header> headers;
  for (std::uint64_t i = 0; i < count; ++i) {
    Header header = readHeader(file, nameLine(file));
    if (std::ranges::find(headers, header.name, &Header::name) != headers.end())
      file.fail("the attribute " + header.name + " is there twice");
    headers.push_back(std::move(header));
  }
  for (std::uint64_t i = 0; i < count; ++i) readValues(file, index, headers, grid);
  if (file.text().nextLine() && trimmed(file.text().line()) == kFloodPlain) {
    if (std::ranges::find(headers, kFloodPlain, &Header::name) != headers.end())
      file.fail("the attribute " + std::string(kFloodPlain) + " is there twice");
    headers.push_back(readHeader(file, std::string(kFloodPlain)));
    readValues(file, index, headers, grid);
  }
  if (std::ranges::find(headers, kNodeNumbers, &Header::name) != headers.end())
    grid.notes.push_back("condensed_nodes of '" + path +
                         "' are left out: they are numbers of nodes, which edits would not follow");
}

}  // namespace coastmesh
