#include "cluster/cluster.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace coastmesh {

namespace {

// One piece per thread, and up to eight more, one per thread, so that the next is there when one is done.
int roomsOf(std::uint64_t threads) { return static_cast<int>(threads + std::min<std::uint64_t>(threads, 8)); }

std::shared_ptr<const std::string> shared(std::string&& bytes) {
  return std::make_shared<const std::string>(std::move(bytes));
}

}  // namespace

Cluster::Cluster(Post& post, std::function<bool()> stopped)
    : post_(post),
      stopped_(std::move(stopped)),
      rooms_(static_cast<std::size_t>(post.ranks()), 0),
      peak_mib_(rooms_.size(), 0.0) {
  helpers_.begin = [this](std::string&& context) {
    std::uint32_t region = 0;
    {
      const std::lock_guard lock(mutex_);
      region = regions_++;
    }
    post_.sendToOthers({Message::Kind::Begin, region, 0, 0, shared(std::move(context))});
    return region;
  };
  helpers_.end = [this](std::uint32_t region) { post_.sendToOthers({Message::Kind::End, region, 0, 0, {}}); };
  helpers_.reserve = [this] {
    const std::lock_guard lock(mutex_);
    const auto most = std::ranges::max_element(rooms_);
    if (*most <= 0) return -1;
    --*most;
    return static_cast<int>(most - rooms_.begin());
  };
  helpers_.send = [this](int room, std::uint32_t region, std::string&& request, std::function<void(Reply &&)> take) {
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(mutex_);
      number = requests_++;
      ++pieces_;
      awaited_.emplace(number, Awaited{std::move(take), true});
    }
    post_.send(room, {Message::Kind::Request, region, number, 0, shared(std::move(request))});
  };
  helpers_.ask = [this](int rank, std::string&& request, std::function<void(Reply &&)> take) {
    std::uint64_t number = 0;
    {
      const std::lock_guard lock(mutex_);
      number = requests_++;
      awaited_.emplace(number, Awaited{std::move(take), false});
    }
    post_.send(rank, {Message::Kind::Ask, 0, number, 0, shared(std::move(request))});
  };
  helpers_.use = [this] {
    const std::lock_guard lock(mutex_);
    return HelpersUse{post_.ranks(), pieces_, post_.bytesMoved(), peak_mib_};
  };
  post_.listen([this](Message&& message, int from) { take(std::move(message), from); });
}

Cluster::~Cluster() {
  // Far longer than any piece takes: a rank that has not answered by then is dead or frozen.
  constexpr auto kLook = std::chrono::milliseconds(50), kPatience = std::chrono::milliseconds(60'000);
  post_.sendToOthers({Message::Kind::Stop, 0, 0, 0, {}});
  bool all_gone = false;
  {
    // Replies that are no longer awaited may still be on their way.
    const auto end = std::chrono::steady_clock::now() + kPatience;
    std::unique_lock lock(mutex_);
    const auto areGone = [this] { return gone_ + 1 >= post_.ranks(); };
    while (!areGone() && !stopped_() && std::chrono::steady_clock::now() < end) changed_.wait_for(lock, kLook);
    all_gone = areGone();
  }
  stopped_() || !all_gone ? post_.leave() : post_.finish();
}

void Cluster::start(int threads) {
  post_.sendToOthers({Message::Kind::Start, 0, static_cast<std::uint64_t>(threads), 0, {}});
}

void Cluster::take(Message&& message, int from) {
  std::function<void(Reply &&)> keep;
  {
    const std::lock_guard lock(mutex_);
    int& rooms = rooms_[static_cast<std::size_t>(from)];
    constexpr double kKibOfMib = 1024.0;
    if (message.kind == Message::Kind::Ready || message.kind == Message::Kind::Reply)
      peak_mib_[static_cast<std::size_t>(from)] = static_cast<double>(message.region) / kKibOfMib;
    if (message.kind == Message::Kind::Ready) {
      rooms = roomsOf(message.number);
      return;
    }
    if (message.kind == Message::Kind::Gone) {
      ++gone_;
      rooms = 0;
      changed_.notify_all();
      return;
    }
    const auto awaited = awaited_.find(message.number);
    if (message.kind != Message::Kind::Reply || awaited == awaited_.end()) return;
    keep = std::move(awaited->second.take);
    rooms += awaited->second.has_room ? 1 : 0;
    awaited_.erase(awaited);
  }
  keep({static_cast<Reply::Outcome>(message.outcome), *message.bytes});
}

}  // namespace coastmesh
