/* linear/poll.h - whether long work is to end, asked now and then. */
#ifndef AMBULO_LINEAR_POLL_H
#define AMBULO_LINEAR_POLL_H

typedef struct ambulo__poll {
  int (*ask)(void *user); /* 1: the work is to end. NULL: never */
  void *user;
} ambulo__poll;

#endif
