/* contact/contacts.h - feet and patches, their surfaces, when they are down and what they weigh.
 *
 * What touches is a foot or a patch, an *effector*; contacts of a motion that repeats go on beyond
 * its ends. */
#ifndef AMBULO_CONTACT_CONTACTS_H
#define AMBULO_CONTACT_CONTACTS_H

#include "ambulo/problem.h"
#include "base/alloc.h"
#include "model/model.h"

int ambulo__effector_count(const ambulo_model *model);
/* Of a contact of a foot or a patch that the model has. */
int ambulo__effector_of(const ambulo_model *model, const ambulo_contact *contact);
/* The model's patch, or -1: a foot. */
int ambulo__effector_patch(const ambulo_model *model, int effector);
/* What takes its place in the mirror image. */
int ambulo__effector_mirror(const ambulo_model *model, int effector);
/* "foot" or "patch"; its name. */
const char *ambulo__effector_kind(const ambulo_model *model, int effector);
const char *ambulo__effector_name(const ambulo_model *model, int effector);

/* 1 if the model has the foot or the patch that a contact names. */
int ambulo__effector_is_known(const ambulo_model *model, const ambulo_contact *contact);
/* 1 if some contact is of that patch or, with mirrored ends, of its mirror image. */
int ambulo__patch_is_used(const ambulo_problem_definition *definition, int patch);
/* 1 if some contact is of a patch. */
int ambulo__holds_patches(const ambulo_problem_definition *definition);

/* contacts of a motion that repeats, beyond its ends. */

typedef struct ambulo__span {
  double from, to;  /* s; may lie outside [0, T] where the motion repeats */
  int begins, ends; /* the contact with whose start or end the span begins, and ends; -1: none.
                       Loaded: its `from`, `to`; in the air: its `to`, `from` */
} ambulo__span;

/* How many periods before and after are looked at; 0 for a motion that does not repeat. */
int ambulo__image_periods(const ambulo_problem_definition *definition);
/* The effector of contact `index` (contact/contacts.h), `period` periods later; when that holds;
 * and all of it then. */
int ambulo__image_effector(const ambulo_problem_definition *definition, int index, int period);
ambulo__span ambulo__image_span(const ambulo_problem_definition *definition, int index, int period);
ambulo_contact ambulo__contact_image(const ambulo_problem_definition *definition, int index,
                                     int period);

/* What a mode decides: a row of the table in foot.c. */
typedef struct ambulo__mode {
  const char *word;    /* in files and scenes */
  const char *posture; /* how the foot is, in messages */
  int corners[2];      /* 1: toe corners are down, heel corners are: what holds the foot in place */
  int is_of_patch;
} ambulo__mode;

/* NULL: no mode, -1 included. */
const ambulo__mode *ambulo__mode_of(int mode);
/* All corners are down, so that the foot can neither pitch nor roll; toe corners alone; heel
 * corners alone. 0 of no mode. */
int ambulo__mode_is_flat(int mode);
int ambulo__mode_is_on_toes(int mode);
int ambulo__mode_is_on_heel(int mode);
int ambulo__mode_is_of_patch(int mode);

/* Sets of modes: 1 << mode, added. */
enum { AMBULO__ANY_MODE = -1 };
/* Those with the toe corners down, with the heel corners down. */
int ambulo__modes_with(int heel);

/* A span of contact of an effector, made as long as contacts in one of `modes` touch it. */
ambulo__span ambulo__uninterrupted(const ambulo_problem_definition *definition, int effector,
                                   int modes, ambulo__span span);

/* which contact holds a foot or patch when. */

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

/* where a contact is in the world, and the axes of its surface.
 *
 * With the model's forward f, left l and up n, the ground's height h, and of the contact the place
 * p, the surface normal u (zero: up) and the heading psi,
 *
 *     origin = p_f f + p_l l + (h + p_n) n
 *     left    = unit(u x (cos psi f + sin psi l)),   forward = left x u
 *
 * in world axes. On level ground, heading 0, they are f, l and n themselves. Where u is within 25
 * degrees of the heading or its opposite (the wall that a hand pushes) n takes the heading's place:
 * forward is up the wall. */

typedef struct ambulo__contact_frame {
  double origin[3];
  double forward[3], left[3], up[3];
} ambulo__contact_frame;

ambulo__contact_frame ambulo__contact_frame_of(const ambulo_problem_definition *definition,
                                               const ambulo_contact *contact);
/* The surface under a foot in the air, `share` (0 to 1) of the way from one contact to the next:
 * places, headings and normals between theirs. A foot that goes up rises in the first half of the
 * way, one that goes down sinks in the second, so that it passes the edge of a step. */
ambulo__contact_frame ambulo__contact_frame_between(const ambulo_problem_definition *definition,
                                                    const ambulo_contact *from,
                                                    const ambulo_contact *to, double share);
/* The contact that such a surface would be of. */
ambulo_contact ambulo__contact_between(const ambulo_contact *from, const ambulo_contact *to,
                                       double share);
/* direction . (point - origin) */
double ambulo__contact_frame_along(const ambulo__contact_frame *frame, const double direction[3],
                                   const double point[3]);
