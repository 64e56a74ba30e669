/* formats/motion_write.h - a motion as a table, and in OpenSim's form (docs/results.md). */
#ifndef AMBULO_FORMATS_MOTION_WRITE_H
#define AMBULO_FORMATS_MOTION_WRITE_H

#include "ambulo/device.h"
#include "ambulo/hold.h"
#include "base/text_buffer.h"
#include "model/model.h"

/* A motion to be written; arrays [samples][coordinates], zmp [samples][3]. */
typedef struct ambulo__motion_table {
  const ambulo_model *model;
  const char *name;
  int samples;
  const double *times, *q, *qd, *qdd, *tau, *zmp;
  int feet;                              /* 0: no forces on the feet */
  const double *grf, *cop, *free_moment; /* [samples][feet][3], ..., [samples][feet] */
  const double *grf_moment;              /* [samples][feet][3], about the origin */
  int patches;      /* with columns of their own: patch[patches], which of the model's */
  const int *patch; /* their numbers are [samples][patches of the model][3], ... */
  const double *patch_force, *patch_cop, *patch_free_moment, *patch_moment;
  int devices;                                 /* 0: none */
  const ambulo_device *device;                 /* [devices] */
  const double *effort, *along, *device_power; /* [samples][devices] */
  int holds;                                   /* 0: none */
  const ambulo_hold *hold;                     /* [holds] */
  const double *hold_force, *hold_moment,
      *hold_power; /* [samples][holds][2][3]; [samples][holds] */
  /* of an inverse dynamics; each may be NULL */
  const double *wrench;   /* [samples][6]: moment about the origin, force */
  const double *residual; /* [samples][6]: force, moment about the centre of mass */
  const double *power;    /* [samples][coordinates] */
} ambulo__motion_table;

/* "# ambulo motion: ..." with the body's mass, gravity and the units, header, one line a time:
 * time, q.*, qd.*, qdd.*, tau.*, zmp.x|y|z; with ground reaction for each foot grf.<foot>.x|y|z,
 * cop.<foot>.x|y|z, free_moment.<foot>, moment.<foot>.x|y|z, the same of the patches; for each
 * device device.<name>.torque|force, .angle|length, .power; for each hand that holds something
 * held.<load>.<point>.force.x|y|z, .moment.x|y|z, for each load held.<load>.power; of an inverse
 * dynamics wrench.force.x|y|z, wrench.moment.x|y|z, the same of residual, and power.*; a value that
 * does not exist (the ZMP in flight) is "nan". */
void ambulo__motion_csv(const ambulo__motion_table *table, ambulo__text_buffer *text);

/* Coordinates only, inDegrees=no. */
void ambulo__motion_sto(const ambulo__motion_table *table, ambulo__text_buffer *text);

#endif
