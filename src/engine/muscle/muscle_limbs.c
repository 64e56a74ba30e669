/* muscle/muscle_limbs.c - which muscles are shared together, and how kernels see them.
 *
 * Two muscles belong to one limb when they span a common coordinate, or a chain of muscles joins
 * them: the least muscle that a coordinate leads to, spread until nothing changes.
 */
#include <math.h>
#include <string.h>

#include "muscle/muscles.h"

/* least[muscle]: the first muscle of its limb */
static void find_limbs(const ambulo_muscles *m, int *least) {
  for (int i = 0; i < m->count; i++) least[i] = i;
  for (int changed = 1; changed;) {
    changed = 0;
    for (int i = 0; i < m->count; i++)
      for (int k = 0; k < m->count; k++) {
        int common = 0;
        for (int a = 0; a < m->muscles[i].coordinate_count; a++)
          for (int b = 0; b < m->muscles[k].coordinate_count; b++)
            common |= m->muscles[i].coordinates[a] == m->muscles[k].coordinates[b];
        if (!common || least[i] <= least[k]) continue;
        least[i] = least[k];
        changed = 1;
      }
  }
}

static int slot_of(const ambulo__muscle_limb *limb, int coordinate) {
  int slot = 0;
  while (slot < limb->coordinate_count && limb->coordinates[slot] != coordinate) slot++;
  return slot < limb->coordinate_count ? slot : -1;
}

/* rising, so that a path's slots can rise too; 0: too many */
static int add_coordinate(ambulo__muscle_limb *limb, int coordinate) {
  if (slot_of(limb, coordinate) >= 0) return 1;
  if (limb->coordinate_count == AMBULO__LIMB_COORDINATES) return 0;
  int at = limb->coordinate_count++;
  for (; at > 0 && limb->coordinates[at - 1] > coordinate; at--)
    limb->coordinates[at] = limb->coordinates[at - 1];
  limb->coordinates[at] = coordinate;
  return 1;
}

/* The coordinates of a muscle in rising order, and its exponents with them. */
static void sort_path(ambulo_muscles *m, int muscle) {
  ambulo_muscle *own = &m->muscles[muscle];
  for (int i = 1; i < own->coordinate_count; i++)
    for (int k = i; k > 0 && own->coordinates[k - 1] > own->coordinates[k]; k--) {
      int swapped = own->coordinates[k];
      own->coordinates[k] = own->coordinates[k - 1];
      own->coordinates[k - 1] = swapped;
      for (int end = 0; end < 2; end++) {
        double bound = own->range[k][end];
        own->range[k][end] = own->range[k - 1][end];
        own->range[k - 1][end] = bound;
      }
      for (int p = -1; p < own->pull_count; p++) {
        int terms = p < 0 ? own->term_count : own->pulls[p].term_count;
        const unsigned char(*from)[AMBULO__SPAN] = p < 0 ? own->exponents : own->pulls[p].exponents;
        unsigned char(*exponents)[AMBULO__SPAN] =
            m->exponents + (from - (const unsigned char(*)[AMBULO__SPAN])m->exponents);
        for (int t = 0; t < terms; t++) {
          unsigned char e = exponents[t][k];
          exponents[t][k] = exponents[t][k - 1];
          exponents[t][k - 1] = e;
        }
      }
    }
}

double ambulo__muscle_slope_at_zero(const ambulo_muscle *m, int index) {
  double slope = 0.0;
  for (int t = 0; t < m->term_count; t++) {
    int alone = m->exponents[t][index] == 1;
    for (int i = 0; i < m->coordinate_count; i++) alone &= i == index || m->exponents[t][i] == 0;
    slope += alone ? m->length[t] : 0.0;
  }
  return slope;
}

