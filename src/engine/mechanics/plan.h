/* mechanics/plan.h - a model compiled for the lane kernels, and the kernels.
 *
 * Compilation merges fixed links into constants, recognises axis-aligned constants
 * (a relabelling of columns, no arithmetic), and lists the structural nonzeros of
 * every Jacobian. Planning happens once; a plan is immutable and may be shared by
 * threads.
 *
 * All kernels work on ONE block of AMBULO__LANES time nodes; every array is
 * [entry][lane], 64-byte aligned, entries as below. d = coordinates, p = points.
 * Outputs are in world axes, moments about the world origin.
 */
#ifndef AMBULO_MECHANICS_PLAN_H
#define AMBULO_MECHANICS_PLAN_H

#include "base/alloc.h"
#include "base/lanes.h"
#include "model/model.h"

typedef struct ambulo__plan ambulo__plan;

/* Errors: E_MEMORY. The plan keeps no pointer to the model. */
ambulo_status ambulo__plan_create(const ambulo_model *model, const ambulo_allocator *allocator,
                                  ambulo__plan **plan);
/* The same, with the wrenches of the ground and of other surfaces on `count` contacts, contact c
 * acting on link[c], by the law of kernel_contacts.h with the reach `moment_arm` (l, m) of a
 * contact's moments, and `slant` (epsilon), the price of force that points past the centre of mass
 * less than that of force towards it: 1 for no preference.
 * Errors: E_ARGUMENT (not 1 to AMBULO__MOST_CONTACTS contacts, no such link, a number that is not
 * positive), E_MEMORY. */
#define AMBULO__MOST_CONTACTS 6
ambulo_status ambulo__plan_create_contacts(const ambulo_model *model, const int *link, int count,
                                           double moment_arm, double slant,
                                           const ambulo_allocator *allocator, ambulo__plan **plan);
/* Makes a plan on contacts take a wrench (M, F) about the world origin that the surroundings must
 * supply besides that of the bodies, from what they hold: after this, once, every kernel reads it
 * at the place of its scratch that is returned, [6][lanes], and the reverse sweep leaves the
 * weights on it, those on the root wrench and all that the contacts make of it, behind it,
 * [6][lanes]. Rows of tau do not have the torques that it takes to carry it to the root. */
size_t ambulo__plan_take_wrench(ambulo__plan *plan);
/* 1: tau of the coordinate vanishes identically, since it carries the whole body on contacts. */
int ambulo__plan_vanishes(const ambulo__plan *plan, int coordinate);
/* A coordinate whose tau vanishes identically although its drive has inertia, damping or friction,
 * which the kernels leave out; -1: none. */
int ambulo__plan_undriven(const ambulo__plan *plan);
void ambulo__plan_free(ambulo__plan *plan); /* accepts NULL */

int ambulo__plan_coordinates(const ambulo__plan *plan);
int ambulo__plan_points(const ambulo__plan *plan);
int ambulo__plan_contacts(const ambulo__plan *plan); /* 0: without ground reaction */
/* Doubles of scratch that any kernel needs; 64-byte aligned. The scratch carries
 * the forward pass over to the reverse sweep. */
size_t ambulo__plan_scratch(const ambulo__plan *plan);

/* Output rows of the mechanics, in this order: tau (d rows), moment (3), force
 * (3), point coordinates (3 p: x, y, z of point 0, then of point 1, ...); with
 * ground reaction then, for each contact, the force on it (3) and the moment
 * about its own centre (3), and the centre of mass (3).
 *
 * Joints that carry all contacts and every body have tau = 0: what they
 * would need, the contacts supply. At a node where no contact has weight (flight)
 * nobody does: there the root wrench must be held at zero by who wants a motion that
 * can be. */
static inline int ambulo__plan_rows(const ambulo__plan *plan) {
  int contacts = ambulo__plan_contacts(plan);
  return ambulo__plan_coordinates(plan) + 6 + 3 * ambulo__plan_points(plan) +
         (contacts > 0 ? 6 * contacts + 3 : 0);
}
/* First of the rows that only a plan with ground reaction has. */
static inline int ambulo__plan_first_contact_row(const ambulo__plan *plan) {
  return ambulo__plan_coordinates(plan) + 6 + 3 * ambulo__plan_points(plan);
}

