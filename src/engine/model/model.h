/* model/model.h - the inside of an ambulo_model. Immutable once created. */
#ifndef AMBULO_MODEL_MODEL_H
#define AMBULO_MODEL_MODEL_H

#include "ambulo/model.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "model/coupling.h"

/* One of the file's units in SI units and radians; all 0: the model was made from C. */
typedef struct ambulo__model_units {
  double angle, length, moment, force; /* of coordinates: range and speed, torque */
  double mass;                         /* of bodies: the subject's, where they are shares of it */
} ambulo__model_units;

/* A mass that was put on a link (model/conditions.h): part of that link's body. */
typedef struct ambulo__model_load {
  int link;
  double mass, position[3]; /* kg; link frame, m */
} ambulo__model_load;
enum { AMBULO__MOST_LOADS = 16 }; /* that are known of; more count as the body's own */

/* Arrays are owned by the model. Links stand in topological order: every parent
 * before its children (a definition in another order is sorted, names kept). */
struct ambulo_model {
  ambulo_allocator allocator;
  char *text; /* every name, one after the other, each with its NUL */
  const char *name;
  double gravity[3]; /* world, m/s^2 */
  double up[3], forward[3], left[3];
  double mass, stature;
  ambulo__model_units units;
  ambulo__model_load loads[AMBULO__MOST_LOADS]; /* [load_count], in the order in which they came */
  int load_count;
  ambulo_link *links; /* [link_count] */
  int link_count;
  ambulo__coupling *couplings;    /* [link_count] */
  int coupled_count;              /* of links that are coupled */
  double *splines;                /* points of all functions, which links point into */
  ambulo__piece *pieces;          /* of all functions */
  ambulo_coordinate *coordinates; /* [coordinate_count]; ancestors before descendants */
  int *coordinate_link;           /* [coordinate_count]: the link that carries coordinate i */
  int *coordinate_written;        /* [coordinate_count]: the link that its file describes it with */
  int coordinate_count;
  ambulo_point *points; /* [point_count] */
  double *neutral;      /* [point_count][3]: where they are at q = 0, world frame, m */
  int point_count;
  ambulo_foot *feet; /* [foot_count] */
  int foot_count;
  ambulo_patch *patches; /* [patch_count] */
  int patch_count;
  ambulo_capsule *capsules; /* [capsule_count] */
  int *capsule_point; /* [capsule_count]: the point at its `from`, before that at its `to`; -1: it
                         has no points (model/model_query.h) */
  int capsule_count;
};

/* Speed at which a coordinate's dry friction is smoothed, rad/s or m/s. */
static inline double ambulo__friction_speed(const ambulo_coordinate *coordinate) {
  return coordinate->type == AMBULO_REVOLUTE ? AMBULO_FRICTION_RATE : AMBULO_FRICTION_SPEED;
}

/* The coordinate that moves the joint of a link, its own or the one that it is coupled to; -1: none
 * does. */
static inline int ambulo__moved_by(const ambulo_model *model, int link) {
  int own = model->links[link].coordinate;
  return own >= 0 ? own : model->couplings[link].to;
}
/* Where the joint of a link stands at q [coordinates], rad or m, with its derivatives by the
 * coordinate that moves it; 0 of a fixed link. */
static inline double ambulo__joint_value(const ambulo_model *model, int link, const double *q,
                                         double slope[AMBULO__COUPLING_SLOPES]) {
  int own = model->links[link].coordinate;
  const ambulo__coupling *coupling = &model->couplings[link];
  if (own < 0 && coupling->to >= 0) return ambulo__coupling_value(coupling, q[coupling->to], slope);
  if (slope) {
    slope[0] = own >= 0;
    slope[1] = slope[2] = 0.0;
  }
  return own >= 0 ? q[own] : 0.0;
}
/* After the functions of links have changed. */
void ambulo__model_couple(ambulo_model *model);

/* What is so long along forward, left and up, along the world's axes. */
static inline void ambulo__along_axes(const ambulo_model *model, const double along[3],
                                      double world[3]) {
  for (int k = 0; k < 3; k++)
    world[k] = along[0] * model->forward[k] + along[1] * model->left[k] + along[2] * model->up[k];
}

/* Structural and physical checks of a definition, all of them, each with the
 * name of the link or coordinate it is about. places[i] (may be NULL) is where
 * link i stands in a file. */
typedef struct ambulo__model_places {
  const ambulo__place *links, *coordinates, *points, *feet, *patches, *capsules; /* each may be
                                                                                   NULL */
  ambulo__place model;
} ambulo__model_places;
ambulo_status ambulo__model_check(const ambulo_model_definition *definition,
                                  const ambulo__model_places *places,
                                  ambulo_diagnostics *diagnostics);
/* ambulo_model_create with places for the messages. */
ambulo_status ambulo__model_build(const ambulo_model_definition *definition,
                                  const ambulo__model_places *places,
                                  const ambulo_allocator *allocator,
                                  ambulo_diagnostics *diagnostics, ambulo_model **model);

/* Stature by 1.75 m, the body for which lengths of the engine are stated; 1: stature unknown. */
double ambulo__model_size(const ambulo_model *model);
/* All that it carries, kg. */
double ambulo__model_load_mass(const ambulo_model *model);
/* The body weight m |g|, N: what forces are measured by. */
double ambulo__model_weight(const ambulo_model *model);

/* 1: one point for all of it (ambulo/model.h). */
int ambulo__foot_is_point(const ambulo_foot *foot);
/* Index of a patch by its name; -1: none. */
int ambulo__find_patch(const ambulo_model *model, const char *name);

/* the definition of a caller as one of this library. */

enum { AMBULO__MODEL_ARRAYS = 6 };

/* The caller's arrays where they are of this library's items, else longer ones. */
typedef struct ambulo__taken_model {
  ambulo_model_definition definition;
  ambulo_allocator allocator;
  void *longer[AMBULO__MODEL_ARRAYS];
} ambulo__taken_model;

/* E_ARGUMENT: not from ambulo_model_definition_default(), or arrays that are not there; E_MEMORY.
 * Dropped in either case. */
ambulo_status ambulo__model_take(const ambulo_model_definition *given,
                                 const ambulo_allocator *allocator, ambulo__taken_model *taken);
void ambulo__model_drop(ambulo__taken_model *taken);

#endif
