// A library to be loaded before all others (LD_PRELOAD) that lets one call fail, or ends the program at one.
//
// COASTMESH_FAULT=KIND:N:WHAT  the N-th call, from 1, of a KIND: `new` (C++'s operator new), `malloc` (malloc, calloc and
//   realloc), or `disk` (whatever changes a disk: write, pwrite, writev, fwrite, fflush, fclose, fsync, ftruncate, rename,
//   link, mkdir, and open for writing; standard output and errors left out). WHAT is `fail` for memory; for a disk
//   `short` (half of it is written, and then the disk is full), `EIO` or `ENOSPC` (from then on nothing can be written;
//   names can be changed again, as they can on a full disk), `kill` (SIGKILL, before the call) or `int` (SIGINT, before
//   the call).
// COASTMESH_FAULT_TRACE=1  where memory fails, says from where it was asked for.
// COASTMESH_FAULT_COUNT=FILE  at its end the program writes there how many calls of each kind there were.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

enum Kind { kNew, kMalloc, kDisk, kKinds };
static const char* const kNames[kKinds] = {"new", "malloc", "disk"};

static atomic_long g_counts[kKinds];
static int g_kind = -1;
static long g_at = 0;
static int g_traced = 0;
static char g_what[16] = "";
static atomic_int g_disk_gone = 0;
static char g_count_file[1024] = "";

__attribute__((constructor)) static void readEnvironment(void) {
  const char* const file = getenv("COASTMESH_FAULT_COUNT");
  if (file != NULL) snprintf(g_count_file, sizeof g_count_file, "%s", file);
  g_traced = getenv("COASTMESH_FAULT_TRACE") != NULL;
  const char* const fault = getenv("COASTMESH_FAULT");
  if (fault == NULL) return;
  char name[16] = "";
  if (sscanf(fault, "%15[^:]:%ld:%15s", name, &g_at, g_what) != 3) _exit(99);
  for (int kind = 0; kind < kKinds; ++kind) {
    if (strcmp(name, kNames[kind]) == 0) g_kind = kind;
  }
  if (g_kind < 0) _exit(99);
}

__attribute__((destructor)) static void writeCounts(void) {
  if (g_count_file[0] == '\0') return;
  char text[128];
  const int size = snprintf(text, sizeof text, "%ld %ld %ld\n", atomic_load(&g_counts[kNew]),
                            atomic_load(&g_counts[kMalloc]), atomic_load(&g_counts[kDisk]));
  const int file = (int)syscall(SYS_openat, AT_FDCWD, g_count_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  syscall(SYS_write, file, text, (size_t)size);
  syscall(SYS_close, file);
}

static int isDue(enum Kind kind) {
  if (atomic_fetch_add(&g_counts[kind], 1) + 1 != g_at || g_kind != (int)kind) return 0;
  if (g_traced) {
    void* frames[64];
    backtrace_symbols_fd(frames, backtrace(frames, 64), STDERR_FILENO);
  }
  return 1;
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

// Memory ------------------------------------------------------------------------------------------------------------

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);

void* malloc(size_t size) {
  if (isDue(kMalloc)) return errno = ENOMEM, NULL;
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  if (isDue(kMalloc)) return errno = ENOMEM, NULL;
  return __libc_calloc(count, size);
}

void* realloc(void* memory, size_t size) {
  if (isDue(kMalloc)) return errno = ENOMEM, NULL;
  return __libc_realloc(memory, size);
}

// operator new(std::size_t), whose name C can say: where it is to fail, one that is too large is asked for.
void* _Znwm(size_t size) {
  static void* (*next)(size_t) = NULL;
  if (next == NULL) next = (void* (*)(size_t))dlsym(RTLD_NEXT, "_Znwm");
  return next(isDue(kNew) ? (size_t)1 << 60 : size);
}

// Disk --------------------------------------------------------------------------------------------------------------

// Whether a call is to fail; sets errno. `half`: may be asked for, where half can be done. `names`: it changes names alone.
static int failsAt(int* half, int names) {
  const int due = isDue(kDisk);
  if (atomic_load(&g_disk_gone) && !names) return errno = strcmp(g_what, "EIO") == 0 ? EIO : ENOSPC, 1;
  if (!due) return 0;
  if (strcmp(g_what, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(g_what, "int") == 0) {
    kill(getpid(), SIGINT);
    return 0;
  }
  atomic_store(&g_disk_gone, 1);
  if (strcmp(g_what, "short") == 0 && half != NULL) return *half = 1, 0;
  return errno = strcmp(g_what, "EIO") == 0 ? EIO : ENOSPC, 1;
}

static int fails(int* half) { return failsAt(half, 0); }

static int isTerminal(int file) { return file == STDOUT_FILENO || file == STDERR_FILENO; }

ssize_t write(int file, const void* bytes, size_t size) {
  int half = 0;
  if (!isTerminal(file) && fails(&half)) return -1;
  return NEXT(write)(file, bytes, half && size > 1 ? size / 2 : size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (!isTerminal(file) && fails(NULL)) return -1;
  return NEXT(writev)(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  int half = 0;
  if (fails(&half)) return -1;
  return NEXT(pwrite)(file, bytes, half && size > 1 ? size / 2 : size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  int half = 0;
  if (fails(&half)) return -1;
  return NEXT(pwrite64)(file, bytes, half && size > 1 ? size / 2 : size, at);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  int half = 0;
  if (!isTerminal(fileno(file)) && fails(&half)) return 0;
  return NEXT(fwrite)(bytes, size, half && count > 1 ? count / 2 : count, file);
}

int fsync(int file) { return fails(NULL) ? -1 : NEXT(fsync)(file); }
int ftruncate(int file, off_t size) { return fails(NULL) ? -1 : NEXT(ftruncate)(file, size); }
int ftruncate64(int file, off64_t size) { return fails(NULL) ? -1 : NEXT(ftruncate64)(file, size); }
int rename(const char* from, const char* to) { return failsAt(NULL, 1) ? -1 : NEXT(rename)(from, to); }
int link(const char* from, const char* to) { return failsAt(NULL, 1) ? -1 : NEXT(link)(from, to); }
int mkdir(const char* path, mode_t mode) { return fails(NULL) ? -1 : NEXT(mkdir)(path, mode); }

static int changes(int flags) { return (flags & O_ACCMODE) != O_RDONLY || (flags & O_CREAT) != 0; }

int open(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return changes(flags) && fails(NULL) ? -1 : NEXT(open)(path, flags, mode);
}

int open64(const char* path, int flags, ...) {
  va_list rest;
  va_start(rest, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(rest, mode_t) : 0;
  va_end(rest);
  return changes(flags) && fails(NULL) ? -1 : NEXT(open64)(path, flags, mode);
}
