#include "cluster/serve.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>
#include <utility>

#include "parallel/deal.hpp"
#include "parallel/piece_context.hpp"
#include "parallel/piece_task.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

// The shared context of a region's pieces, decoded by the first thread that needs it.
class SharedContext {
 public:
  explicit SharedContext(std::shared_ptr<const std::string> bytes) : bytes_(std::move(bytes)) {}

  const PieceContext& get() {
    const std::lock_guard lock(mutex_);
    if (!context_) {
      context_ = contextFrom(*bytes_);
      bytes_ = nullptr;
    }
    return *context_;
  }

 private:
  std::mutex mutex_;
  std::shared_ptr<const std::string> bytes_;
  std::optional<PieceContext> context_;
};

class Server {
 public:
  Server(Post& post, const ServeOptions& options) : post_(post), options_(options) {
    post_.listen([this](Message&& message, int) { take(std::move(message)); });
  }

  bool run() {
    const std::optional<int> threads = awaitStart();
    if (!threads) return !options_.stopped();
    withThreads({.threads = *threads}, [&] {
      const int count = threadCount();
      post_.send(0, {Message::Kind::Ready, peakKib(), static_cast<std::uint64_t>(count), 0, {}});
      forEachItem(static_cast<std::size_t>(count), {}, [&](std::size_t) { work(); });
    });
    return !options_.stopped();
  }

 private:
  struct Job {
    std::shared_ptr<SharedContext> context;
    Message request;
  };

  // Called by the post.
  void take(Message&& message) {
    {
      const std::lock_guard lock(mutex_);
      switch (message.kind) {
        case Message::Kind::Start:
          threads_ = static_cast<int>(message.number);
          break;
        case Message::Kind::Begin:
          regions_[message.region] = std::make_shared<SharedContext>(std::move(message.bytes));
          break;
        case Message::Kind::End:
          regions_.erase(message.region);
          break;
        case Message::Kind::Request:
          jobs_.push_back({regions_[message.region], std::move(message)});
          break;
        case Message::Kind::Ask:
          jobs_.push_back({nullptr, std::move(message)});
          break;
        default:
          done_ = true;
      }
    }
    changed_.notify_all();
  }

  // True if it is time to end. Called under the lock.
  bool isOver() const { return done_ || options_.stopped(); }

  template <typename Ready>
  bool await(std::unique_lock<std::mutex>& lock, const Ready& ready) {
    constexpr auto kLook = std::chrono::milliseconds(50);
    while (!isOver() && !ready()) changed_.wait_for(lock, kLook);
    return !isOver();
  }

  std::optional<int> awaitStart() {
    std::unique_lock lock(mutex_);
    if (!await(lock, [&] { return threads_.has_value(); })) return std::nullopt;
    return threads_;
  }

  void work() {
    const RunControl control{[this] {
                               const std::lock_guard lock(mutex_);
                               return isOver();
                             },
                             {}};
    for (;;) {
      Job job;
      {
        std::unique_lock lock(mutex_);
        if (!await(lock, [&] { return !jobs_.empty(); })) return;
        job = std::move(jobs_.front());
        jobs_.pop_front();
      }
      Reply reply;
      try {
        reply = answer(job, control);
      } catch (const Cancelled&) {
        return;
      }
      auto bytes = std::make_shared<const std::string>(std::move(reply.bytes));
      post_.send(0, {Message::Kind::Reply, peakKib(), job.request.number, static_cast<std::uint64_t>(reply.outcome),
                     std::move(bytes)});
    }
  }

  std::uint64_t peakKib() const {
    constexpr double kKibOfMib = 1024.0;
    return static_cast<std::uint64_t>(options_.peak_mib() * kKibOfMib);
  }

  Reply answer(const Job& job, const RunControl& control) const {
    const std::string who = "rank " + std::to_string(post_.rank()) + " on " + post_.host() + ": ";
    try {
      Reply reply;
      if (job.request.kind == Message::Kind::Ask)
        reply = options_.answer(*job.request.bytes);
      else
        reply.bytes = answerPiece(*job.request.bytes, job.context->get(), control);
      if (options_.memory_lacked()) throw std::bad_alloc();
      if (reply.outcome != Reply::Outcome::Done) reply.bytes.insert(0, who);
      return reply;
    } catch (const Cancelled&) {
      throw;
    } catch (const std::bad_alloc&) {
      return {Reply::Outcome::NoMemory, who + "there is not enough memory"};
    } catch (const std::exception& error) {
      return {Reply::Outcome::Failed, who + error.what()};
    }
  }

  Post& post_;
  const ServeOptions& options_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<int> threads_;
  bool done_ = false;
  std::map<std::uint64_t, std::shared_ptr<SharedContext>> regions_;
  std::deque<Job> jobs_;
};

}  // namespace

bool serveRankZero(Post& post, const ServeOptions& options) {
  Server server(post, options);
  const bool sent_away = server.run();
  if (sent_away) {
    post.send(0, {Message::Kind::Gone, 0, 0, 0, {}});
    post.finish();
  } else {
    post.leave();
  }
  return sent_away;
}

}  // namespace coastmesh