static ambulo__strand strand_of(const ambulo_muscles *m, const ambulo__muscle_limb *limb,
                                int muscle) {
  const ambulo_muscle *own = &m->muscles[muscle];
  ambulo__strand s = {.muscle = muscle,
                      .span = own->coordinate_count,
                      .terms = own->term_count,
                      .exponents = own->exponents,
                      .coefficients = own->length,
                      .force = own->force,
                      .fiber = own->fiber,
                      .tendon = own->tendon,
                      .height = own->fiber * sin(own->pennation),
                      .passive_strain = own->passive_strain,
                      .fast = own->fast_fibers};
  s.mass = own->force * own->fiber * ambulo__muscle_density / ambulo__muscle_stress;
  s.stretch = own->elastic >= 0 ? own->tendon * own->tendon_strain : 0.0;
  for (int i = 0; i < s.span; i++) s.slots[i] = slot_of(limb, own->coordinates[i]);
  return s;
}

/* where faults go */
typedef struct listener {
  const ambulo__place *places; /* of the muscles; NULL: in no file */
  ambulo_diagnostics *diagnostics;
} listener;

static ambulo_status refuse(const ambulo_muscles *m, const listener *to, int muscle,
                            const char *what) {
  return ambulo__error(to->diagnostics, AMBULO_E_MODEL,
                       to->places ? to->places[muscle] : ambulo__nowhere, NULL,
                       "the limb of muscle '%s' %s", m->muscles[muscle].name, what);
}

/* the torque that stretches the limb's tendons by their whole strain */
static ambulo_status add_elastic(const ambulo_muscles *m, ambulo__muscle_limb *limb, int muscle,
                                 const listener *to) {
  const ambulo_muscle *own = &m->muscles[muscle];
  if (own->elastic < 0) return AMBULO_OK;
  int slot = slot_of(limb, own->elastic), index = 0;
  while (own->coordinates[index] != own->elastic) index++;
  if (limb->elastic >= 0 && limb->elastic != slot)
    return refuse(m, to, muscle, "has tendons that stretch with two coordinates; expected one");
  limb->elastic = slot;
  limb->elastic_torque -= own->force * ambulo__muscle_slope_at_zero(own, index);
  return AMBULO_OK;
}

/* what activations that could push as well would make of torques at q = 0 */
static void add_leverage(const ambulo_muscle *own, ambulo__muscle_limb *limb) {
  for (int k = 0; k < own->coordinate_count; k++) {
    double arm = ambulo__muscle_slope_at_zero(own, k);
    limb->leverage[slot_of(limb, own->coordinates[k])] += own->force * arm * arm / own->fiber;
  }
}

static ambulo_status fill_limb(ambulo_muscles *m, const int *least, int first, const listener *to) {
  ambulo__muscle_limb *limb = &m->limbs[m->limb_count++];
  limb->elastic = -1;
  for (int i = first; i < m->count; i++) {
    if (least[i] != first) continue;
    for (int k = 0; k < m->muscles[i].coordinate_count; k++)
      if (!add_coordinate(limb, m->muscles[i].coordinates[k]))
        return refuse(m, to, i, "has too many coordinates; expected at most 8");
  }
  for (int i = first; i < m->count; i++) {
    if (least[i] != first) continue;
    limb->strands[limb->count++] = strand_of(m, limb, i);
    add_leverage(&m->muscles[i], limb);
    ambulo_status status = add_elastic(m, limb, i, to);
    if (status) return status;
  }
  if (limb->elastic >= 0 && !(fabs(limb->elastic_torque) > 0.0))
    return refuse(m, to, first, "has elastic tendons without a moment arm at q = 0");
  return AMBULO_OK;
}

ambulo_status ambulo__muscles_split(ambulo_muscles *m, const ambulo__place *places,
                                    ambulo_diagnostics *diagnostics) {
  const listener to = {places, diagnostics};
  int *least = ambulo__alloc(&m->allocator, (size_t)m->count, sizeof *least);
  if (!least) return AMBULO_E_MEMORY;
  for (int i = 0; i < m->count; i++) sort_path(m, i);
  find_limbs(m, least);
  ambulo_status status = AMBULO_OK;
  ambulo__strand *next = m->strands;
  for (int i = 0; i < m->count && !status; i++) {
    if (least[i] != i) continue;
    ambulo__muscle_limb *limb = &m->limbs[m->limb_count];
    limb->strands = next;
    status = fill_limb(m, least, i, &to);
    next += limb->count;
  }
  ambulo__free(&m->allocator, least);
  return status;
}
