/* people/metabolic.h - the metabolic power of a muscle, by two published models.
 *
 * With the activation a, the mass m, the share f of fast fibres, the fibres' length n (l_o) and
 * speed v (l_o/s), the force F along the fibres that activation gives, F_iso = F_max f_l a, and
 * f_l(n):
 *
 * Bhargava, Pandy & Anderson (J Biomech 37:81-88, 2004), with u_s = sin(pi a / 2),
 * u_f = 1 - cos(pi a / 2), and f_l for their piecewise factor of length:
 *
 *     activation    m (40 (1 - f) u_s + 133 f u_f)
 *     maintenance   m (74 (1 - f) u_s + 111 f u_f) f_l
 *     shortening    -(0.16 F_iso + 0.18 F) l_o v,  v <= 0;   -0.157 F l_o v,  v > 0
 *     work          -F l_o v
 *
 * Umberger, Gerritsen & Martin (Comput Methods Biomech Biomed Engin 6:99-111, 2003), aerobic
 * (S = 1.5), the excitation taken as a, V the fastest speed of fast fibres, 12 l_o/s, V / 2.5 of
 * slow ones:
 *
 *     h_AM = S a^0.6 (128 f + 25),   times 0.4 + 0.6 f_l beyond l_o
 *     h_SL = -S a^2 v (min(100, 4 25 / (V / 2.5)) ...) while shortening, S a 4 (100 / (V / 2.5)) v
 *            while lengthening; times f_l beyond l_o
 *     power  m (h_AM + h_SL) - F l_o v
 *
 * Heat is at least 1 W/kg of muscle, power at least 0: negative work is no fuel. */
#ifndef AMBULO_PEOPLE_METABOLIC_H
#define AMBULO_PEOPLE_METABOLIC_H

#include "ambulo/muscles.h"

typedef struct ambulo__metabolic {
  double heat, work; /* W, of activation, maintenance and shortening; of the fibres */
  double power;      /* W */
} ambulo__metabolic;

typedef struct ambulo__fiber_state {
  double activation, length, speed; /* l_o, l_o/s */
  double force;                     /* along the fibres, of activation, N */
} ambulo__fiber_state;

ambulo__metabolic ambulo__bhargava(const ambulo_muscle *muscle, const ambulo__fiber_state *state);
ambulo__metabolic ambulo__umberger(const ambulo_muscle *muscle, const ambulo__fiber_state *state);

/* f_l and f_v of ambulo/muscles.h */
double ambulo__force_by_length(double n);
double ambulo__force_by_speed(double v); /* v in l_o/s */

#endif
