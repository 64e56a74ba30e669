/* contact/bounds.h - the limits of a coordinate as they hold in a problem.
 *
 * Mirrored ends predict one step of a stride; the other step is its mirror image, in which m takes
 * the place of i:
 *
 *     q_m(T + t) = s q_i(t) + shift_m,   and so for speed and torque, without the shift
 *
 * A limit has to hold in both: y_i keeps within its own interval and within the one that m's limits
 * leave it, (lo_m - shift_m) .. (hi_m - shift_m) times s. A coordinate that is its own image with
 * s = -1 keeps within [lo, hi] and [-hi, -lo]. Every reader of a limit that acts on a problem reads
 * it here; other ends leave the model's limits as they are. */
#ifndef AMBULO_CONTACT_BOUNDS_H
#define AMBULO_CONTACT_BOUNDS_H

#include "contact/row_table.h"
#include "model/model.h"

/* One end of such an interval, and the limit of the model that it comes from. */
typedef struct ambulo__bound {
  double value; /* on y_i; +-INFINITY without limit */
  int owner;    /* coordinate whose limit it is */
  int is_upper; /* of the owner's two limits the upper one */
  double given; /* what the model says: rad, m, per s, N m, N */
  double later; /* s by which the owner comes to it after i: 0 or T */
} ambulo__bound;

typedef struct ambulo__bounds {
  ambulo__bound low, high; /* low.value > high.value: the two halves leave nothing */
} ambulo__bounds;

ambulo__bounds ambulo__bounds_of(const ambulo_problem_definition *definition, int coordinate,
                                 ambulo_limited what);

/* range, speed or torque of a coordinate: [lower, upper] */
const double *ambulo__limits_of(const ambulo_coordinate *coordinate, ambulo_limited what);

/* What the model says about the limit that a row of ambulo__limit_rows holds. */
double ambulo__limit_given(const ambulo_model *model, const ambulo__table_row *row);

/* Which ends of the interval come from limits that hold in the mirrored half; "" if none does. */
enum { AMBULO__WHOSE_SIZE = 320 };
void ambulo__bounds_whose(const ambulo_model *model, const ambulo__bounds *bounds,
                          char text[AMBULO__WHOSE_SIZE]);

#endif
