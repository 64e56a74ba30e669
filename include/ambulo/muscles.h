/* ambulo/muscles.h - muscles on a skeleton: force, sharing of torques and cost.
 *
 * A muscle spans one to four coordinates. Its length is a polynomial in them, so that moment arms
 * and their derivatives are exact:
 *
 *     l(q) = sum_t c_t prod_j q_j^e_tj,    r_j = -dl/dq_j,    v = sum_j dl/dq_j qd_j
 *
 * A positive moment arm turns its coordinate forward when the muscle pulls. The tendon is rigid, or
 * stretches by a share s of its strain (below): x = l - l_s (1 + strain s), and the fibres have the
 * length l_M = sqrt(x^2 + (l_o sin alpha)^2) and the speed v_M = x' x / l_M. The force along the
 * tendon is affine in the activation a,
 *
 *     F = a F_max f_l(l_M / l_o) f_v(v_M / (10 l_o / s)) cos + F_max f_p(l_M / l_o) cos,  cos = x /
 * l_M
 *
 * with the curves of De Groote, Kinney, Rao & Fregly (Ann Biomed Eng 44:2922-2936, 2016). Two
 * differences: f_p = exp(4 ((l - 1) / strain - 1)), and f_v ends smoothly at 0.01.
 *
 * Joints' torques do not say which muscle pulls. At each time the one sharing of least cost is
 * taken (ambulo_muscles_share), limb by limb: muscles that share coordinates, directly or through
 * others, are one limb.
 *
 * Objects are immutable and may be shared between threads. Units: SI and radians.
 */
#ifndef AMBULO_MUSCLES_H
#define AMBULO_MUSCLES_H

#include "ambulo/model.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ambulo_muscles ambulo_muscles;

enum { AMBULO_MUSCLE_COORDINATES = 4, AMBULO_MUSCLE_EXPONENT = 6 }; /* at most */

/* How a muscle's length changes when a joint comes apart: the link below it, and all that hangs on
 * that, is moved along the axes of a link above it. By virtual work, -F times it is the muscle's
 * force on what is moved. Polynomials in the coordinates of the muscle. */
typedef struct ambulo_muscle_pull {
  const char *joint; /* its name, "hip_r"; the same for all muscles that cross it */
  int link;          /* below the joint */
  int axes;          /* the link whose frame has the axes */
  int term_count;
  const unsigned char (*exponents)[AMBULO_MUSCLE_COORDINATES]; /* [term_count] */
  const double (*slopes)[3];                                   /* [term_count] x, y, z, m/m */
} ambulo_muscle_pull;
AMBULO_DEFAULT(ambulo_muscle_pull); /* links that must be set */

typedef struct ambulo_muscle {
  const char *name;      /* unique */
  const char *group;     /* such as "plantarflexors"; "": none */
  int mirror;            /* its counterpart in the mirror image (in a definition -1: itself) */
  double force;          /* F_max, isometric at l_o, N; > 0 */
  double fiber;          /* l_o, optimal fibre length, m; > 0 */
  double tendon;         /* l_s, slack length, m; >= 0 */
  double pennation;      /* alpha at l_o, rad; 0 to 1.4 */
  double passive_strain; /* of the fibres where they bear F_max without activation; > 0 */
  double fast_fibers;    /* share of fast fibres, 0 to 1 */
  /* An elastic tendon stretches with the torque of one coordinate, in common with all muscles of
   * the limb that say so: s = smooth max(0, tau / sum F_max r(0)). */
  int elastic;          /* the coordinate; -1: rigid */
  double tendon_strain; /* at s = 1; > 0 with `elastic` */
  int coordinate_count; /* 1 to 4 */
  int coordinates[AMBULO_MUSCLE_COORDINATES];
  double range[AMBULO_MUSCLE_COORDINATES][2]; /* where the polynomial holds, rad; not enforced */
  int term_count;
  const unsigned char (*exponents)[AMBULO_MUSCLE_COORDINATES]; /* [term_count]; each at most 6 */
  const double *length;                                        /* [term_count] c_t */
  const ambulo_muscle_pull *pulls;                             /* [pull_count] */
  int pull_count;
} ambulo_muscle;
/* No elastic tendon, own mirror, passive strain 0.6, half of the fibres fast, no range; the rest
 * must be set. */
AMBULO_DEFAULT(ambulo_muscle);

/* Arrays are borrowed during the call only. */
typedef struct ambulo_muscles_definition {
  size_t size, muscle_size, muscle_pull_size; /* set by ambulo_muscles_definition_default() */
  const char *name;
  const char *source; /* credits and licence, carried to results; "" */
  const ambulo_muscle *muscles;
  int muscle_count;
} ambulo_muscles_definition;
#ifndef AMBULO_DECLARATIONS_ONLY
static inline ambulo_muscles_definition ambulo_muscles_definition_default(void) { /* no muscles */
  ambulo_muscles_definition usual;
  usual.size = sizeof usual;
  usual.muscle_size = sizeof(ambulo_muscle);
  usual.muscle_pull_size = sizeof(ambulo_muscle_pull);
  ambulo_defaults("ambulo_muscles_definition", &usual, sizeof usual);
  return usual;
}
#endif

