/* Channels of the arm at three nodes with easy numbers, for the composite terms. */
#ifndef AMBULO_TESTS_FORM_FIXTURE_H
#define AMBULO_TESTS_FORM_FIXTURE_H

#include "base/lanes.h"
#include "problem/term.h"
#include "support/arm.h"
#include "support/test.h"

enum { FORM_CHANNELS = 4 * 2 + 6 + 3 * 2, FORM_NODES = 3 };

typedef struct form_fixture {
  ambulo_model *model;
  double lanes[FORM_CHANNELS * AMBULO__LANES];
  ambulo__term_context context;
} form_fixture;

static inline void form_open(form_fixture *f) {
  f->model = arm_create();
  for (int k = 0; k < AMBULO__LANES; k++)
    for (int c = 0; c < FORM_CHANNELS; c++)
      f->lanes[ambulo__lane_index(k, FORM_CHANNELS, c)] = 1.0 + 0.1 * c + 0.01 * k * c;
  static const double times[FORM_NODES] = {0.0, 0.1, 0.2};
  f->context = (ambulo__term_context){.model = f->model,
                                      .channels = {.coordinates = 2, .points = 2},
                                      .channel_count = FORM_CHANNELS,
                                      .lanes = f->lanes,
                                      .nodes = FORM_NODES,
                                      .times = times};
}

static inline double *form_at(form_fixture *f, int node, int channel) {
  return &f->lanes[ambulo__lane_index(node, FORM_CHANNELS, channel)];
}

/* every slope of the form against a central difference of u in its channel */
static inline void check_form_slopes(form_fixture *f, const ambulo_term *term, int node, int j) {
  ambulo__form form, plus, minus;
  ambulo__term_form(term, &f->context, node, j, &form);
  assert_true(form.count > 0);
  for (int c = 0; c < form.count; c++) {
    double *value = form_at(f, node + form.ahead[c], form.channel[c]), kept = *value, h = 1e-6;
    *value = kept + h;
    ambulo__term_form(term, &f->context, node, j, &plus);
    *value = kept - h;
    ambulo__term_form(term, &f->context, node, j, &minus);
    *value = kept;
    assert_close(form.slope[c], (plus.u - minus.u) / (2.0 * h), 1e-8);
  }
}

static inline void form_close(form_fixture *f) {
  ambulo_model_free(f->model);
}

#endif
