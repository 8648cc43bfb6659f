#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include "cluster/transport.hpp"

namespace coastmesh {

namespace {

// A message is sent as a header, then its bytes in parts that fit MPI's counts.
constexpr int kHeaderTag = 1, kBytesTag = 2;
constexpr std::size_t kPart = std::size_t{1} << 30;
using Header = std::array<std::uint64_t, 5>;  // kind, region, number, outcome, number of bytes

// A message whose transfer is pending.
struct Sending {
  Header header;
  std::shared_ptr<const std::string> bytes;
  std::vector<MPI_Request> requests;
};

// MPI errors abort all ranks, as is MPI's default.
class MpiTransport final : public Transport {
 public:
  MpiTransport() {
    int given = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    if (given < MPI_THREAD_FUNNELED) {
      MPI_Finalize();
      throw CannotJoin("this MPI does not allow a program with several threads");
    }
    MPI_Comm_dup(MPI_COMM_WORLD, &world_);
    MPI_Comm_rank(world_, &rank_);
    MPI_Comm_size(world_, &ranks_);
  }

  int rank() const override { return rank_; }
  int ranks() const override { return ranks_; }
  std::string host() const override {
    std::string name(MPI_MAX_PROCESSOR_NAME, '\0');
    int length = 0;
    MPI_Get_processor_name(name.data(), &length);
    name.resize(static_cast<std::size_t>(length));
    return name;
  }
  std::string library() const override {
    std::string name(MPI_MAX_LIBRARY_VERSION_STRING, '\0');
    int length = 0;
    MPI_Get_library_version(name.data(), &length);
    name.resize(static_cast<std::size_t>(length));
    return name.substr(0, name.find_first_of(",\n\t"));
  }

  bool agree(std::uint64_t what) override {
    const std::array<std::uint64_t, 2> mine{what, ~what};
    std::array<std::uint64_t, 2> least{};
    MPI_Allreduce(mine.data(), least.data(), 2, MPI_UINT64_T, MPI_MIN, world_);
    return least == mine;
  }

  void send(int to, Message&& message) override {
    Sending& sending = sending_.emplace_back();
    const std::size_t size = message.bytes ? message.bytes->size() : 0;
    sending.header = {static_cast<std::uint64_t>(message.kind), message.region, message.number, message.outcome, size};
    sending.bytes = std::move(message.bytes);
    isend(sending, sending.header.data(), sizeof(Header), to, kHeaderTag);
    for (std::size_t at = 0; at < size; at += kPart)
      isend(sending, sending.bytes->data() + at, std::min(kPart, size - at), to, kBytesTag);
    moved_ += sizeof(Header) + size;
  }

  bool receive(Message& message, int& from) override {
    int waits = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kHeaderTag, world_, &waits, &status);
    if (waits == 0) return false;
    from = status.MPI_SOURCE;
    Header header{};
    MPI_Recv(header.data(), sizeof(Header), MPI_BYTE, from, kHeaderTag, world_, MPI_STATUS_IGNORE);
    std::string bytes(header[4], '\0');
    for (std::size_t at = 0; at < bytes.size(); at += kPart)
      MPI_Recv(bytes.data() + at, static_cast<int>(std::min(kPart, bytes.size() - at)), MPI_BYTE, from, kBytesTag,
               world_, MPI_STATUS_IGNORE);
    moved_ += sizeof(Header) + bytes.size();
    message = {static_cast<Message::Kind>(header[0]), header[1], header[2], header[3],
               std::make_shared<const std::string>(std::move(bytes))};
    return true;
  }

  bool isIdle() override {
    std::erase_if(sending_, [](Sending& sending) {
      int gone = 0;
      MPI_Testall(static_cast<int>(sending.requests.size()), sending.requests.data(), &gone, MPI_STATUSES_IGNORE);
      return gone != 0;
    });
    return sending_.empty();
  }
  std::uint64_t bytesMoved() const override { return moved_; }

  void finish() override {
    MPI_Comm_free(&world_);
    MPI_Finalize();
  }
  [[noreturn]] void abort(int exit_code) override {
    MPI_Abort(MPI_COMM_WORLD, exit_code);
    std::_Exit(exit_code);
  }

 private:
  void isend(Sending& sending, const void* bytes, std::size_t size, int to, int tag) {
    MPI_Isend(bytes, static_cast<int>(size), MPI_BYTE, to, tag, world_, &sending.requests.emplace_back());
  }

  MPI_Comm world_ = MPI_COMM_NULL;
  int rank_ = 0, ranks_ = 1;
  std::uint64_t moved_ = 0;
  std::list<Sending> sending_;
};

}  // namespace

std::unique_ptr<Transport> joinRanks() { return std::make_unique<MpiTransport>(); }

}  // namespace coastmesh
