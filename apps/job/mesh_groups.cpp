#include "apps/job/mesh_groups.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <utility>

#include "apps/job/deal_groups.hpp"
#include "apps/job/group_bytes.hpp"
#include "apps/job/memory_share.hpp"
#include "apps/job/mesh_group.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/grid_edit.hpp"
#include "parallel/available_memory.hpp"
#include "parallel/free_memory.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

std::uint64_t combineDigests(std::uint64_t digest, std::uint64_t next) {
  return std::rotl((digest ^ next) * 0x9E3779B97F4A7C15ull, 31);
}

namespace {

// Groups of up to this many points are taken in order, so that their results can be merged at once.
constexpr std::size_t kSmallGroup = 1024;

// A group's share of the budget, by points: fixed, so that no group waits for what another leaves.
std::uint64_t vertexBudget(std::uint64_t whole, std::size_t points, std::size_t all_points) {
  if (points >= all_points || whole == std::numeric_limits<std::uint64_t>::max()) return whole;
  return static_cast<std::uint64_t>(static_cast<double>(whole) * static_cast<double>(points) /
                                    static_cast<double>(all_points));
}

// Combined progress of the groups, weighted by their points.
class GroupProgress {
 public:
  GroupProgress(const std::vector<std::size_t>& weights, const JobControl& control)
      : weights_(weights), shares_(weights.size(), 0.0), control_(control) {
    total_ = std::max(1.0, static_cast<double>(std::accumulate(weights.begin(), weights.end(), std::size_t{0})));
  }

  void report(std::size_t group, double share) {
    if (!control_.progress) return;
    const std::lock_guard lock(mutex_);
    const double gained = share - shares_[group];
    if (!(gained > 0.0)) return;
    shares_[group] = share;
    done_ += gained * static_cast<double>(weights_[group]);
    control_.progress("refine", std::min(1.0, done_ / total_));
  }

 private:
  const std::vector<std::size_t>& weights_;
  std::vector<double> shares_;
  const JobControl& control_;
  std::mutex mutex_;
  double total_ = 1.0;
  double done_ = 0.0;
};

void addRefusal(const JobInput& input, std::size_t group, GroupResult&& part, MeshJobResult& result) {
  Refusal refusal;
  for (std::size_t member : input.members(group)) {
    refusal.fids.push_back(input.coastline().features[member].fid);
  }
  refusal.source = input.coastline().features[input.members(group).front()].source;
  refusal.reason = std::move(part.refusal);
  refusal.place = part.refusal_place;
  refusal.over_budget = part.over_budget;
  refusal.lacks_memory = part.lacks_memory;
  result.refusals.push_back(std::move(refusal));
}

// The number of the group's features that a frame or --water-at may leave out: all but guests such as constraints.
std::uint64_t shoresOf(const JobInput& input, std::size_t group) {
  return static_cast<std::uint64_t>(std::ranges::count_if(input.members(group), [&input](std::size_t member) {
    const FeatureUse use = input.coastline().features[member].use;
    return use == FeatureUse::Area || use == FeatureUse::Land || use == FeatureUse::Coast;
  }));
}

void addGroup(const JobInput& input, std::size_t group, GroupResult&& part, MeshJobResult& result,
              Stage& small_groups) {
  for (std::size_t kind = 0; kind < kEditKinds; ++kind) result.edits[kind] += part.edits[kind];
  for (const Edit& edit : part.edit_places)
    result.edited.try_emplace(edit.feature, input.coastline().features[edit.feature].source);
  std::ranges::move(part.edit_places, std::back_inserter(result.edit_places));
  result.seconds.clean += part.clean_s;
  result.estimated_vertices += part.estimated_vertices;
  std::ranges::move(part.notes, std::back_inserter(result.read.notes));
  std::ranges::move(part.warnings, std::back_inserter(result.read.warnings));
  if (!part.unwanted.empty()) {
    result.read.beyond_frame += shoresOf(input, group);
    result.last_unwanted = part.unwanted;
    return;
  }
  if (!part.refusal.empty()) {
    addRefusal(input, group, std::move(part), result);
    return;
  }
  ++result.regions;
  for (const std::string& text : part.idle) ++result.idle[text];
  result.took_part.insert(part.took_part.begin(), part.took_part.end());
  result.waters.append(std::move(part.waters));
  result.raised_shore.add(part.raised_shore);
  result.asked.insert(result.asked.end(), part.asked.begin(), part.asked.end());
  result.pieces += part.pieces;
  if (part.pieces > 1) {
    result.log.append(std::move(part.log));
  } else {
    small_groups.items.push_back(part.log.work());
  }
  ++result.projections[part.projection.substr(0, part.projection.find(','))];
  if (result.regions == 1) {
    result.first_projection = part.projection;
    result.first_projection_reason = part.projection_reason;
  }
  ++result.surfaces[part.surface];
  result.least_scale = std::min(result.least_scale, part.least_scale);
  result.greatest_scale = std::max(result.greatest_scale, part.greatest_scale);
  result.refine.add(part.refine);
  result.short_of.add(std::move(part.short_of));
  result.quality.add(part.quality);
  if (part.input_area_m2) result.input_area_m2 = result.input_area_m2.value_or(0.0) + *part.input_area_m2;
  result.digest = result.regions == 1 ? part.digest : combineDigests(result.digest, part.digest);
  result.seconds.triangulate += part.mesh_s.triangulate;
  result.seconds.size += part.size_s;
  result.seconds.refine += part.mesh_s.refine;
  result.seconds.coarsen += part.mesh_s.coarsen;
  result.seconds.optimise += part.mesh_s.optimise;
  result.seconds.stitch += part.mesh_s.stitch;
  result.seconds.check += part.check_s;
  const std::uint32_t first_piece = result.next_piece;
  if (!part.grid.piece_of.empty()) result.next_piece += std::ranges::max(part.grid.piece_of) + 1;
  appendGrid(result.grid, std::move(part.grid), first_piece);
}

// The result of a group that waits for those before it. Half a million small ones may wait for a large one: as bytes
// they take less than half the memory.
class WaitingGroup {
 public:
  explicit WaitingGroup(GroupResult&& result) {
    if (result.pieces > 1) {
      whole_ = std::make_unique<GroupResult>(std::move(result));
    } else {
      const std::string bytes = bytesOf(result);
      bytes_.assign(bytes.begin(), bytes.end());
    }
  }
  GroupResult take() { return whole_ ? std::move(*whole_) : groupFrom({bytes_.data(), bytes_.size()}, "a group"); }

