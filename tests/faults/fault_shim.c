// A library to preload (LD_PRELOAD) that makes one call fail, or ends the program at one.
//
// COASTMESH_FAULT=KIND:N:WHAT  selects the N-th call, from 1, of a KIND: `new` (C++'s operator new), `malloc` (malloc,
//   calloc, realloc and aligned ones, also those from `new`: all allocations), or `disk` (all changes of the disk:
//   write, pwrite, writev, fwrite, fflush, fclose, fsync, fdatasync, ftruncate, rename, link, unlink, rmdir, mkdir, and
//   opening for writing; not on standard output and error). WHAT is for memory `fail`, or `gone` (this call and all
//   later ones of 1 KiB or more); for both `kill` (SIGKILL before the call) or `int` (SIGINT before the call); for the
//   disk `short` (half is written, then the disk is full), `EIO` or `ENOSPC` (from then on nothing can be written; files
//   can still be renamed and removed, as on a full disk).
// COASTMESH_FAULT_EVERY=KIND:WHAT:FIRST:STEP:MOST:OUT:IN  every STEP-th allocation from FIRST on. The process forks
//   there: one process fails, the other continues to the next, so that the way to a call runs once instead of once for
//   each call. At most MOST calls are tried for each call stack. The failing process continues in a copy of its folder,
//   made by sweep.py: a message is sent through the descriptor OUT before the fork, and `g` is awaited through IN; a
//   second message says how that process ended, and is answered with `g`, or with `t` to request the call stack.
// COASTMESH_FAULT_TRACE=1  prints the call stack of the allocation that fails.
// COASTMESH_FAULT_COUNT=FILE  at its end the program writes the number of calls of each kind to FILE.
// COASTMESH_FAULT_LOG=FILE  the program writes its changes of the disk to FILE, one a line: operation, file, and the
//   number of allocations before it.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
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
#include <sys/wait.h>
#include <unistd.h>

enum Kind { kNew, kMalloc, kDisk, kKinds };
static const char* const kNames[kKinds] = {"new", "malloc", "disk"};

static atomic_long g_counts[kKinds];
static int g_kind = -1;
static long g_at = 0;
static int g_traced = 0;
static char g_what[16] = "";
static atomic_int g_disk_gone = 0;
static atomic_int g_memory_gone = 0;
static char g_count_file[1024] = "";
static int g_log = -1;

// Settings of COASTMESH_FAULT_EVERY.
static struct {
  int kind;  // -1 if it is not set
  long first, step, most;
  int out, in;
  char folder[2048];
} g_every = {.kind = -1};
static __thread int t_inside = 0;

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static int kindNamed(const char* name) {
  for (int kind = 0; kind < kKinds; ++kind) {
    if (strcmp(name, kNames[kind]) == 0) return kind;
  }
  _exit(99);
}

__attribute__((constructor)) static void readEnvironment(void) {
  const char* const file = getenv("COASTMESH_FAULT_COUNT");
  if (file != NULL) snprintf(g_count_file, sizeof g_count_file, "%s", file);
  const char* const log = getenv("COASTMESH_FAULT_LOG");
  if (log != NULL) g_log = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  g_traced = getenv("COASTMESH_FAULT_TRACE") != NULL;
  char name[16] = "";
  const char* const every = getenv("COASTMESH_FAULT_EVERY");
  if (every != NULL) {
    void* frames[4];
    t_inside = 1;
    backtrace(frames, 4);  // the first call loads a library
    t_inside = 0;
    if (sscanf(every, "%15[^:]:%15[^:]:%ld:%ld:%ld:%d:%d", name, g_what, &g_every.first, &g_every.step, &g_every.most,
               &g_every.out, &g_every.in) != 7 || getcwd(g_every.folder, sizeof g_every.folder) == NULL)
      _exit(99);
    g_every.kind = kindNamed(name);
    if (g_every.kind == kDisk) _exit(99);
    return;
  }
}

// Called first by constructors of other libraries, which run, and allocate, before this one's.
static void readFault(void) {
  static int read = 0;
  if (read) return;
  read = 1;
  const char* const fault = getenv("COASTMESH_FAULT");
  if (fault == NULL) return;
  char name[16] = "";
  if (sscanf(fault, "%15[^:]:%ld:%15s", name, &g_at, g_what) != 3) _exit(99);
  g_kind = kindNamed(name);
}

