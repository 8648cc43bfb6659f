#include "parallel/deal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "core/size/size_tree.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/piece_context.hpp"
#include "parallel/piece_task.hpp"
#include "parallel/workers.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// Helpers as threads. They get a region only as context bytes, and pieces only as request bytes.
class ThreadHelpers {
 public:
  explicit ThreadHelpers(int rooms) : rooms_(rooms) {
    helpers.begin = [this](std::string&& context) {
      const std::lock_guard lock(mutex_);
      contexts_.push_back(std::make_shared<const PieceContext>(contextFrom(context)));
      return static_cast<std::uint32_t>(contexts_.size() - 1);
    };
    helpers.end = [this](std::uint32_t region) {
      const std::lock_guard lock(mutex_);
      contexts_[region] = nullptr;
    };
    helpers.reserve = [this] {
      int free = rooms_.load();
      while (free > 0 && !rooms_.compare_exchange_weak(free, free - 1)) continue;
      return free > 0 ? 0 : -1;
    };
    helpers.send = [this](int, std::uint32_t region, std::string&& request, std::function<void(Reply &&)> take) {
      const std::lock_guard lock(mutex_);
      threads_.emplace_back([this, context = contexts_[region], request = std::move(request), take = std::move(take)] {
        Reply reply{outcome, "no disk"};
        if (before_answer) before_answer();
        if (outcome == Reply::Outcome::Done) reply.bytes = answerPiece(request, *context, {});
        if (kept_share < 1.0) reply.bytes.resize(static_cast<std::size_t>(kept_share * double(reply.bytes.size())));
        ++answered;
        ++rooms_;
        take(std::move(reply));
      });
    };
  }
  ~ThreadHelpers() {
    for (std::thread& thread : threads_) thread.join();
  }

  Helpers helpers;
  Reply::Outcome outcome = Reply::Outcome::Done;
  double kept_share = 1.0;  // share of each reply's bytes that is sent
  std::function<void()> before_answer;
  std::atomic<int> answered = 0;

 private:
  std::atomic<int> rooms_;
  std::mutex mutex_;
  std::vector<std::shared_ptr<const PieceContext>> contexts_;
  std::vector<std::thread> threads_;
};

// Lengths that grow with the distance from the origin.
class GrowingSizes final : public SizeSource {
 public:
  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = sizeAt(places[i]);
  }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double at = sizeAt(boxes[i].centre), reach = 1.5 * kSlope * boxes[i].half;
      ranges[i] = {std::max(kLeast, at - reach), at + reach};
    }
  }

 private:
  static constexpr double kLeast = 0.004, kSlope = 0.01;
  static double sizeAt(const Point& p) { return kLeast + kSlope * std::hypot(p.x, p.y); }
};

const SizeTree& growingSizes() {
  static const SizeTree tree({-3.0, -3.0}, {3.0, 3.0}, GrowingSizes(), {});
  return tree;
}

struct Case {
  const char* name;
  Pslg pslg;
  MeshOptions options;
};

std::vector<Case> cases() {
  static const ConstantSize one(0.004);
  std::vector<Case> all(5);
  all[0].name = "Coast", all[0].pslg = fractalCoast(1, 6, 8);
  all[1].name = "CoastWithSize", all[1].pslg = fractalCoast(2, 3, 3), all[1].options.refine.size_max = 0.01;
  all[2].name = "TwoRegions", all[2].pslg = twoRegions(), all[2].options.refine.size_max = 0.005;
  all[3].name = "OneLength", all[3].pslg = fractalCoast(1, 6, 3), all[3].options.refine.size = &one;
  all[4].name = "Graded", all[4].pslg = fractalCoast(3, 3, 3), all[4].options.refine.size = &growingSizes();
  for (Case& c : all) c.options.refine.min_angle_deg = 28.0;
  return all;
}

MeshedRegion meshed(const Case& c, int threads, const Helpers* helpers, const RunControl& control = {}) {
  MeshedRegion region;
  withThreads({.threads = threads}, [&] {
    MeshOptions options = c.options;
    options.helpers = helpers;
    region = meshRegion(c.pslg, options, control);
  });
  return region;
}