 private:
  std::unique_ptr<GroupResult> whole_;  // of a group that was cut, whose log is used
  std::vector<char> bytes_;             // no spare capacity
};

// Merges the groups' results in order, each as soon as all before it are there.
class OrderedMerge {
 public:
  // Of groups: each of a million lakes may have one.
  static constexpr std::size_t kMostWarnings = 20;

  // Groups that are not `expected` are skipped.
  OrderedMerge(const JobInput& input, const std::vector<bool>& expected, MeshJobResult& result)
      : input_(input), expected_(expected), result_(result), waiting_(input.groups()) {
    passUnexpected();
  }

  const std::vector<MergedGroup>& merged() const { return merged_; }

  void add(std::size_t group, GroupResult&& part) {
    if (!isNext(group)) {
      auto held = std::make_unique<WaitingGroup>(std::move(part));
      const std::lock_guard lock(mutex_);
      waiting_[group] = std::move(held);
      const double before = threadSeconds();
      mergeWaiting();
      merging_s_ += threadSeconds() - before;
      return;
    }
    const std::lock_guard lock(mutex_);
    const double before = threadSeconds();
    merge(std::move(part));
    mergeWaiting();
    merging_s_ += threadSeconds() - before;
  }

  void finish() {
    std::ranges::sort(small_groups_.items, std::greater());
    if (!small_groups_.items.empty()) result_.log.stages.push_back(std::move(small_groups_));
    if (untold_ > 0)
      result_.read.warnings.push_back(
          std::to_string(untold_) +
          forCount(untold_, " more warning of another feature is", " more warnings of other features are") +
          " not shown");
    result_.log.addAlone("stitch", merging_s_);
    result_.seconds.stitch += merging_s_;
  }

 private:
  // Once true, it stays true until the group is added.
  bool isNext(std::size_t group) {
    const std::lock_guard lock(mutex_);
    return group == next_;
  }
  void passUnexpected() {
    while (next_ < waiting_.size() && !expected_[next_]) ++next_;
  }
  void merge(GroupResult&& part) {
    while (!part.warnings.empty() && told_ + part.warnings.size() > kMostWarnings) {
      part.warnings.pop_back();
      ++untold_;
    }
    told_ += part.warnings.size();
    if (part.size_max) merged_.push_back(placeOf(part));
    addGroup(input_, next_, std::move(part), result_, small_groups_);
    ++next_;
    passUnexpected();
  }
  // Of the next group in the grid.
  MergedGroup placeOf(const GroupResult& part) const {
    return {next_,
            *part.size_max,
            static_cast<std::uint32_t>(result_.grid.features.size()),
            static_cast<std::uint32_t>(result_.grid.nodes.size()),
            static_cast<std::uint32_t>(part.grid.nodes.size() - part.refine.steiner_points),
            part.input_area_m2};
  }
  void mergeWaiting() {
    while (next_ < waiting_.size() && waiting_[next_]) {
      const std::unique_ptr<WaitingGroup> held = std::move(waiting_[next_]);
      merge(held->take());
    }
  }