/* Under a foot: 1 for a normal of zeros, and up to 60 degrees from up. */
int ambulo__contact_normal_is_legal(const double normal[3]);
/* 1 where the contact's surface is the level ground plane and its heading straight ahead. */
int ambulo__contact_is_level(const ambulo_contact *contact);
/* 1 if both hold the foot to the same foothold. */
int ambulo__contacts_same_place(const ambulo_contact *one, const ambulo_contact *other);
/* 1 if all contacts of feet are: what stands on one zero-moment point needs that. */
int ambulo__contacts_are_level(const ambulo_problem_definition *definition);

/* the flat foot on the ground.
 *
 * Taken from the model's points at q = 0, relative to the heel centre, in the ground
 * plane, and turned so that the toe centre lies straight ahead: m, [along forward,
 * along left]. */

enum { AMBULO__FOOT_CORNERS = 4 };

typedef struct ambulo__foot_outline {
  double length;                   /* heel centre to toe centre, m */
  double back, tip;                /* where the sole ends, from the heel centre: back <= 0, m */
  double half_width;               /* from the middle to the corner that is nearest to it, m */
  int moves_sideways;              /* 0: a planar foot, which has no lateral rows */
  int is_point;                    /* a point foot: one corner, of no length, turned as it likes */
  int count;                       /* corners: 1 (point), 2 (planar foot) or 4 */
  int point[AMBULO__FOOT_CORNERS]; /* the model's point of each corner */
  int is_heel[AMBULO__FOOT_CORNERS];     /* heel corner, else toe corner */
  double place[AMBULO__FOOT_CORNERS][2]; /* relative to the heel centre, m */
  int has_arcs;
  int arc[2];                     /* the model's points: centres of the arcs of heel and forefoot */
  double arc_ahead[2], radius[2]; /* along forward from the heel centre, above it: m */
  double touch[2];                /* where heel and ball touch, along forward: m */
} ambulo__foot_outline;

ambulo__foot_outline ambulo__foot_outline_of(const ambulo_model *model, int foot);
/* Of all feet, [foot_count]; NULL without memory. Free with ambulo__free. */
ambulo__foot_outline *ambulo__foot_outlines(const ambulo_model *model,
                                            const ambulo_allocator *allocator);

/* Heel centre to the most forward point of the flat foot, its tip if it has one, m. */
double ambulo__foot_reach(const ambulo_model *model, int foot);

/* Whether a corner touches the ground in a mode. */
int ambulo__corner_in_contact(ambulo_contact_mode mode, int is_heel);

/* The point that a contact holds in place, and where: the heel centre on the foothold,
 * or (in toe contact) the toe centre where the flat foot has it, the middle of a patch on its
 * place; world axes, m. `outline`: of the contact's foot; not read for a patch. Returns the point.
 */
int ambulo__contact_point(const ambulo_problem_definition *definition,
                          const ambulo__foot_outline *outline, const ambulo_contact *contact,
                          double place[3]);

/* Distance of heel and toe centre at q = 0, m. */
double ambulo__foot_length(const ambulo_model *model, int foot);

/* how long a foot or a patch is down without interruption, and beside
 * which others.
 */

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

/* input of the law that shares the load among contacts.
 *
 * A slot is a link that contacts act on: of each foot the link of its heel and, behind a joint of
 * the toes, that of its toe centre; of each patch in contact its own. At most one contact of a slot
 * is down at a time. */

enum { AMBULO__MOST_SLOTS = 6 };

/* How far ahead of the ball the centre under the toes is, m of a body of 1.75 m. */
#define AMBULO__BEYOND_BALL 0.02
/* m: half the region in which a point foot presses. A ball of rubber rolls by its radius times the
 * angle of its leg: 16 mm by a third of a radian. */
#define AMBULO__POINT_REGION 0.005
/* Of the time that a foot is flat: the least over which that centre comes there, and goes on. */
#define AMBULO__SHORTEST_GLIDE (1.0 / 16.0)

typedef struct ambulo__slots {
  int count;
  int effector[AMBULO__MOST_SLOTS]; /* whose (contact/contacts.h); slot f < foot_count is foot f's
                                     */
  int link[AMBULO__MOST_SLOTS];
  int part[AMBULO__MOST_SLOTS]; /* an ambulo__slot_part */
  int all_points;               /* 1: all of point feet, which share one moment */
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

/* Where pressure may be, as the problem gives it, or of the sole: 1: given. box: from the heel; of
 * the flat foot its front from the ball; of the toes from the ball: m. The other: to either side.
 */
int ambulo__pressure_box(const ambulo_problem_definition *definition,
                         const ambulo__foot_outline *outline, ambulo_contact_mode mode,
                         double box[2]);
double ambulo__pressure_side(const ambulo_problem_definition *definition,
                             const ambulo__foot_outline *outline);

/* `contact` NULL: that which is active at `time`; else that contact, at one of its ends.
 * `outlines`: of the model's feet. */
ambulo__contact_load ambulo__contact_load_at(const ambulo_problem_definition *definition,
                                             const ambulo__foot_outline *outlines,
                                             const ambulo__slots *slots, int slot,
                                             const ambulo_contact *contact, double time);

#endif
