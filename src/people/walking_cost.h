/* people/walking_cost.h - what a walk costs a person, estimated from its mechanics.
 *
 * Over a motion that repeats (whole strides, stride.h), of duration T, with the force F_f on foot
 * f, the centre of mass c, its mean velocity w, the masses m with and m_0 without what is carried,
 * and the way D along forward:
 *
 *     W = sum_f integral max(0, F_f . dc/dt) dt       legs' positive work on the centre of mass, J
 *     U = m integral |dc/dt - w|^2 dt                 its unsteadiness, J s
 *     S = sum_f n_f^2 I_f / A_f^2                     swinging of the legs, N m/s
 *         I_f = integral of sum_i |tau_i| while f is in the air, i the joints from f to the root
 *         A_f the time in the air, n_f how often: I_f / A_f over the duration A_f / n_f, n_f times
 *
 *     E = max(0, W + damping U - recoil m_0 g D) / efficiency + force S       J, net of standing
 *
 * W: each leg works on the body by itself, and in double support one gives while the other takes
 * (individual limbs: Donelan, Kram & Kuo, J Biomech 35:117-124, 2002). damping U: what soft tissues
 * lose beyond what they give back, which joints of rigid bodies do not see; in people 7.5 J less 4
 * J a step at 1.25 m/s (Zelik & Kuo, J Exp Biol 213:4257-4264, 2010). recoil: what tendons give
 * back. force S: short forces cost more than long ones, by force over time (Doke, Donelan & Kuo, J
 * Exp Biol 208:439-445, 2005). efficiency: of positive work; Margaria (1968) has 0.25.
 *
 * bench/walking_cost.py calibrates damping, recoil and force on the level at 1.25 m/s, on steps 0.3
 * m wide and on 4 kg on each foot; models/sweep_conditions.yaml has the rest for a test. With
 * lengths times l and gravity times g, times go with sqrt(l / g): damping with 1 / time, force with
 * time. */
#ifndef AMBULO_PEOPLE_WALKING_COST_H
#define AMBULO_PEOPLE_WALKING_COST_H

#include "people/stride.h"

typedef struct ambulo__walking_cost {
  int is_walk;                       /* 0: nothing else is set */
  double limbs, unsteadiness, swing; /* W, J; U, J s; S, N m/s */
  double distance;                   /* D, m */
  double net;                        /* E, J */
  double per_kg_metre;               /* by m_0 and D, J/(kg m) */
  double people; /* of people on the level, unloaded, at this speed, J/(kg m); NaN: not known */
} ambulo__walking_cost;

/* A walk repeats, goes forward, has a foot on the ground at all times and every foot in the air at
 * some; nothing else bears it, and no device works. Errors: E_MEMORY; *cost is then untouched. */
ambulo_status ambulo__walking_cost_of(const ambulo__stride *stride,
                                      const ambulo_allocator *allocator,
                                      ambulo__walking_cost *cost);

/* Net cost of people on the level, J/(kg m), v from 0.65 to 1.85 m/s, else NaN:
 *
 *     (2.02 + 1.33 v^2 - 1.25) / v,   gross power 29 + 0.0053 (v / (m/min))^2 cal/(kg min)
 *
 * (Ralston, Int Z Angew Physiol 17:277-283, 1958), less that of standing, W/kg. */
double ambulo__people_walking_cost(double speed);

#endif