  std::size_t told_ = 0, untold_ = 0;  // warnings
  const JobInput& input_;
  const std::vector<bool>& expected_;
  MeshJobResult& result_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<WaitingGroup>> waiting_;
  Stage small_groups_{"regions", 0.0, {}};
  std::vector<MergedGroup> merged_;
  std::size_t next_ = 0;
  double merging_s_ = 0.0;
};

// Large groups first: one that is left for the end would leave other threads idle.
std::vector<std::size_t> workOrder(const std::vector<std::size_t>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rank = [&points](std::size_t g) { return std::max(points[g], kSmallGroup); };
  std::ranges::stable_sort(order, [&rank](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
  return order;
}

// Memory of the groups of a run. As many groups as there are threads are meshed at once, each within its share; those
// that need more are meshed afterwards, one by one, with all that finished groups leave. Hence together they never take
// more than there is, and which groups are refused does not depend on the others.
class GroupMemory {
 public:
  GroupMemory(double whole, const Together& together) : whole_(whole), together_(together) {}

  double shareOf(std::size_t points) const { return memoryShare(whole_, points, together_); }
  double left() const { return whole_ - held_; }
  // Throws InputError if finished groups alone take more than there is.
  void hold(const Grid& grid) {
    const double bytes = bytesHeldBy(grid);
    const std::lock_guard lock(mutex_);
    held_ += bytes;
    if (held_ > whole_)
      throw InputError(
          "all features together have a mesh that takes more memory than there is: request larger sizes, or mesh a "
          "share of the features at a time (--shard)");
  }

 private:
  double whole_, held_ = 0.0;
  Together together_;
  std::mutex mutex_;
};

}  // namespace

std::vector<MergedGroup> meshGroups(const MeshJob& job, const JobInput& input, const SizeInputs& sizes,
                                    const JobControl& control, MeshJobResult& result) {
  std::vector<std::size_t> points(input.groups());
  for (std::size_t g = 0; g < points.size(); ++g) points[g] = input.pointsOf(g);
  const std::size_t all_points = input.pointsInFrame();
  const GroupExchange& exchange = job.exchange;
  if (exchange.begin) exchange.begin(input.digest(), input.groups());
  std::vector<std::size_t> order = workOrder(points);
  std::vector<bool> expected(input.groups(), true);
  if (exchange.shards > 1) {
    const std::vector<std::uint32_t> shard_of = dealGroups(points, exchange.shards);
    for (std::size_t g = 0; g < expected.size(); ++g) expected[g] = shard_of[g] == exchange.shard;
    std::erase_if(order, [&expected](std::size_t g) { return !expected[g]; });
  }
  std::vector<std::size_t> weights = points;
  for (std::size_t g = 0; g < weights.size(); ++g)
    if (!expected[g]) weights[g] = 0;
  GroupProgress progress(weights, control);
  OrderedMerge merge(input, expected, result);
  const std::size_t own_points = std::accumulate(weights.begin(), weights.end(), std::size_t{0});
  GroupMemory memory(job.memory ? *job.memory : availableMemory(),
                     {order.size(), own_points, static_cast<std::size_t>(threadCount())});
  constexpr double kWorthSaying = 3e6;  // vertices: some ten seconds
  const auto expects = [&control](double vertices) {
    if (control.expects && vertices >= kWorthSaying) control.expects(vertices);
  };
  // Returns false if the group lacks memory, unless `in_the_end`: then it is refused.
  const auto make = [&](std::size_t g, double room, bool in_the_end) {
    const std::uint64_t budget = vertexBudget(job.mesh.refine.max_vertices, points[g], all_points);
    const RunControl inner{control.cancelled, [&progress, g](double share) { progress.report(g, share); }};
    const bool taken = exchange.take && (!exchange.has || exchange.has(g));
    GroupResult part = taken ? exchange.take(g) : meshGroup(job, input, sizes, g, {budget, room, expects}, inner);
    if (part.lacks_memory && !in_the_end) return false;
    if (exchange.keep) exchange.keep(g, part);
    memory.hold(part.grid);
    const bool large = part.pieces > 1;
    merge.add(g, std::move(part));
    // Many small results may have waited for it.
    if (large) giveBackFreeMemory();
    progress.report(g, 1.0);
    return true;
  };
  std::mutex mutex;
  std::vector<std::size_t> left;
  forEachItem(order.size(), RunControl{control.cancelled, {}}, [&](std::size_t i) {
    const std::size_t g = order[i];
    if (make(g, memory.shareOf(points[g]), order.size() == 1)) return;
    const std::lock_guard lock(mutex);
    left.push_back(g);
  });
  std::ranges::sort(left);
  for (const std::size_t g : left) {
    giveBackFreeMemory();
    make(g, memory.left(), true);
  }
  merge.finish();
  return merge.merged();
}

}  // namespace coastmesh
