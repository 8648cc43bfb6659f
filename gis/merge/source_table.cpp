#include "gis/merge/source_table.hpp"

#include "gis/file/text_writer.hpp"

namespace coastmesh {

void writeSourceTable(std::span<const MergeSource> nodes, const Elements& elements,
                      std::span<const MergeSource> sources, const std::string& path, const ItemLoop& loop) {
  TextWriter out(path);
  out << "item,number,mesh,source\n";
  const auto write = [&](std::span<const MergeSource> all, const auto& itemAt) {
    out.rows(loop, all.size(), [&](TextBlock& row, std::size_t i) {
      row << itemAt(i) << ',' << i + 1 << ',';
      if (const auto [mesh, number] = all[i]; mesh != kNone)
        row << std::size_t{mesh} + 1 << ',' << std::size_t{number} + 1;
      else
        row << ',';
      row << '\n';
    });
  };
  write(nodes, [](std::size_t) { return "node"; });
  write(sources, [&](std::size_t i) { return elements.nameOf(i); });
  out.close();
}

}  // namespace coastmesh