/* Structural nonzeros of the Jacobian of output row r: columns
 * column[start[r] .. start[r+1]), ascending coordinate indices. Rows tau, moment
 * and force depend on q, qd and qdd through the same columns; rows of points on q
 * only. Entry e of row r stands at e in jq, and at rate_start[r] + e - start[r] in
 * jqd, and in jqdd at by_qdd[] of that: the mass matrix is symmetric, and its
 * entries below the diagonal stand above it, or in rows of the root force.
 *
 * What follows from other rows is not stored (ambulo__plan_parts). Without entries are:
 * with ground reaction, the rows of tau that vanish identically (joints that carry the
 * whole body), and those of the contacts and of the centre of mass; without, the rows of
 * tau that are rows of the root force (the sliders along world axes with which the whole body
 * stands on the world). With ground reaction a row of tau above a contact has entries for
 * what it would be if these wrenches stood still in the world; the rest is a product with the rows
 * of the root wrench, whose factors stand behind the entries of jq: from start[rows] to count. */
typedef struct ambulo__plan_pattern {
  const int *start;      /* [rows + 1] */
  const int *column;     /* [start[rows]] */
  const int *rate_start; /* [rows]; -1: the row depends on q only, or has no entries */
  const int *by_qdd;     /* [dynamic_count] */
  int dynamic_count;     /* entries of the rows that also depend on qd and qdd */
  int count;             /* entries and factors in jq */
} ambulo__plan_pattern;
ambulo__plan_pattern ambulo__plan_get_pattern(const ambulo__plan *plan);

/* The gradient of a row, made of those of some rows with entries: by q, qd and qdd it
 * is `factor` times theirs, times what stands at `times` in jq (-1: nothing), summed. A
 * `by_acceleration` part gives the row's gradient by q by that of its own row by qdd,
 * and nothing by qd and qdd. */
typedef struct ambulo__row_part {
  int row, by_acceleration, times;
  double factor;
} ambulo__row_part;
#define AMBULO__MOST_PARTS 10
/* Returns how many parts there are. Without ground reaction there is one, with a factor of 1 or -1,
 * not by acceleration; a row that has entries is the first part of itself, and so is one that
 * vanishes. The same for the wrench and points with ground reaction. */
int ambulo__plan_parts(const ambulo__plan *plan, int row,
                       ambulo__row_part part[AMBULO__MOST_PARTS]);

/* How many entries [lanes] a plan reads of a block's ground: 0 without contacts, else 3 + 4 K: a
 * point o near them (3, world axes, m; no result depends on it but by rounding), then for each
 * contact its weight (not negative; only the proportions count; all zero: flight) and its centre
 * (3, world axes, m). All are finite, also those of a contact without weight. */
int ambulo__plan_ground_entries(const ambulo__plan *plan);

/* Kernels, one set per instruction set. q, qd, qdd: [d]. ground: NULL unless the
 * plan is on contacts; the same for the three calls. */
typedef struct ambulo__kernels {
  const char *name; /* "avx512", "avx2", "baseline", "scalar" */

  /* out: [rows], see above. */
  void (*outputs)(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                  const double *ground, double *out, double *scratch);

  /* The same, and fills scratch for the next. */
  void (*forward)(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                  const double *ground, double *out, double *scratch);

  /* After forward on the same scratch, as often as wanted: given weights on the outputs [rows], the
   * gradient of sum_r weight_r out_r with respect to q, qd, qdd ([d] each). */
  void (*reverse)(const ambulo__plan *plan, const double *qd, const double *qdd,
                  const double *ground, const double *weights, double *gq, double *gqd,
                  double *gqdd, double *scratch);

  /* Jacobian entries in pattern order, and factors: jq [count], jqd and jqdd [dynamic_count]. The
   * arrays must be zero before the first call: entries that vanish identically (what a displacement
   * of the whole body leaves as it is) are never written, and of jqdd only those that by_qdd names.
   * Needs no forward before; reverse needs one after it. */
  void (*jacobian)(const ambulo__plan *plan, const double *q, const double *qd, const double *qdd,
                   const double *ground, double *jq, double *jqd, double *jqdd, double *scratch);
} ambulo__kernels;

/* The fastest set this processor can run; the environment variable AMBULO_ISA
 * (avx512, avx2, baseline, scalar) overrides it where the processor allows. */
const ambulo__kernels *ambulo__kernels_select(void);
/* A set by name, NULL if unknown or not runnable here. */
const ambulo__kernels *ambulo__kernels_by_name(const char *name);

/* The compiled kernel sets: only those that the compiler could build exist. */
extern const ambulo__kernels ambulo__kernels_scalar;
extern const ambulo__kernels ambulo__kernels_baseline;
#if defined(__x86_64__)
/* Without functions (all NULL) when the file was built without its instruction set. */
extern const ambulo__kernels ambulo__kernels_avx2;
extern const ambulo__kernels ambulo__kernels_avx512;
#endif

/* Name of the selected set: "avx512", "avx2", "baseline" or "scalar". The best that the processor
 * has, or what AMBULO_ISA in the environment names. */
const char *ambulo__instruction_set(void);

#endif
