// malloc and its family for the whole process: definitions in a program take precedence over the C library's, for all
// libraries, operator new and the C library itself. Each calls the next definition (the C library, or an allocator,
// heap profiler or fault shim that is loaded before it) and records failures. So does pthread_create, after whose
// failure oneTBB may crash, and exit, for libraries that end the process after one. Only in the program: the libraries
// and the Python module run in other programs' processes. Inactive if a sanitizer has its own allocator, and with C
// libraries other than glibc: there only operator new is watched (apps/process/last_resort).

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define COASTMESH_OTHER_MALLOC
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define COASTMESH_OTHER_MALLOC
#endif
#endif
#ifdef __linux__
#include <features.h>  // defines __GLIBC__ for glibc
#endif

#if defined(__GLIBC__) && !defined(COASTMESH_OTHER_MALLOC)

#include <dlfcn.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>

#include "apps/process/last_resort.hpp"
#include "apps/process/memory_lacked.hpp"

extern "C" {
void* __libc_malloc(std::size_t size) noexcept;
void* __libc_calloc(std::size_t count, std::size_t size) noexcept;
void* __libc_realloc(void* memory, std::size_t size) noexcept;
void* __libc_memalign(std::size_t alignment, std::size_t size) noexcept;
}

namespace {

// The next definition of a function, looked up at the first call. `own` is the C library's, for requests of the lookup
// itself.
template <typename Function>
class Next {
 public:
  constexpr Next(const char* name, Function own) : name_(name), own_(own) {}

  Function get() noexcept {
    const Function known = known_.load(std::memory_order_relaxed);
    return known != nullptr ? known : lookUp();
  }

 private:
  [[gnu::noinline]] Function lookUp() noexcept {
    static thread_local constinit bool looking = false;
    if (looking) return own_;
    looking = true;
    const int error = errno;
    void* const found = dlsym(RTLD_NEXT, name_);
    errno = error;
    looking = false;
    const Function next = found != nullptr ? reinterpret_cast<Function>(found) : own_;
    known_.store(next, std::memory_order_relaxed);
    return next;
  }

  const char* name_;
  Function own_;
  std::atomic<Function> known_{nullptr};
};

int alignedByLibc(void** memory, std::size_t alignment, std::size_t size) noexcept {
  void* const given = __libc_memalign(alignment, size);
  if (given == nullptr) return ENOMEM;
  *memory = given;
  return 0;
}

using Start = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) noexcept;
int startedByNobody(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*) noexcept { return EAGAIN; }

constinit Next<Start> g_start{"pthread_create", startedByNobody};
constinit Next<void* (*)(std::size_t) noexcept> g_malloc{"malloc", __libc_malloc};
constinit Next<void* (*)(std::size_t, std::size_t) noexcept> g_calloc{"calloc", __libc_calloc};
constinit Next<void* (*)(void*, std::size_t) noexcept> g_realloc{"realloc", __libc_realloc};
constinit Next<void* (*)(std::size_t, std::size_t) noexcept> g_memalign{"memalign", __libc_memalign};
constinit Next<void* (*)(std::size_t, std::size_t) noexcept> g_aligned{"aligned_alloc", __libc_memalign};
constinit Next<int (*)(void**, std::size_t, std::size_t) noexcept> g_posix{"posix_memalign", alignedByLibc};

[[gnu::cold, gnu::noinline]] void failed(std::size_t size) noexcept {
  if (size > PTRDIFF_MAX) return;
  if (!coastmesh::memoryLacked()) coastmesh::catchCrashes();
  coastmesh::noteMemoryLacked();
}

void* noted(void* memory, std::size_t size) noexcept {
  if (memory == nullptr) [[unlikely]]
    failed(size);
  return memory;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) noexcept { return noted(g_malloc.get()(size), size); }

void* calloc(std::size_t count, std::size_t size) noexcept {
  void* const memory = g_calloc.get()(count, size);
  if (memory == nullptr) [[unlikely]] {
    std::size_t bytes = 0;
    failed(__builtin_mul_overflow(count, size, &bytes) ? SIZE_MAX : bytes);
  }
  return memory;
}

// realloc(memory, 0) frees.
void* realloc(void* memory, std::size_t size) noexcept {
  void* const given = g_realloc.get()(memory, size);
  if (given == nullptr && (size > 0 || memory == nullptr)) [[unlikely]]
    failed(size);
  return given;
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return noted(g_memalign.get()(alignment, size), size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return noted(g_aligned.get()(alignment, size), size);
}

int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  const int result = g_posix.get()(memory, alignment, size);
  if (result == ENOMEM) [[unlikely]]
    failed(size);
  return result;
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*work)(void*), void* given) noexcept {
  const int result = g_start.get()(thread, attributes, work, given);
  if (result != 0) [[unlikely]]
    coastmesh::noteThreadLacked();
  return result;
}

// Libraries may end the process for lack of memory, even before main (libnuma, with an exit code that has a meaning
// here), and while it ends. Returning from main does not call this.
void exit(int status) noexcept {
  coastmesh::exitIsCalled();
  if (const auto next = reinterpret_cast<void (*)(int)>(dlsym(RTLD_NEXT, "exit")); next != nullptr) next(status);
  _exit(status);
}

}  // extern "C"

#endif
