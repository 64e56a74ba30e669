/* people/approach.c - see approach.h. */
#include "people/approach.h"

#include "contact/collision.h"
#include "mechanics/pose.h"
#include "people/stride.h"

#include <math.h>

typedef struct approaches {
  const ambulo_problem *problem;
  ambulo__approach *list;
  ambulo__solid *solid; /* [count], with ends at 0 and 6 of `ends` */
  int *capsule[2];      /* [count]; of an obstacle the second is -1 */
  int count;
} approaches;

static void add(approaches *a, const ambulo__solid *solid, int one, int other) {
  const ambulo_model *m = a->problem->model;
  int is_obstacle = other < 0, at = a->count++;
  a->solid[at] = *solid;
  a->solid[at].one = 0;
  a->solid[at].other = 6;
  a->capsule[0][at] = one;
  a->capsule[1][at] = other;
  a->list[at] = (ambulo__approach){m->capsules[one].name,
                                   is_obstacle ? a->problem->definition.obstacles[solid->about].name
                                               : m->capsules[other].name,
                                   is_obstacle, (double)NAN, (double)NAN};
}

static void list_all(approaches *a) {
  const ambulo_problem_definition *d = &a->problem->definition;
  int pairs = ambulo_problem_pairs(a->problem, 0, NULL);
  for (int k = 0; k < pairs; k++) {
    ambulo__solid solid = ambulo__solid_of_pair(d, d->collision.pairs[k]);
    add(a, &solid, d->collision.pairs[k].one, d->collision.pairs[k].other);
  }
  for (int o = 0; o < d->obstacle_count; o++) {
    for (int i = 0; i < ambulo__obstacle_capsules(d, o); i++) {
      int capsule = ambulo__obstacle_capsule(d, o, i);
      ambulo__solid solid = ambulo__solid_near_obstacle(d, o, capsule);
      add(a, &solid, capsule, -1);
    }
  }
}

static void look(approaches *a, const ambulo__pose *pose, double time) {
  for (int k = 0; k < a->count; k++) {
    double ends[12] = {0.0};
    for (int c = 0; c < 2 && a->capsule[c][k] >= 0; c++) {
      const ambulo_capsule *capsule = &a->problem->model->capsules[a->capsule[c][k]];
      ambulo__pose_point(pose, capsule->link, capsule->from, ends + 6 * c);
      ambulo__pose_point(pose, capsule->link, capsule->to, ends + 6 * c + 3);
    }
    double gap = ambulo__solid_gap(&a->solid[k], ends, 1);
    if (!(gap >= a->list[k].gap)) { /* also the first one */
      a->list[k].gap = gap;
      a->list[k].time = time;
    }
  }
}

static int allocate(approaches *a, size_t most, const ambulo_allocator *allocator) {
  a->list = ambulo__alloc(allocator, most, sizeof *a->list);
  a->solid = ambulo__alloc(allocator, most, sizeof *a->solid);
  a->capsule[0] = ambulo__alloc(allocator, 2 * most, sizeof *a->capsule[0]);
  a->capsule[1] = a->capsule[0] ? a->capsule[0] + most : NULL;
  return a->list && a->solid && a->capsule[0];
}

ambulo_status ambulo__approaches(const ambulo_problem *p, const double *x, int samples,
                                 const ambulo_allocator *allocator, ambulo__approach **list,
                                 int *count) {
  approaches a = {.problem = p};
  ambulo__stride stride = {.samples = 0};
  ambulo__pose pose = {.model = NULL};
  size_t most = (size_t)ambulo_problem_pairs(p, 0, NULL);
  for (int o = 0; o < p->definition.obstacle_count; o++)
    most += (size_t)ambulo__obstacle_capsules(&p->definition, o);
  ambulo_status status = allocate(&a, most + 1, allocator) ? AMBULO_OK : AMBULO_E_MEMORY;
  if (!status) status = ambulo__pose_create(p->model, allocator, &pose);
  if (!status) status = ambulo__stride_create(p, x, samples, allocator, &stride);
  if (!status) {
    list_all(&a);
    for (int k = 0; k < stride.samples; k++) {
      ambulo__pose_at(&pose, stride.q + (size_t)k * (size_t)stride.coordinates);
      look(&a, &pose, stride.times[k]);
    }
    *list = a.list;
    *count = a.count;
    a.list = NULL;
  }
  ambulo__stride_free(&stride);
  ambulo__pose_free(&pose);
  ambulo__free(allocator, a.list);
  ambulo__free(allocator, a.solid);
  ambulo__free(allocator, a.capsule[0]);
  return status;
}
