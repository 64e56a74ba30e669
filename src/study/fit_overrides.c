/* study/fit_overrides.c - from u to numbers of the problem (fit.h).
 *
 * Numbers are rounded to nine digits, so that what is solved is exactly what fitted.yaml and
 * fit.json say. */
#include "base/numtext.h"
#include "study/fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double nine_digits(double value) {
  if (value == 0.0 || !isfinite(value)) return value;
  int place = 8 - (int)floor(log10(fabs(value)));
  if (place < -300 || place > 300) return value;
  /* powers of ten up to 22 are exact: divide by them rather than multiply by tenths */
  double power = pow(10.0, abs(place));
  return place >= 0 ? round(value * power) / power : round(value / power) * power;
}

double ambulo__fit_change(const ambulo__fit_parameter *p, double u) {
  double change = p->scale == AMBULO__FIT_LOG ? exp(p->step * u) : p->step * u;
  return fmin(p->range[1], fmax(p->range[0], change));
}

double ambulo__fit_value(const ambulo__fit_parameter *p, double own, double u) {
  if (u == 0.0) return own;
  double change = ambulo__fit_change(p, u);
  return nine_digits(p->scale == AMBULO__FIT_LOG ? own * change : own + change);
}

static size_t room_for(const ambulo_fit *fit, const ambulo__fit_condition *c, int count) {
  size_t room = (size_t)count * sizeof(char *);
  for (int i = 0; i < c->sets; i++) room += strlen(c->set[i]) + 1;
  for (int i = 0; i < fit->parameters; i++) {
    const ambulo__fit_parameter *p = &fit->parameter[i];
    for (int k = 0; k < p->keys; k++) room += strlen(p->key[k]) + AMBULO__NUMTEXT_SIZE + 2;
  }
  return room;
}

ambulo_status ambulo__fit_overrides(const ambulo_fit *fit, int condition, const double *u,
                                    const char ***overrides, int *count) {
  const ambulo__fit_condition *c = &fit->condition[condition];
  int total = c->sets;
  for (int i = 0; i < fit->parameters; i++) total += fit->parameter[i].keys;
  char *block = ambulo__alloc(&fit->allocator, room_for(fit, c, total), 1);
  if (!block) return AMBULO_E_MEMORY;
  const char **list = (const char **)(void *)block;
  char *at = block + (size_t)total * sizeof *list;
  int n = 0;
  for (int i = 0; i < c->sets; i++) {
    size_t length = strlen(c->set[i]) + 1;
    list[n++] = at;
    memcpy(at, c->set[i], length);
    at += length;
  }
  for (int i = 0; i < fit->parameters; i++) {
    const ambulo__fit_parameter *p = &fit->parameter[i];
    for (int k = 0; k < p->keys; k++) {
      size_t length = strlen(p->key[k]);
      list[n++] = at;
      memcpy(at, p->key[k], length);
      at += length;
      *at++ = '=';
      at += ambulo__print_double(at, ambulo__fit_value(p, p->own[condition * p->keys + k], u[i]));
      *at++ = '\0';
    }
  }
  *overrides = list;
  *count = n;
  return AMBULO_OK;
}