/* Checks the definition and builds the muscles. `model` must outlive them; `allocator` and
 * `diagnostics` may be NULL. Free with ambulo_muscles_free. Errors: E_ARGUMENT, E_MODEL (a number
 * out of range, a coordinate that is not there or not a joint's, a limb of more than 8
 * coordinates), E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_muscles_create(
    const ambulo_model *model, const ambulo_muscles_definition *definition,
    const ambulo_allocator *allocator, ambulo_diagnostics *diagnostics, ambulo_muscles **muscles);
AMBULO_API void ambulo_muscles_free(ambulo_muscles *muscles); /* accepts NULL */

/* Pointers belong to the muscles. Out-of-range indices give NULL; names that do not exist -1. */
AMBULO_API const char *ambulo_muscles_name(const ambulo_muscles *muscles);
AMBULO_API const char *ambulo_muscles_source(const ambulo_muscles *muscles);
AMBULO_API int ambulo_muscles_count(const ambulo_muscles *muscles);
AMBULO_API const ambulo_muscle *ambulo_muscles_get(const ambulo_muscles *muscles, int index);
AMBULO_API int ambulo_muscles_find(const ambulo_muscles *muscles, const char *name);

/* Prices of the sharing. With the mass m, the stature H and the gravity g of the body, the volume
 * share w_i = V_i / sum V (V = F_max l_o), the metabolic power W_i(a_i) of muscle i, and what no
 * muscle supplies, e_j = tau_j - sum_i r_ij F_i, the cost at one time is
 *
 *     sum_i activation w_i a_i^2 + metabolic W_i / (m g sqrt(g H)) + sum_j reserve (e_j / (0.001 m
 * g H))^2
 *
 * over 0 <= a <= 1. W_i is a convex quadratic in a: Bhargava, Pandy & Anderson (J Biomech 37:81-88,
 * 2004) with slow fibres recruited as a and fast ones as a^2, heat of shortening 0.25 and work 1 of
 * F v_M; lengthening earns nothing. */
typedef struct ambulo_sharing {
  size_t size;       /* set by ambulo_sharing_default() */
  double activation; /* >= 0; 1 */
  double metabolic;  /* >= 0, one of the two > 0; 0 */
  double reserve;    /* > 0; 0.2 */
  int by_volume;     /* 1: w_i as above; 0: the same for all muscles; 1 */
} ambulo_sharing;
AMBULO_DEFAULT(ambulo_sharing);

/* n states, d coordinates of the model. Torques of coordinates that no muscle spans are not looked
 * at. */
typedef struct ambulo_sharing_states {
  size_t size; /* set by ambulo_sharing_states_default() */
  int count;   /* n >= 1 */
  const double *q, *qd, *tau;
  const double *tau_rate; /* dtau/dt, which moves elastic tendons; NULL: 0 */
} ambulo_sharing_states;
AMBULO_DEFAULT(ambulo_sharing_states); /* 0, NULL: must be set */

/* Where results of a sharing go, n times, d coordinates of the model, m muscles; NULL: not wanted.
 * Gradients are those of the cost, exact by its multipliers. */
typedef struct ambulo_sharing_outputs {
  size_t size;                  /* set by ambulo_sharing_outputs_default() */
  double *cost;                 /* [n] */
  double *activation;           /* [n][m], 0 to 1 */
  double *force;                /* [n][m] along the tendon, N */
  double *length, *speed;       /* [n][m] of the fibres, in l_o and l_o/s; lengthening > 0 */
  double *reserve;              /* [n][d] e_j, N m; 0 where no muscle spans the coordinate */
  double *by_q, *by_qd;         /* [n][d] */
  double *by_tau, *by_tau_rate; /* [n][d] */
  int *steps;                   /* [n] of Newton's method, the most of all limbs */
} ambulo_sharing_outputs;
AMBULO_DEFAULT(ambulo_sharing_outputs); /* NULL */

/* Shares torques. There is always a sharing: what muscles cannot do is reserve. `allocator` may be
 * NULL. Errors: E_ARGUMENT, E_NUMERIC (an input is not finite; outputs are then untouched),
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_muscles_share(const ambulo_muscles *muscles, const ambulo_sharing *sharing,
                     const ambulo_sharing_states *states, const ambulo_allocator *allocator,
                     const ambulo_sharing_outputs *outputs);

#ifdef __cplusplus
}
#endif
#endif
