#include "apps/job/raster_helpers.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "gis/error.hpp"
#include "parallel/bytes.hpp"

namespace coastmesh {

template <>
struct HasNoGaps<SizeNode> : std::true_type {};
template <>
struct HasNoGaps<PixelRect> : std::true_type {};
template <>
struct HasNoGaps<TilePlace> : std::true_type {};
static_assert(sizeof(SizeNode) == 20 && sizeof(PixelRect) == 16 && sizeof(TilePlace) == 32);

template <typename T, typename Of>
concept IsA = std::is_same_v<std::remove_cvref_t<T>, Of>;

auto partsOf(IsA<DepthBand> auto& band) { return std::tie(band.from_m, band.to_m, band.size_m); }
auto partsOf(IsA<DepthRules> auto& rules) {
  auto& [positive_down, water_level_m, least_depth_m, period_s, wave_elements, crossing_s, slope_elements,
         slope_filter_m, bands] = rules;
  return std::tie(positive_down, water_level_m, least_depth_m, period_s, wave_elements, crossing_s, slope_elements,
                  slope_filter_m, bands);
}
auto partsOf(IsA<SizeRule> auto& rule) {
  auto& [kind, depths, time_step_s, courant] = rule;
  return std::tie(kind, depths, time_step_s, courant);
}
auto partsOf(IsA<PixelPatch> auto& patch) { return std::tie(patch.at, patch.values); }
auto partsOf(IsA<TileTask> auto& task) {
  auto& [path, columns, rows, rules, tiles, own, patches, strips] = task;
  return std::tie(path, columns, rows, rules, tiles, own, patches, strips);
}

auto partsOf(IsA<PixelTask> auto& task) { return std::tie(task.path, task.columns, task.rows, task.windows); }

namespace {

enum class Asked : std::uint8_t { Tiles, Pixels };
Asked kindOf(const TileTask&) { return Asked::Tiles; }
Asked kindOf(const PixelTask&) { return Asked::Pixels; }

template <typename Task>
std::string requestFor(const Task& task) {
  ByteWriter writer;
  writer.pass(kindOf(task));
  writer.pass(task);
  return writer.take();
}

using Reader = BasicByteReader<std::runtime_error>;

template <typename Pass, typename Answer>
void passAnswer(Pass& bytes, Answer& answer) {
  if constexpr (std::is_same_v<std::remove_cvref_t<Answer>, TileAnswer>) {
    bytes.pass(answer.tiles);
    bytes.pass(answer.strips);
  } else {
    bytes.pass(answer.values);
  }
  bytes.pass(answer.use.bytes);
}

template <typename Answer>
std::string bytesOf(const Answer& answer) {
  ByteWriter writer;
  passAnswer(writer, answer);
  writer.pass(std::vector<std::string>(answer.use.files.begin(), answer.use.files.end()));
  return writer.take();
}

template <typename Answer>
Answer answerFrom(Reply&& reply) {
  if (reply.outcome == Reply::Outcome::NoMemory) throw HelperOutOfMemory(reply.bytes);
  if (reply.outcome == Reply::Outcome::BadInput)
    throw InputError(reply.bytes + " (all ranks read rasters: these have to lie where each of them reaches them)");
  if (reply.outcome == Reply::Outcome::Failed) throw HelperFailed(reply.bytes);
  Reader reader(reply.bytes, "a reply of a raster's pixels");
  Answer answer;
  std::vector<std::string> files;
  passAnswer(reader, answer);
  reader.pass(files);
  if (!reader.atEnd()) throw std::runtime_error("a reply of a raster's pixels is longer than it should be");
  answer.use.files.insert(files.begin(), files.end());
  return answer;
}

}  // namespace

template <typename Task>
auto RasterHelpers::read(std::span<const Task> tasks, std::span<const int> who, const ItemLoop& loop) {
  using Answer = decltype(answerTask(tasks.front()));
  std::vector<Answer> answers(tasks.size());
  const auto keep = [&](std::size_t i, Answer&& answer) {
    note(who[i], answer.use);
    answers[i] = std::move(answer);
  };
  dealToOwners(*helpers_, who, control_, loop,
               {{},
                [&](std::size_t i) { return requestFor(tasks[i]); },
                [&](std::size_t i) { keep(i, answerTask(tasks[i])); },
                [&](std::size_t i, Reply&& reply) { keep(i, answerFrom<Answer>(std::move(reply))); }});
  return answers;
}

RasterHelpers::RasterHelpers(const Helpers* helpers, const RunControl& control)
    : helpers_(helpers), control_({control.cancelled, {}}) {
  if (helpers_ == nullptr) return;
  use_.resize(static_cast<std::size_t>(helpers_->use().ranks));
  readers_.pixels.ownersOf = [this](std::span<const RasterPart> parts) { return ownersOf(parts); };
  readers_.pixels.read = [this](std::span<const PixelTask> tasks, std::span<const int> who, const ItemLoop& loop) {
    return read(tasks, who, loop);
  };
  readers_.read = [this](std::span<const TileTask> tasks, std::span<const int> who, const ItemLoop& loop) {
    return read(tasks, who, loop);
  };
}

std::vector<RasterUse> RasterHelpers::use() const {
  const std::lock_guard lock(mutex_);
  return use_;
}

// Parts without an owner are assigned in order, so that most of a part's surroundings have the same reader.
std::vector<int> RasterHelpers::ownersOf(std::span<const RasterPart> parts) {
  const std::lock_guard lock(mutex_);
  std::map<std::pair<std::string, std::size_t>, std::uint64_t> open;
  for (const RasterPart& part : parts)
    if (const std::pair key(part.raster, part.number); !owners_.contains(key)) open[key] += part.pixels;
  double all = 0.0, before = 0.0;
  for (const auto& each : open) all += static_cast<double>(each.second);
  for (const auto& [key, pixels] : open) {
    // By the position of its centre among all.
    const double middle = (before + 0.5 * static_cast<double>(pixels)) / std::max(all, 1.0);
    before += static_cast<double>(pixels);
    owners_[key] =
        static_cast<int>(std::min(middle * static_cast<double>(use_.size()), static_cast<double>(use_.size() - 1)));
  }
  std::vector<int> owners;
  for (const RasterPart& part : parts) owners.push_back(owners_.at({part.raster, part.number}));
  return owners;
}

void RasterHelpers::note(int reader, const RasterUse& use) {
  const std::lock_guard lock(mutex_);
  use_[static_cast<std::size_t>(reader)].add(use);
}

Reply answerRasterTask(std::string_view request) {
  Reader reader(request, "a request for a raster's pixels");
  Asked kind{};
  reader.pass(kind);
  const auto answerAs = [&](auto&& task) -> Reply {
    reader.pass(task);
    if (!reader.atEnd()) throw std::runtime_error("a request for a raster's pixels is longer than it should be");
    try {
      return {Reply::Outcome::Done, bytesOf(answerTask(task))};
    } catch (const InputError& error) {
      return {Reply::Outcome::BadInput, error.what()};
    }
  };
  return kind == Asked::Tiles ? answerAs(TileTask()) : answerAs(PixelTask());
}

}  // namespace coastmesh
