/* bodies_in_threads.c - one walk of many bodies, in as many threads as there are processors.
 *
 *     cc -pthread bodies_in_threads.c $(pkg-config --cflags --libs ambulo) -o bodies_in_threads
 *     OPENBLAS_NUM_THREADS=1 ./bodies_in_threads models/walk_without_reaction.yaml 4
 *
 * Arguments: a problem whose file takes `subject`, and how many threads. Each case is loaded and
 * solved by one thread alone: nothing is shared but the list, and the numbers are those of one
 * thread. (Thousands of cases are what `ambulo batch` is for: processes that can be killed.) */
#include <ambulo/tools/tools.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

enum { STATURES = 3, MASSES = 2, CASES = STATURES * MASSES, MOST_THREADS = 64 };
static const double stature[STATURES] = {1.60, 1.70, 1.80}, mass[MASSES] = {60.0, 80.0};

typedef struct body {
  ambulo_status status;
  ambulo_verdict verdict;
  double objective;
} body;

typedef struct list {
  const char *file;
  pthread_mutex_t lock;
  int next; /* the case that nobody has taken yet */
  body bodies[CASES];
} list;

static void solve(const char *file, int which, body *b) {
  char settings[2][60];
  const char *const overrides[] = {settings[0], settings[1]};
  snprintf(settings[0], sizeof settings[0], "subject.stature=%g", stature[which / MASSES]);
  snprintf(settings[1], sizeof settings[1], "subject.mass=%g", mass[which % MASSES]);
  ambulo_problem *problem = NULL;
  ambulo_result *result = NULL;
  b->status = ambulo_problem_load(file, overrides, 2, NULL, NULL, &problem);
  if (!b->status) b->status = ambulo_solve(problem, NULL, NULL, NULL, NULL, &result);
  if (!b->status) {
    b->verdict = ambulo_result_verdict(result);
    b->objective = ambulo_result_objective(result);
  }
  ambulo_result_free(result);
  ambulo_problem_free(problem);
}

static void *work(void *user) {
  list *l = user;
  for (;;) {
    pthread_mutex_lock(&l->lock);
    int which = l->next++;
    pthread_mutex_unlock(&l->lock);
    if (which >= CASES) return NULL;
    solve(l->file, which, &l->bodies[which]);
  }
}

int main(int argc, char **argv) {
  int wanted = argc > 2 ? atoi(argv[2]) : 2, threads = 0, bad = 0;
  if (argc < 2 || wanted < 1 || wanted > MOST_THREADS) {
    fprintf(stderr, "usage: %s PROBLEM THREADS (1 to %d)\n", argv[0], MOST_THREADS);
    return 2;
  }
  static list l = {.lock = PTHREAD_MUTEX_INITIALIZER};
  pthread_t thread[MOST_THREADS];
  l.file = argv[1];
  while (threads < wanted && pthread_create(&thread[threads], NULL, work, &l) == 0) threads++;
  for (int i = 0; i < threads; i++) pthread_join(thread[i], NULL);
  printf("stature  mass  verdict   objective\n");
  for (int i = 0; i < CASES; i++) {
    const body *b = &l.bodies[i];
    const char *word = b->status ? ambulo_status_name(b->status) : ambulo_verdict_name(b->verdict);
    printf("%5.2f m %4.0f kg  %-8s %.10f\n", stature[i / MASSES], mass[i % MASSES], word,
           b->objective);
    bad |= b->status || !ambulo_verdict_is_solution(b->verdict);
  }
  return bad || threads == 0;
}