__attribute__((destructor)) static void writeCounts(void) {
  if (g_count_file[0] == '\0') return;
  char text[128];
  // A rank is several processes; the largest number of allocations counts.
  const int before = (int)syscall(SYS_openat, AT_FDCWD, g_count_file, O_RDONLY);
  if (before >= 0) {
    const long got = syscall(SYS_read, before, text, sizeof text - 1);
    text[got > 0 ? got : 0] = '\0';
    syscall(SYS_close, before);
    if (atol(text) > atomic_load(&g_counts[kNew])) return;
  }
  const int size = snprintf(text, sizeof text, "%ld %ld %ld\n", atomic_load(&g_counts[kNew]),
                            atomic_load(&g_counts[kMalloc]), atomic_load(&g_counts[kDisk]));
  const int file = (int)syscall(SYS_openat, AT_FDCWD, g_count_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (file < 0) return;
  syscall(SYS_write, file, text, (size_t)size);
  syscall(SYS_close, file);
}

// COASTMESH_FAULT_EVERY ----------------------------------------------------------------------------------------------

enum { kFrames = 64, kStacks = 1 << 18 };
static struct {
  unsigned long hash;
  long times;
} g_stacks[kStacks];

// How often this call stack was seen before.
static long timesSeen(void* const* frames, int count) {
  unsigned long hash = 1469598103934665603UL;
  for (int i = 0; i < count; ++i) hash = (hash ^ (unsigned long)frames[i]) * 1099511628211UL;
  hash |= 1;
  for (unsigned long tried = 0; tried < kStacks; ++tried) {
    const unsigned long slot = (hash + tried) % kStacks;
    if (g_stacks[slot].hash == 0) g_stacks[slot].hash = hash;
    if (g_stacks[slot].hash == hash) return g_stacks[slot].times++;
  }
  _exit(99);
}

static char tell(const char* text, int size) {
  char answer = 0;
  if (syscall(SYS_write, g_every.out, text, (size_t)size) != size) _exit(99);
  if (syscall(SYS_read, g_every.in, &answer, 1) != 1) _exit(99);
  return answer;
}

// Called when this process's folder has been renamed to `folder`.kept, with a copy in its place: files open in the
// former are reopened in the copy, at the same offset. Files read elsewhere are reopened too, because the two processes
// would share their offsets.
static void moveToCopy(void) {
  static char from[4096], path[4096];
  const size_t length = strlen(g_every.folder);
  if (chdir(g_every.folder) != 0) _exit(98);
  for (int file = 0; file < 256; ++file) {
    const int flags = fcntl(file, F_GETFL);
    if (flags < 0) continue;
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    const ssize_t size = readlink(path, from, sizeof from - 1);
    if (size < 0) _exit(98);
    from[size] = '\0';
    struct stat about;
    if (fstat(file, &about) != 0 || !S_ISREG(about.st_mode)) continue;
    if (strncmp(from, g_every.folder, length) == 0 && strncmp(from + length, ".kept/", 6) == 0) {
      snprintf(path, sizeof path, "%s/%s", g_every.folder, from + length + 6);
    } else if ((flags & O_ACCMODE) == O_RDONLY) {
      snprintf(path, sizeof path, "%s", from);
    } else {
      continue;
    }
    const int copy = (int)syscall(SYS_openat, AT_FDCWD, path, flags & ~(O_CREAT | O_EXCL | O_TRUNC), 0);
    if (copy < 0) continue;  // already removed
    lseek(copy, lseek(file, 0, SEEK_CUR), SEEK_SET);
    if (dup3(copy, file, (fcntl(file, F_GETFD) & FD_CLOEXEC) != 0 ? O_CLOEXEC : 0) < 0) _exit(98);
    syscall(SYS_close, copy);
  }
  const int errors = (int)syscall(SYS_openat, AT_FDCWD, "../errors", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (errors < 0 || dup2(errors, STDERR_FILENO) < 0) _exit(98);
  syscall(SYS_close, errors);
  alarm(10);
}

// A mutex stores the thread number of its owner. The forked process has another number, and would wait for a mutex that
// it holds itself. Returns the place in the C library's thread data that holds the number.
static int* threadNumber(void) {
  int* const known = (int*)pthread_self();
  const int number = (int)syscall(SYS_gettid);
  for (int i = 0; i < 512; ++i) {
    if (known[i] == number) return &known[i];
  }
  _exit(96);
}

// pthread_atfork calls this function. No handlers are registered, because PROJ's would lock what this thread may hold.
int __register_atfork(void (*before)(void), void (*parent)(void), void (*child)(void), void* library) {
  (void)before, (void)parent, (void)child, (void)library;
  return 0;
}

// Forks. Returns 1 in the process that is to fail, otherwise 0.
static int split(long at) {
  void* frames[kFrames];
  t_inside = 1;
  const int count = backtrace(frames, kFrames);
  t_inside = 0;
  if (timesSeen(frames, count) >= g_every.most) return 0;
  char text[96];
  tell(text, snprintf(text, sizeof text, "at %ld\n", at));
  int* const number = threadNumber();
  const int kept = *number;
  const pid_t child = fork();
  if (child < 0) _exit(97);
  if (child == 0) {
    *number = kept;
    g_every.kind = -1;
    g_count_file[0] = '\0';
    moveToCopy();
    return 1;
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (tell(text, snprintf(text, sizeof text, "ended %d\n", WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status))) ==
      't') {
    t_inside = 1;
    backtrace_symbols_fd(frames, count, g_every.out);
    t_inside = 0;
    tell("told\n", 5);
  }
  return 0;
}

static int isDue(enum Kind kind) {
  if (t_inside) return 0;
  readFault();
  const long at = atomic_fetch_add(&g_counts[kind], 1) + 1;
  if (g_every.kind == (int)kind && at >= g_every.first && (at - g_every.first) % g_every.step == 0) {
    // An allocation of another thread cannot be tried: the forked process would lack the main thread.
    return syscall(SYS_gettid) == getpid() && split(at);
  }
  if (at != g_at || g_kind != (int)kind) return 0;
  if (g_traced && kind != kDisk) {
    void* frames[kFrames];
    t_inside = 1;
    backtrace_symbols_fd(frames, backtrace(frames, kFrames), STDERR_FILENO);
    t_inside = 0;
  }
  return 1;
}

// Sends the signal if one is requested. Returns 1 if the process continues; the call itself must not fail then.
static int signals(void) {
  if (strcmp(g_what, "kill") == 0) kill(getpid(), SIGKILL);
  if (strcmp(g_what, "int") != 0) return 0;
  kill(getpid(), SIGINT);
  return 1;
}

// Memory ------------------------------------------------------------------------------------------------------------

enum { kLarge = 1024 };

static int lacks(enum Kind kind, size_t size) {
  if (!isDue(kind)) return size >= kLarge && !t_inside && atomic_load(&g_memory_gone);
  if (signals()) return 0;
  if (strcmp(g_what, "gone") == 0) atomic_store(&g_memory_gone, 1);
  return 1;
}

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);

void* malloc(size_t size) {
  if (lacks(kMalloc, size)) return errno = ENOMEM, NULL;
  return __libc_malloc(size);
}

void* calloc(size_t count, size_t size) {
  if (lacks(kMalloc, count * size)) return errno = ENOMEM, NULL;
  return __libc_calloc(count, size);
}

void* realloc(void* memory, size_t size) {
  if (size > 0 && lacks(kMalloc, size)) return errno = ENOMEM, NULL;
  return __libc_realloc(memory, size);
}

void* aligned_alloc(size_t alignment, size_t size) {
  if (lacks(kMalloc, size)) return errno = ENOMEM, NULL;
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** memory, size_t alignment, size_t size) {
  if (lacks(kMalloc, size)) return ENOMEM;
  *memory = __libc_memalign(alignment, size);
  return *memory == NULL ? ENOMEM : 0;
}

// operator new(std::size_t) by its mangled name. To make it fail, requests too much memory.
void* _Znwm(size_t size) {
  static void* (*next)(size_t) = NULL;
  if (next == NULL) next = (void* (*)(size_t))dlsym(RTLD_NEXT, "_Znwm");
  return next(lacks(kNew, size) ? (size_t)1 << 60 : size);
}

// Disk --------------------------------------------------------------------------------------------------------------

static void logChange(const char* what, const char* path) {
  static char line[4096];
  if (g_log < 0) return;
  const int size = snprintf(line, sizeof line, "%s\t%s\t%ld\n", what, path, atomic_load(&g_counts[kMalloc]));
  syscall(SYS_write, g_log, line, (size_t)size);
}

static void logOpen(const char* what, int file) {
  char link[64], path[2048];
  if (g_log < 0) return;
  snprintf(link, sizeof link, "/proc/self/fd/%d", file);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size < 0) return;
  path[size] = '\0';
  logChange(what, path);
}

