#pragma once

#include <sys/mman.h>

#include <new>
#include <stdexcept>
#include <type_traits>

namespace coastmesh {

// A plain struct in memory shared by a process and its children.
template <typename T>
requires std::is_trivially_copyable_v<T>
class SharedBlock {
 public:
  SharedBlock() : at_(mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (at_ == MAP_FAILED) throw std::runtime_error("no memory to share with a child process");
    new (at_) T{};
  }
  ~SharedBlock() { munmap(at_, sizeof(T)); }
  SharedBlock(const SharedBlock&) = delete;
  SharedBlock& operator=(const SharedBlock&) = delete;

  T& operator*() { return *static_cast<T*>(at_); }
  T* operator->() { return static_cast<T*>(at_); }

 private:
  void* at_;
};

}  // namespace coastmesh