TEST(Deal, HelpersChangeNoBit) {
  for (const Case& c : cases()) {
    const MeshedRegion alone = meshed(c, 2, nullptr);
    for (const int rooms : {1, 3}) {
      ThreadHelpers others(rooms);
      const MeshedRegion helped = meshed(c, 2, &others.helpers);
      EXPECT_EQ(digestOf(helped.mesh), digestOf(alone.mesh)) << c.name;
      EXPECT_EQ(helped.pieces, alone.pieces) << c.name;
      EXPECT_EQ(helped.stats.removals, alone.stats.removals) << c.name;
      EXPECT_GT(others.answered, 0) << c.name;
    }
  }
}

TEST(Deal, AHelperThatFailsIsAnError) {
  const Case c = cases().front();
  ThreadHelpers others(2);
  others.outcome = Reply::Outcome::Failed;
  EXPECT_THROW(meshed(c, 2, &others.helpers), HelperFailed);
  others.outcome = Reply::Outcome::NoMemory;
  EXPECT_THROW(meshed(c, 2, &others.helpers), HelperOutOfMemory);
  EXPECT_GT(others.answered, 0);
}

TEST(Deal, ACutReplyIsAnError) {
  const Case c = cases().front();
  for (const double share : {0.0, 0.3, 0.999}) {
    ThreadHelpers others(2);
    others.kept_share = share;
    EXPECT_THROW(meshed(c, 2, &others.helpers), std::runtime_error) << share;
  }
}

TEST(Deal, IsCancelledWhileHelpersWork) {
  const Case c = cases().front();
  std::atomic<bool> stop = false;
  ThreadHelpers others(2);  // declared after `stop`: the destructor joins the threads that set it
  others.before_answer = [&] {
    stop = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  };
  EXPECT_THROW(meshed(c, 2, &others.helpers, {[&] { return stop.load(); }, {}}), Cancelled);
}

// Owned items ---------------------------------------------------------------------------------------------------------

// Helpers that answer with their rank and the request.
Helpers echoes(std::vector<std::thread>& threads, Reply::Outcome outcome = Reply::Outcome::Done) {
  Helpers helpers;
  helpers.ask = [&threads, outcome](int rank, std::string&& request, std::function<void(Reply &&)> take) {
    threads.emplace_back([=, request = std::move(request), take = std::move(take)] {
      take({outcome, std::to_string(rank) + request});
    });
  };
  return helpers;
}

TEST(DealToOwners, EveryItemIsDoneByItsOwner) {
  std::vector<std::thread> threads;
  const Helpers helpers = echoes(threads);
  const std::vector<int> owners{0, 2, 1, 0, 2};
  std::vector<std::string> done(owners.size());
  dealToOwners(helpers, owners, {}, inOrder,
               {{},
                [](std::size_t i) { return "/" + std::to_string(i); },
                [&](std::size_t i) { done[i] = "here"; },
                [&](std::size_t i, Reply&& reply) { done[i] = reply.bytes; }});
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(done, (std::vector<std::string>{"here", "2/1", "1/2", "here", "2/4"}));
}

TEST(DealToOwners, AReplyThatIsNotTakenIsAnError) {
  std::vector<std::thread> threads;
  const Helpers helpers = echoes(threads, Reply::Outcome::BadInput);
  const std::vector<int> owners{1, 1};
  const auto deal = [&] {
    dealToOwners(helpers, owners, {}, inOrder,
                 {{},
                  [](std::size_t) { return std::string(); },
                  [](std::size_t) {},
                  [](std::size_t, Reply&& reply) { throw std::runtime_error(reply.bytes); }});
  };
  EXPECT_THROW(deal(), std::runtime_error);
  for (std::thread& thread : threads) thread.join();
}

TEST(DealToOwners, IsCancelledWhileItWaits) {
  std::vector<std::function<void(Reply &&)>> kept;  // never called
  Helpers helpers;
  helpers.ask = [&](int, std::string&&, std::function<void(Reply &&)> take) { kept.push_back(std::move(take)); };
  const std::vector<int> owners{1};
  const auto deal = [&] {
    dealToOwners(helpers, owners, {[] { return true; }, {}}, inOrder,
                 {{}, [](std::size_t) { return std::string(); }, [](std::size_t) {}, [](std::size_t, Reply&&) {}});
  };
  EXPECT_THROW(deal(), Cancelled);
}

}  // namespace
}  // namespace coastmesh