// Returns whether a call fails; sets errno. `half`, if not NULL: set if half of the work should be done instead.
// `names`: the call only changes names.
static int failsAt(int* half, int names) {
  const int due = isDue(kDisk);
  if (atomic_load(&g_disk_gone) && !names) return errno = strcmp(g_what, "EIO") == 0 ? EIO : ENOSPC, 1;
  if (!due || signals()) return 0;
  atomic_store(&g_disk_gone, 1);
  if (strcmp(g_what, "short") == 0 && half != NULL) return *half = 1, 0;
  return errno = strcmp(g_what, "EIO") == 0 ? EIO : ENOSPC, 1;
}

static int fails(int* half) { return failsAt(half, 0); }

static int isTerminal(int file) { return file == STDOUT_FILENO || file == STDERR_FILENO; }

ssize_t write(int file, const void* bytes, size_t size) {
  int half = 0;
  if (!isTerminal(file)) {
    logOpen("write", file);
    if (fails(&half)) return -1;
  }
  return NEXT(write)(file, bytes, half && size > 1 ? size / 2 : size);
}

ssize_t writev(int file, const struct iovec* parts, int count) {
  if (!isTerminal(file)) {
    logOpen("write", file);
    if (fails(NULL)) return -1;
  }
  return NEXT(writev)(file, parts, count);
}

