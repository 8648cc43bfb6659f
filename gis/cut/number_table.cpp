#include "gis/cut/number_table.hpp"

#include "core/ids.hpp"
#include "gis/file/text_writer.hpp"

namespace coastmesh {

void writeNumberTable(std::span<const std::uint32_t> nodes, std::span<const std::uint32_t> triangles,
                      const std::string& path, const ItemLoop& loop) {
  TextWriter out(path);
  out << "item,number,source\n";
  const auto write = [&](const char* item, std::span<const std::uint32_t> sources) {
    out.rows(loop, sources.size(), [&](TextBlock& row, std::size_t i) {
      row << item << ',' << i + 1 << ',';
      if (sources[i] != kNone) row << std::size_t{sources[i]} + 1;
      row << '\n';
    });
  };
  write("node", nodes);
  write("triangle", triangles);
  out.close();
}

}  // namespace coastmesh
