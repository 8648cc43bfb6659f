#include "gis/cut/number_table.hpp"

#include "core/ids.hpp"
#include "gis/file/text_writer.hpp"

namespace coastmesh {

void writeNumberTable(std::span<const std::uint32_t> nodes, const Elements& elements,
                      std::span<const std::uint32_t> sources, const std::string& path, const ItemLoop& loop) {
  TextWriter out(path);
  out << "item,number,source\n";
  const auto write = [&](std::span<const std::uint32_t> all, const auto& itemAt) {
    out.rows(loop, all.size(), [&](TextBlock& row, std::size_t i) {
      row << itemAt(i) << ',' << i + 1 << ',';
      if (all[i] != kNone) row << std::size_t{all[i]} + 1;
      row << '\n';
    });
  };
  write(nodes, [](std::size_t) { return "node"; });
  write(sources, [&](std::size_t i) { return elements.nameOf(i); });
  out.close();
}

}  // namespace coastmesh
