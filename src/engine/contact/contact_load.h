/* contact/contact_load.h - how long a foot or a patch is down without interruption, and beside
 * which others.
 */
#ifndef AMBULO_CONTACT_CONTACT_LOAD_H
#define AMBULO_CONTACT_CONTACT_LOAD_H

#include "contact/foot.h"
#include "contact/contacts.h"

/* Times, s, may lie outside [0, T] in a motion that repeats. */
typedef struct ambulo__stance {
  double from, to; /* infinite where it never came down or leaves: in a motion that repeats
                      if it is down all the time, in another where that begins or ends with it */
  double leaves;   /* those of other feet and patches that hold as it begins: when the first of them
                      ends, at the latest half-way; -infinity: none, or it has no beginning */
  double comes;    /* those that hold as it ends: when the last of them began, at the earliest
                      half-way; infinity: none, or it has no end */
  int leaves_half_way, comes_half_way; /* 1: that is half-way */
  ambulo__span phase;                  /* the part of it in the contact's mode */
  int before, after;                   /* modes of the parts before and after; -1: none */
} ambulo__stance;

/* Of the foot or patch of one of the definition's contacts, at that contact. */
ambulo__stance ambulo__stance_of(const ambulo_problem_definition *definition,
                                 const ambulo_contact *contact);
/* How long one of `modes` holds the foot (a patch: its only one) without interruption, around a
 * contact in one of them; infinite as above. */
ambulo__span ambulo__stance_in(const ambulo_problem_definition *definition,
                               const ambulo_contact *contact, int modes);

/* what the law that shares the load among contacts is told of them.
 *
 * A slot is a link that contacts act on: of each foot the link of its heel and, behind a joint of
 * the toes, that of its toe centre; of each patch in contact its own. At most one contact of a slot
 * is down at a time. */

enum { AMBULO__MOST_SLOTS = 6 };

/* How far ahead of the ball the centre under the toes is, m of a body of 1.75 m. */
#define AMBULO__BEYOND_BALL 0.02
/* Of the time that a foot is flat: the least over which that centre comes there, and goes on. */
#define AMBULO__SHORTEST_GLIDE (1.0 / 16.0)

typedef struct ambulo__slots {
  int count;
  int effector[AMBULO__MOST_SLOTS]; /* whose (contact/contacts.h); slot f < foot_count is foot f's
                                     */
  int link[AMBULO__MOST_SLOTS];
  int part[AMBULO__MOST_SLOTS]; /* an ambulo__slot_part */
} ambulo__slots;

typedef enum ambulo__slot_part {
  AMBULO__WHOLE_FOOT, /* no joint between heel and toes */
  AMBULO__REAR_FOOT,
  AMBULO__FORE_FOOT,
  AMBULO__WHOLE_PATCH
} ambulo__slot_part;

/* Of all feet, and of the patches that are in contact at some time. `count` may exceed
 * AMBULO__MOST_SLOTS, of which the arrays then have the first. */
ambulo__slots ambulo__slots_of(const ambulo_problem_definition *definition);

/* What messages call it: the foot or patch, of two parts the points of its heel and toe centre. */
const char *ambulo__slot_name(const ambulo_model *model, const ambulo__slots *slots, int slot);

/* A slot at a time. */
typedef struct ambulo__contact_load {
  int loaded;       /* 0: all else is zero */
  double weight;    /* w, 0 to 1 */
  double center[3]; /* p: world, m */
  double box[2],
      side;      /* where pressure may be: from behind to ahead of the centre, to either side, m */
  int cut[2];    /* 1: that end of it is at the joint of the toes */
  double rolled; /* how much of heel_roll is in it */
  double since, until; /* it came down, it leaves: s from now on either side; may be infinite */
  int arc;             /* point of the arc on which the foot rolls, or -1 */
  double most;         /* normal force, body weights; may be infinite */
  double most_by_time; /* its derivative by ln T, all times being shares of the duration T */
  ambulo__contact_frame frame; /* of the contact */
} ambulo__contact_load;

/* `contact` NULL: that which is active at `time`; else that contact, at one of its ends.
 * `outlines`: of the model's feet. */
ambulo__contact_load ambulo__contact_load_at(const ambulo_problem_definition *definition,
                                             const ambulo__foot_outline *outlines,
                                             const ambulo__slots *slots, int slot,
                                             const ambulo_contact *contact, double time);

#endif
