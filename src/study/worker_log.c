/* study/worker_log.c - what a worker says, kept by its supervisor.
 *
 * It comes through a pipe and not into a file: on a full disk no file takes the words that tell why
 * the worker failed. The file is written once the worker has ended. */
#include "formats/atomic_file.h"
#include "study/batch.h"

#include <errno.h>
#include <fcntl.h>
#include <unistd.h>

enum { MOST_BYTES = 1 << 20, FIRST_FREE = 3 /* 0 to 2 are the worker's own */ };

/* moves a descriptor out of the way of 0, 1 and 2, and closes it in other programs */
static int move_up(int file) {
  int moved = fcntl(file, F_DUPFD_CLOEXEC, FIRST_FREE);
  int reason = errno;
  (void)close(file);
  errno = reason;
  return moved;
}

void ambulo__worker_log_close(ambulo__worker_log *log) {
  if (log->file > 0) (void)close(log->file);
  log->file = 0;
  ambulo__text_free(&log->text);
}

int ambulo__worker_log_open(ambulo__worker_log *log, const ambulo_allocator *allocator) {
  int ends[2];
  *log = (ambulo__worker_log){.file = 0};
  ambulo__text_init(&log->text, allocator);
  if (pipe(ends) != 0) return -1;
  int from = move_up(ends[0]), to = from < 0 ? -1 : move_up(ends[1]);
  if (from < 0) (void)close(ends[1]);
  if (to >= 0 && fcntl(from, F_SETFL, O_NONBLOCK) == 0) {
    log->file = from;
    return to;
  }
  int reason = errno;
  if (from >= 0) (void)close(from);
  if (to >= 0) (void)close(to);
  errno = reason;
  return -1;
}

int ambulo__worker_log_read(ambulo__worker_log *log) {
  char bytes[4096];
  while (log->file > 0) {
    ssize_t count = read(log->file, bytes, sizeof bytes);
    if (count == 0 || (count < 0 && errno == EAGAIN)) return 0;
    if (count < 0 && errno != EINTR) return -1;
    /* who says more than this says it again and again; the pipe is emptied all the same */
    size_t room = MOST_BYTES - log->text.length;
    if (count > 0)
      ambulo__text_append_bytes(&log->text, bytes, (size_t)count < room ? (size_t)count : room);
  }
  return 0;
}

ambulo_status ambulo__worker_log_write(const ambulo__worker_log *log, const char *path,
                                       ambulo_diagnostics *diagnostics) {
  ambulo_status status = ambulo__text_status(&log->text);
  if (status) return ambulo__io_memory_error(diagnostics, path);
  if (log->text.length == 0) return AMBULO_OK;
  return ambulo__fill_file(open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), path,
                           ambulo__text_data(&log->text), log->text.length, 0, diagnostics);
}