ssize_t pwrite(int file, const void* bytes, size_t size, off_t at) {
  int half = 0;
  logOpen("write", file);
  if (fails(&half)) return -1;
  return NEXT(pwrite)(file, bytes, half && size > 1 ? size / 2 : size, at);
}

ssize_t pwrite64(int file, const void* bytes, size_t size, off64_t at) {
  int half = 0;
  logOpen("write", file);
  if (fails(&half)) return -1;
  return NEXT(pwrite64)(file, bytes, half && size > 1 ? size / 2 : size, at);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  int half = 0;
  if (!isTerminal(fileno(file))) {
    logOpen("write", fileno(file));
    if (fails(&half)) return 0;
  }
  return NEXT(fwrite)(bytes, size, half && count > 1 ? count / 2 : count, file);
}

static int isWritten(FILE* file) {
  const int flags = file == NULL ? -1 : fcntl(fileno(file), F_GETFL);
  return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && !isTerminal(fileno(file));
}

int fflush(FILE* file) {
  if (isWritten(file)) {
    logOpen("write", fileno(file));
    if (fails(NULL)) return EOF;
  }
  return NEXT(fflush)(file);
}

// The file is closed even if the call fails.
int fclose(FILE* file) {
  int failure = 0;
  if (isWritten(file)) {
    logOpen("write", fileno(file));
    if (fails(NULL)) failure = errno;
  }
  const int closed = NEXT(fclose)(file);
  return failure != 0 ? (errno = failure, EOF) : closed;
}

int fsync(int file) {
  logOpen("fsync", file);
  return fails(NULL) ? -1 : NEXT(fsync)(file);
}

int fdatasync(int file) {
  logOpen("fsync", file);
  return fails(NULL) ? -1 : NEXT(fdatasync)(file);
}

int ftruncate(int file, off_t size) {
  logOpen("write", file);
  return fails(NULL) ? -1 : NEXT(ftruncate)(file, size);
}

int ftruncate64(int file, off64_t size) {
  logOpen("write", file);
  return fails(NULL) ? -1 : NEXT(ftruncate64)(file, size);
}

int rename(const char* from, const char* to) {
  logChange("rename", from);
  return failsAt(NULL, 1) ? -1 : NEXT(rename)(from, to);
}

// A full disk still allows files to be removed: these calls never fail, and are counted for signals before them.
static void comesBefore(void) {
  if (strcmp(g_what, "kill") == 0 || strcmp(g_what, "int") == 0) failsAt(NULL, 1);
  else atomic_fetch_add(&g_counts[kDisk], 1);
}

int unlink(const char* path) { return comesBefore(), NEXT(unlink)(path); }
int unlinkat(int folder, const char* path, int flags) { return comesBefore(), NEXT(unlinkat)(folder, path, flags); }
int remove(const char* path) { return comesBefore(), NEXT(remove)(path); }
int rmdir(const char* path) { return comesBefore(), NEXT(rmdir)(path); }

int link(const char* from, const char* to) { return failsAt(NULL, 1) ? -1 : NEXT(link)(from, to); }
int mkdir(const char* path, mode_t mode) { return fails(NULL) ? -1 : NEXT(mkdir)(path, mode); }
char* mkdtemp(char* pattern) { return fails(NULL) ? NULL : NEXT(mkdtemp)(pattern); }

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

FILE* fopen(const char* path, const char* mode) {
  return strpbrk(mode, "wa+") != NULL && fails(NULL) ? NULL : NEXT(fopen)(path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  return strpbrk(mode, "wa+") != NULL && fails(NULL) ? NULL : NEXT(fopen64)(path, mode);
}
