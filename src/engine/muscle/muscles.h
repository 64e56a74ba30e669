/* muscle/muscles.h - the inside of ambulo_muscles: limbs as kernels read them.
 *
 * Reading order: muscles.h, muscle_check.c, muscles.c, muscle_limbs.c,
 * kernel_functions.h, kernel_fiber.h,
 * kernel_sharing.h, kernel_source.h, sharing.c.
 */
#ifndef AMBULO_MUSCLE_MUSCLES_H
#define AMBULO_MUSCLE_MUSCLES_H

#include "ambulo/muscles.h"
#include "base/alloc.h"
#include "base/diagnostics.h"
#include "base/lanes.h"

enum {
  AMBULO__SPAN = AMBULO_MUSCLE_COORDINATES,
  AMBULO__POWERS = AMBULO_MUSCLE_EXPONENT + 1,
  AMBULO__LIMB_COORDINATES = 8, /* at most */
  AMBULO__MOST_MUSCLES = 1000,
  AMBULO__MOST_TERMS = 400, /* of one muscle */
};

/* Nominal: a muscle's mass is F_max l_o density / stress, its fastest speed 10 l_o/s. Stress and
 * density: Rajagopal et al. (IEEE Trans Biomed Eng 63:2068-2079, 2016). */
static const double ambulo__muscle_stress = 0.6e6;   /* Pa */
static const double ambulo__muscle_density = 1059.7; /* kg/m^3 */
static const double ambulo__fastest = 10.0;          /* l_o/s */

/* One muscle as kernels read it. */
typedef struct ambulo__strand {
  int muscle;                    /* index */
  int span, slots[AMBULO__SPAN]; /* of the limb's coordinates */
  int terms;
  const unsigned char (*exponents)[AMBULO__SPAN];
  const double *coefficients;
  double force, fiber, tendon, height; /* height: l_o sin alpha */
  double passive_strain, mass, fast;   /* kg; share */
  double stretch;                      /* l_s strain of an elastic tendon, else 0; m */
} ambulo__strand;

/* Muscles that share coordinates. */
typedef struct ambulo__muscle_limb {
  int coordinate_count, coordinates[AMBULO__LIMB_COORDINATES]; /* of the model */
  int count;
  ambulo__strand *strands; /* [count] */
  int elastic;             /* slot of the coordinate whose torque stretches tendons; -1 */
  double elastic_torque;   /* sum F_max r(0) of the stretched muscles, N m; its sign too */
  double leverage[AMBULO__LIMB_COORDINATES]; /* sum F_max r(0)^2 / l_o, N m */
} ambulo__muscle_limb;

struct ambulo_muscles {
  ambulo_allocator allocator;
  const ambulo_model *model;
  char *text;
  const char *name, *source;
  ambulo_muscle *muscles; /* [count] */
  int count;
  ambulo_muscle_pull *pulls;
  unsigned char (*exponents)[AMBULO__SPAN];
  double *numbers;
  ambulo__muscle_limb *limbs; /* [limb_count] */
  int limb_count;
  ambulo__strand *strands; /* [count], limb by limb */
  double volume;           /* of all, m^3 in units of F_max l_o / stress */
  unsigned char *fixed;    /* [count] AMBULO__FIXED_FORCE | ... */
};

/* Numbers of a muscle that a problem file gives, which do not grow with the body. */
enum { AMBULO__FIXED_FORCE = 1, AMBULO__FIXED_FIBER = 2, AMBULO__FIXED_TENDON = 4 };

/* ambulo_muscles_create; places[i] (may be NULL) is where muscle i stands in a file. */
ambulo_status ambulo__muscles_build(const ambulo_model *model,
                                    const ambulo_muscles_definition *definition,
                                    const ambulo__place *places, const ambulo_allocator *allocator,
                                    ambulo_diagnostics *diagnostics, ambulo_muscles **muscles);
/* 1: muscles span the coordinate. */
int ambulo__muscles_span(const ambulo_muscles *muscles, int coordinate);
/* Every fault of a definition: muscle_check.c. */
ambulo_status ambulo__muscles_check(const ambulo_model *model,
                                    const ambulo_muscles_definition *definition,
                                    const ambulo__place *places, ambulo_diagnostics *diagnostics);
/* Slope of the length by the muscle's coordinate `index` at q = 0. */
double ambulo__muscle_slope_at_zero(const ambulo_muscle *muscle, int index);
/* Limbs and strands of what is copied: muscle_limbs.c. E_MODEL, E_MEMORY. */
ambulo_status ambulo__muscles_split(ambulo_muscles *muscles, const ambulo__place *places,
                                    ambulo_diagnostics *diagnostics);

/* Prices of one limb's sharing, in the units of its kernel. */
typedef struct ambulo__prices {
  double activation;                        /* of a^2, times the weight */
  int by_volume;                            /* weight F_max l_o / volume, else 1 / count */
  double volume, count;                     /* of the body */
  double metabolic;                         /* per W */
  double reserve[AMBULO__LIMB_COORDINATES]; /* kappa_j, per (N m)^2 */
} ambulo__prices;

/* One block of eight times of a limb with J coordinates and M muscles; every array [..][LANES]. */
typedef struct ambulo__share_block {
  const double *q, *qd, *tau, *tau_rate;       /* [J] */
  double *cost;                                /* [1] */
  double *by_q, *by_qd, *by_tau;               /* [J]; by_tau is the multiplier L */
  double *by_tau_rate;                         /* [J] */
  double *reserve;                             /* [J] e */
  double *activation, *force, *length, *speed; /* [M] */
  double *steps;                               /* [1] */
  double *rows;    /* [J (J + 1) / 2]: of C^-1, A = C C' (kernel_sharing.h) */
  double *scratch; /* as many as the kernels say */
} ambulo__share_block;

typedef void ambulo__share_kernel(const ambulo__muscle_limb *limb, const ambulo__prices *prices,
                                  const ambulo__share_block *block);

/* One per instruction set; NULL where it was built without it. */
typedef struct ambulo__share_kernels {
  ambulo__share_kernel *share;
  size_t (*scratch)(const ambulo__muscle_limb *limb); /* doubles, aligned to 64 bytes */
} ambulo__share_kernels;
extern const ambulo__share_kernels ambulo__share_scalar, ambulo__share_baseline;
#if defined(__x86_64__)
extern const ambulo__share_kernels ambulo__share_avx2, ambulo__share_avx512;
#endif

#endif
