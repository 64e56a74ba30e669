/* Every command with calls that fail under it (preload.c): the k-th request for memory, the k-th
 * open, read, write, flush, rename, close, stat, mkdir, removal, listing, start of a process; once,
 * for ever, halved or interrupted. Whatever happens, a command ends with a documented code, with
 * words when that is another than undisturbed; else all it wrote is byte for byte the same. No
 * input changes, no file is there by halves, and what is left behind is named.
 *
 * AMBULO_FAULTS_EVERY=n: every k up to n and then at growing distances; else one of each kind.
 * Arguments: these scenes alone. */
#define _GNU_SOURCE
#include "faults/faults.h"
#include "faults/tree.h"

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>

#ifndef AMBULO_SOURCE_DIR
#define AMBULO_SOURCE_DIR "."
#endif

enum { MOST_WORDS = 24, HANGS_AFTER = 60 /* s */ };

typedef struct scene {
  const char *name, *words; /* words: between blanks */
  const char *end; /* the command that follows on what an interrupted run left; NULL: none */
  int worker;      /* 1: faults in workers */
  int partial;     /* 1: exit code 4 leaves out what cannot be read, with a word */
} scene;

#define END_BATCH "collect out"
static const scene scenes[] = {
    {"solve", "solve p.yaml -o out", NULL, 0, 0},
    {"solve again", "solve p.yaml -o old --force -q", NULL, 0, 0},
    {"evaluate", "evaluate p.yaml r/solution.yaml --json", NULL, 0, 0},
    {"check", "check p.yaml two_link.yaml", NULL, 0, 0},
    {"info", "info p.yaml", NULL, 0, 0},
    {"inverse", "inverse two_link.yaml r/motion.csv -o out.csv", NULL, 0, 0},
    {"compare", "compare w people.csv --cycles out.csv", NULL, 0, 0},
    {"batch", "batch s.yaml -o out -j 1", END_BATCH, 0, 0},
    {"batch, workers", "batch s.yaml -o out -j 1", END_BATCH, 1, 0},
    {"front", "batch front.yaml -o out -j 1", END_BATCH, 0, 0},
    {"batch, status", "batch --status b", NULL, 0, 0},
    {"batch, verify", "batch --verify b", NULL, 0, 0},
    {"collect", "collect b", NULL, 0, 1},
    {"fit", "fit fit.yaml -o out -j 1", "", 0, 0},
    {"fit, workers", "fit fit.yaml -o out -j 1", "", 1, 0},
    {"report", "report r -o out.html", NULL, 0, 0},
    {"report, batch", "report b -o out.html", NULL, 0, 1},
    {"models", "models", NULL, 0, 0},
    {"new", "new walk -o out.yaml", NULL, 0, 0},
    {"import", "import biped.urdf -o out.yaml", NULL, 0, 0},
    {"draw", "draw p.yaml r -o out.svg", NULL, 0, 0},
    {"export npz", "export p.yaml r --format npz -o out.npz", NULL, 0, 0},
    {"export urdf", "export two_link.yaml --format urdf -o out.urdf", NULL, 0, 0},
    {"export opensim", "export p.yaml r --format opensim -o out", NULL, 0, 0},
    {"refused: an input", "export p.yaml r --format npz -o r/motion.csv", NULL, 0, 0},
    {"refused: a folder", "solve p.yaml -o foreign --force -q", NULL, 0, 0},
    {"help", "help solve", NULL, 0, 0},
    {"version", "--version", NULL, 0, 0},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static struct {
  char home[512]; /* work/ is where commands run; beside it are the streams and the plan */
  const char *program, *preload;
  faults *plan;
  tree before; /* of work/ */
  char *err;
  int code; /* of the last run; a signal is negative */
  int bad;
  long every, runs;
} w;

static const char *at(const char *name) {
  static char paths[8][600];
  static int next;
  char *path = paths[next++ % 8];
  (void)snprintf(path, sizeof paths[0], "%s/%s", w.home, name);
  return path;
}

/* ----------------------------------------------------------------- a command */

static void become(const char *words) {
  char text[512], *word[MOST_WORDS], *rest = NULL;
  int count = 0;
  (void)snprintf(text, sizeof text, "ambulo %s", words);
  for (char *next = strtok_r(text, " ", &rest); next && count < MOST_WORDS - 1;
       next = strtok_r(NULL, " ", &rest))
    word[count++] = next;
  word[count] = NULL;
  int out = open(at("out"), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  int err = open(at("err"), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  setenv("OPENBLAS_NUM_THREADS", "1", 1);
  setenv("LD_PRELOAD", w.preload, 1);
  setenv(FAULTS_VARIABLE, at("plan"), 1);
  if (chdir(at("work")) || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(99);
  alarm(HANGS_AFTER);
  execv(w.program, word);
  _exit(99);
}

/* how it ended; what it said is in out and w.err */
static int run(const char *words) {
  int status = 0;
  (void)fflush(NULL);
  pid_t process = fork();
  if (process == 0) become(words);
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
  w.code = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  free(w.err);
  w.err = tree_read(at("err"), NULL);
  return status;
}

/* ---------------------------------------------------------------- judgement */

typedef struct calm {
  int status;
  unsigned long long out; /* what it printed */
  tree after;
} calm;

typedef struct fault {
  const scene *of;
  fault_kind kind;
  fault_way way;
  long k;
} fault;

static void blame(const fault *f, const char *what, const char *more) {
  static const char *const kinds[] = {
#define FAULT_TEXT(name, text) text,
      FAULT_LIST(FAULT_TEXT)};
  static const char *const ways[] = {"once", "for ever", "halved", "interrupted"};
  w.bad++;
  print_error("%s: %s %ld %s, exit %d: %s%s%.300s\n", f->of->name, kinds[f->kind], f->k,
              ways[f->way], w.code, what, *more ? ": " : "", more);
}

static int is_of_the_making(const char *path) {
  return strstr(path, ".tmp-") || strstr(path, ".old-");
}

/* a file that is there although the command failed is whole, a folder too unless its work goes on
 */
static void judge_left(const fault *f, const calm *c, const tree *now) {
  int whole = f->of->end || f->of->partial;
  for (int i = 0; i < now->count; i++) {
    const char *path = now->entry[i].path, *name = strrchr(path, '/');
    name = name ? name + 1 : path;
    if (is_of_the_making(name)) {
      if (!strstr(w.err, name) && !f->of->end) blame(f, "left without a word", path);
    } else if (!whole && !is_of_the_making(path) && !tree_same(now, path, &c->after) &&
               !tree_same(now, path, &w.before)) {
      blame(f, "neither as before nor as undisturbed", path);
    }
  }
  for (int i = 0; i < w.before.count; i++)
    if (!tree_find(now, w.before.entry[i].path) && tree_find(&c->after, w.before.entry[i].path))
      blame(f, "gone", w.before.entry[i].path);
  for (int i = 0; i < c->after.count && !f->of->end; i++) {
    const char *path = c->after.entry[i].path, *slash = strchr(path, '/');
    char folder[256];
    if (!slash || tree_find(now, path)) continue;
    (void)snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
    if (tree_find(now, folder) && !tree_find(&w.before, folder)) blame(f, "not whole", path);
  }
}

/* the run once more, undisturbed, is as good as one alone */
static void judge_end(const fault *f, const calm *c) {
  w.plan->at = -1;
  int status = run(f->of->words);
  if (WIFEXITED(status) && f->of->end[0]) status = run(f->of->end);
  tree now = tree_of(at("work"), &w.before);
  if (status) blame(f, "the next run fails", w.err);
  for (int i = 0; i < c->after.count; i++) {
    const char *path = c->after.entry[i].path;
    if (!strstr(path, "results.") && !strstr(path, "fit.json")) continue;
    if (!tree_same(&now, path, &c->after)) blame(f, "another result after the next run", path);
  }
  for (int i = 0; i < now.count; i++)
    if (is_of_the_making(now.entry[i].path)) blame(f, "left after the next run", now.entry[i].path);
  tree_free(&now);
}

static int documented(int code) {
  return code == 0 || code == 1 || code == 3 || code == 4 || code == 5;
}

/* 1: there was a k-th call */
static int disturb(const fault *f, const calm *c) {
  w.plan->kind = (int)f->kind;
  w.plan->way = (int)f->way;
  w.plan->at = f->k;
  w.plan->worker = f->of->worker;
  w.plan->hits = 0;
  w.runs++;
  memset(w.plan->count, 0, sizeof w.plan->count);
  int status = run(f->of->words), hit = w.plan->hits > 0;
  tree now = tree_of(at("work"), &w.before);
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    blame(f, "hangs", w.err);
  else if (!WIFEXITED(status))
    blame(f, "killed by a signal", w.err);
  else if (!documented(WEXITSTATUS(status)))
    blame(f, "exit code of another kind", w.err);
  else if (status != c->status && !w.err[0] && tree_hash(at("out")) == c->out)
    blame(f, "another exit code without a word", "");
  if (status == c->status && !f->of->end) {
    if (tree_hash(at("out")) != c->out) blame(f, "prints other things", "");
    for (int i = 0; i < c->after.count; i++)
      if (!tree_same(&now, c->after.entry[i].path, &c->after))
        blame(f, "another output", c->after.entry[i].path);
  }
  judge_left(f, c, &now);
  if (f->of->end) judge_end(f, c);
  tree_free(&now);
  tree_restore(at("work"), &w.before, at("keep"));
  return hit;
}

/* ------------------------------------------------------------------- scenes */

static void disturb_all(const scene *s, const calm *c, const long *count, fault_kind kind,
                        fault_way way) {
  fault f = {s, kind, way, 0};
  if (count[kind] == 0) return;
  if (w.every == 0 && (c->status == 0 || kind == FAULT_MEMORY)) {
    /* what is run twice, less often: each kind and way under one command or two */
    if (s->end && ((s - scenes) + (int)kind + (int)way) % 4 != 0) return;
    /* another place for each scene, kind and way */
    f.k = (1 + 7 * (s - scenes) + 3 * (int)kind + 5 * (int)way) * 37 % count[kind];
    (void)disturb(&f, c);
    return;
  }
  /* a look at what is there that fails is what writes over an input, or a folder of others */
  long dense = w.every ? w.every : kind == FAULT_STAT ? 100 : 2;
  /* threads and the clock may make one call more or less */
  for (; disturb(&f, c) || f.k < count[kind]; f.k += 1 + f.k / dense) continue;
}

static long play(const scene *s) {
  calm c = {0};
  long count[FAULT_KINDS], calls = 0;
  w.plan->at = -1;
  w.plan->worker = s->worker;
  memset(w.plan->count, 0, sizeof w.plan->count);
  c.status = run(s->words);
  memcpy(count, w.plan->count, sizeof count);
  c.out = tree_hash(at("out"));
  if (!c.status != !strstr(s->name, "refused"))
    print_error("%s: undisturbed: %s\n", s->name, w.err);
  assert_int_equal(!c.status, !strstr(s->name, "refused"));
  if (s->end && s->end[0]) assert_int_equal(run(s->end), 0);
  c.after = tree_of(at("work"), &w.before);
  tree_restore(at("work"), &w.before, at("keep"));
  for (int kind = 0; kind < FAULT_KINDS; kind++) {
    fault_kind of = (fault_kind)kind;
    calls += count[kind];
    disturb_all(s, &c, count, of, FAULT_ONCE);
    if (of == FAULT_MEMORY || of == FAULT_WRITE || of == FAULT_OPEN)
      disturb_all(s, &c, count, of, FAULT_FOR_EVER);
    if (of == FAULT_READ || of == FAULT_WRITE) disturb_all(s, &c, count, of, FAULT_SHORT);
    if (of == FAULT_OPEN || of == FAULT_READ || of == FAULT_WRITE)
      disturb_all(s, &c, count, of, FAULT_INTERRUPTED);
  }
  tree_free(&c.after);
  return calls;
}

/* small inputs: a reach of two links, its results, a walk of 12 intervals, a batch of two cases */
static const char prepare_text[] =
    "set -e; cd \"$1/work\"; s=$3; a=$2; m=$s/models\n"
    "cp $m/two_link.yaml $s/tests/users/biped.urdf $s/tests/study/arm/*.csv .\n"
    "sed 's/intervals: 32/intervals: 12/' $m/two_link_reach.yaml >p.yaml\n"
    "cp $m/norms/young_adults.csv people.csv\n"
    "h='ambulo: 1\\nkind: sweep\\nname: s\\nbase: p.yaml\\noutputs: [objective, iterations]\\n'\n"
    "printf \"${h}axes:\\n  - {key: time.duration, name: T, values: [0.8, 1]}\\n\" >s.yaml\n"
    "printf \"${h}front: {terms: [torque_squared, acceleration], points: 3}\\n\" >front.yaml\n"
    "sed '/slow\\|held_out/d; s/iterations: 12/iterations: 1/' $s/tests/study/arm/fit.yaml "
    ">fit.yaml\n"
    "sed 's/^model.*/model: two_link.yaml/' $s/tests/study/arm/reach.yaml >reach.yaml\n"
    "$a solve p.yaml -o r -q 2>/dev/null; cp -r r old; cp -r r foreign; echo mine "
    ">foreign/notes.txt\n"
    "$a solve walk_normal.yaml -o w -q --set time.intervals=12 2>/dev/null || [ $? = 1 ]\n"
    "$a batch s.yaml -o b -q; cd ..; cp -r work keep\n";

static int open_world(void **state) {
  (void)state;
  static const faults none;
  const char *folder = getenv("TMPDIR");
  char source[4096];
  char *const words[] = {"sh",   "-c", (char *)prepare_text, "sh", w.home, (char *)w.program,
                         source, NULL};
  if (!realpath(AMBULO_SOURCE_DIR, source)) return -1;
  (void)snprintf(w.home, sizeof w.home, "%s/ambulo-faults-XXXXXX", folder ? folder : "/tmp");
  if (!mkdtemp(w.home) || mkdir(at("work"), 0777)) return -1;
  int file = open(at("plan"), O_RDWR | O_CREAT, 0666), status = 0;
  if (file < 0 || write(file, &none, sizeof none) != sizeof none) return -1;
  w.plan = mmap(NULL, sizeof *w.plan, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  close(file);
  pid_t process = fork();
  if (process == 0) {
    setenv("OPENBLAS_NUM_THREADS", "1", 1);
    setenv("LD_PRELOAD", w.preload, 1);
    execv("/bin/sh", words);
    _exit(99);
  }
  if (waitpid(process, &status, 0) != process || status) return -1;
  w.before = tree_of(at("work"), NULL);
  return 0;
}

static int close_world(void **state) {
  (void)state;
  tree_free(&w.before);
  free(w.err);
  return tree_remove(w.home);
}

static void play_scene(void **state) {
  const scene *s = *state;
  int bad = w.bad;
  long runs = w.runs, calls = play(s);
  print_message("%s: %ld calls, %ld runs\n", s->name, calls, w.runs - runs);
  assert_int_equal(w.bad, bad);
}

/* a library in front of malloc needs Linux, and a program without a sanitizer's own */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || !defined __linux__
#define HAS_PRELOAD 0
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HAS_PRELOAD 0
#endif
#endif
#ifndef HAS_PRELOAD
#define HAS_PRELOAD 1
#endif

int main(int argc, char **argv) {
  struct CMUnitTest tests[SCENES];
  int count = 0;
  char preload[4096], *slash;
  w.program = getenv("AMBULO");
  const char *every = getenv("AMBULO_FAULTS_EVERY");
  w.every = every ? strtol(every, NULL, 10) : 0;
  if (!HAS_PRELOAD) {
    (void)puts("[  SKIPPED ] commands\nskipped with sanitizers, and elsewhere than on Linux: calls "
               "that fail");
    return 0;
  }
  if (!realpath(argv[0], preload) || !(slash = strrchr(preload, '/')) || !w.program) {
    (void)puts("skipped: AMBULO is not set");
    return 0;
  }
  (void)snprintf(slash, sizeof preload - (size_t)(slash - preload), "/preload.so");
  w.preload = preload;
  for (int i = 0; i < SCENES; i++) {
    int wanted = argc == 1;
    for (int k = 1; k < argc; k++) wanted |= strcmp(scenes[i].name, argv[k]) == 0;
    if (!wanted) continue;
    tests[count++] =
        (struct CMUnitTest){scenes[i].name, play_scene, NULL, NULL, (void *)&scenes[i]};
  }
  return _cmocka_run_group_tests("commands", tests, (size_t)count, open_world, close_world);
}
