#include "parallel/piece_context.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#include "core/size/size_tree.hpp"
#include "parallel/bytes.hpp"

namespace coastmesh {

template <>
struct HasNoGaps<Segment> : std::true_type {};
template <>
struct HasNoGaps<InputCorner> : std::true_type {};
static_assert(sizeof(Segment) == 6 * sizeof(std::uint32_t) && sizeof(InputCorner) == 7 * sizeof(double));

// Found by argument-dependent lookup from `pass`.
auto partsOf(auto& pslg) requires std::is_same_v<std::remove_cvref_t<decltype(pslg)>, Pslg> {
  auto& [points, segments, holes] = pslg;
  return std::tie(points, segments, holes);
}
auto partsOf(auto& surface) requires std::is_same_v<std::remove_cvref_t<decltype(surface)>, Surface> {
  auto& [curvature, margin] = surface;
  return std::tie(curvature, margin);
}
auto partsOf(auto& cell) requires std::is_same_v<std::remove_cvref_t<decltype(cell)>, SizeTree::Cell> {
  auto& [below, is_leaf] = cell;
  return std::tie(below, is_leaf);
}
// All members except the requested lengths: see `passSize`.
auto partsOf(auto& options) requires std::is_same_v<std::remove_cvref_t<decltype(options)>, RefineOptions> {
  auto& [min_angle_deg, max_angle_deg, size_max, algorithm, max_vertices, most_in_memory, size, resolution, goal,
         surface, least_edge, size_scale] = options;
  return std::tie(min_angle_deg, max_angle_deg, size_max, algorithm, max_vertices, most_in_memory, resolution, goal,
                  surface, least_edge, size_scale);
}

namespace {

struct BadContext : std::runtime_error {
  using std::runtime_error::runtime_error;
};

enum class SizeKind : std::uint8_t { None, Constant, Tree };

void passSize(ByteWriter& writer, const SizeFunction* size) {
  if (size == nullptr) {
    writer.pass(SizeKind::None);
  } else if (const auto* tree = dynamic_cast<const SizeTree*>(size)) {
    writer.pass(SizeKind::Tree);
    tree->visitParts([&](const auto&... parts) { (writer.pass(parts), ...); });
  } else if (dynamic_cast<const ConstantSize*>(size) != nullptr) {
    writer.pass(SizeKind::Constant);
    writer.pass(size->least());
  } else {
    throw std::logic_error("wanted lengths of this kind cannot be sent");
  }
}

std::unique_ptr<const SizeFunction> sizeFrom(BasicByteReader<BadContext>& reader) {
  SizeKind kind{};
  reader.pass(kind);
  if (kind == SizeKind::None) return nullptr;
  if (kind == SizeKind::Constant) {
    double size = 0.0;
    reader.pass(size);
    return std::make_unique<ConstantSize>(size);
  }
  if (kind != SizeKind::Tree) throw BadContext("what pieces share is damaged");
  return std::make_unique<SizeTree>(SizeTree::fromParts([&](auto&... parts) { (reader.pass(parts), ...); }));
}

}  // namespace

std::string contextBytes(const Pslg& pslg, const RefineOptions& options, const InputCorners* corners) {
  ByteWriter writer;
  writer.pass(pslg);
  writer.pass(options);
  passSize(writer, options.size);
  writer.pass(corners != nullptr);
  if (corners != nullptr) writer.pass(std::vector<InputCorner>(corners->all().begin(), corners->all().end()));
  return writer.take();
}

PieceContext contextFrom(std::string_view bytes) {
  BasicByteReader<BadContext> reader(bytes, "what pieces share");
  PieceContext context;
  bool with_corners = false;
  reader.pass(context.pslg);
  reader.pass(context.options);
  context.size = sizeFrom(reader);
  context.options.size = context.size.get();
  reader.pass(with_corners);
  if (with_corners) {
    std::vector<InputCorner> corners;
    reader.pass(corners);
    context.corners = std::make_shared<const InputCorners>(std::move(corners));
  }
  if (!reader.atEnd()) throw BadContext("what pieces share is longer than it should be");
  return context;
}

}  // namespace coastmesh
