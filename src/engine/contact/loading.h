/* contact/loading.h - since when a foot is loaded, until when, and how much it carries. */
#ifndef AMBULO_CONTACT_LOADING_H
#define AMBULO_CONTACT_LOADING_H

#include "contact/contact_image.h"
#include "contact/foot_outline.h"

/* 1 if `contact` is active at `time`: from <= time < to, both within 1e-9 s; a contact that
 * ends at `duration` includes it. */
int ambulo__contact_holds(const ambulo_contact *contact, double duration, double time);

/* The uninterrupted contact of an effector around `time`; 0 if it is in the air. */
int ambulo__loaded_span(const ambulo_problem_definition *definition, int effector, double time,
                        ambulo__span *span);
/* The time in the air around `time`: from the last toe-off to the next strike, at most
 * [0, T] if the motion does not repeat. */
ambulo__span ambulo__air_span(const ambulo_problem_definition *definition, int foot, double time);

/* The contact of an effector at `time`, NULL if there is none. */
const ambulo_contact *ambulo__contact_of(const ambulo_problem_definition *definition, int effector,
                                         double time);
/* Just before `time`. */
const ambulo_contact *ambulo__contact_before(const ambulo_problem_definition *definition,
                                             int effector, double time);

/* How the ground's force is shared at a time. */
typedef struct ambulo__load {
  double share[2]; /* of foot 0 and 1; sum 1 */
  double apart[2]; /* D: nominal centre of pressure of foot 0 less that of foot 1, along
                      forward and left, m; 0 unless both are loaded */
} ambulo__load;
/* `outlines`: of the model's two feet. */
ambulo__load ambulo__load_at(const ambulo_problem_definition *definition,
                             const ambulo__foot_outline *outlines, double time);

/* How far the box of a contact on the heel has rolled at a time: 0 at the strike, 1 when the foot
 * is flat. `begins`: the contact whose `from` the strike is. */
typedef struct ambulo__roll {
  double part, duration; /* s: from strike to flat */
  int begins;
} ambulo__roll;
ambulo__roll ambulo__heel_roll_at(const ambulo_problem_definition *definition,
                                  const ambulo_contact *contact, double time);

/* How the share of foot 0 changes with the time, and with those of the double support around it;
 * 1/s. Zero while one foot is loaded. */
typedef struct ambulo__share_slopes {
  double by_time, by_begin, by_end;
  int begins, ends; /* the contacts that `from` and `to` of the double support are those of */
} ambulo__share_slopes;
ambulo__share_slopes ambulo__load_slopes_at(const ambulo_problem_definition *definition,
                                            double time);

#endif
