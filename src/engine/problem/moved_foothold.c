/* problem/moved_foothold.c - a problem that is built, with another place of a foothold.
 *
 * Where a foot stands is in the constants of rows, in directions where the foot turns, and in what
 * the kernels know of the ground. These are made anew; grid, basis, plan, names and the order of
 * the rows stay, so that whoever points to the problem goes on with it. Heights stay: steps have
 * edges, which are events of the grid.
 */
#include "base/arithmetic.h"
#include "contact/row_families.h"
#include "contact/schedule.h"
#include "problem/nlp.h"

/* 1 if the contact stands on the foothold of `own`, without leaving it in between */
static int is_of_stance(const ambulo_problem_definition *d, const ambulo_contact *own,
                        ambulo__span stance, const ambulo_contact *other) {
  return ambulo__effector_of(d->model, own) == ambulo__effector_of(d->model, other) &&
         ambulo__contacts_same_place(own, other) && other->from >= stance.from - AMBULO__INSTANT &&
         other->to <= stance.to + AMBULO__INSTANT;
}

/* exchanges the foothold with that of *moved */
static void exchange_place(ambulo_problem *p, ambulo__moved *moved) {
  const ambulo_problem_definition *d = &p->definition;
  ambulo_contact *contacts = (ambulo_contact *)d->contacts; /* the problem's own */
  ambulo_contact old = contacts[moved->contact];
  ambulo__span span = {old.from, old.to, -1, -1};
  span = ambulo__uninterrupted(d, ambulo__effector_of(d->model, &old), AMBULO__ANY_MODE, span);
  for (int c = 0; c < d->contact_count; c++) {
    if (!is_of_stance(d, &old, span, &contacts[c])) continue;
    contacts[c].place[0] = moved->place[0];
    contacts[c].place[1] = moved->place[1];
    contacts[c].heading = moved->heading;
  }
  moved->place[0] = old.place[0];
  moved->place[1] = old.place[1];
  moved->heading = old.heading;
}

void ambulo__problem_swap_moved(ambulo_problem *p, ambulo__moved *moved) {
  ambulo__moved kept = *moved;
  moved->table = p->table;
  moved->row_runs = p->row_runs;
  moved->ground = p->ground;
  p->table = kept.table;
  p->row_runs = kept.row_runs;
  p->ground = kept.ground;
  exchange_place(p, moved);
}

void ambulo__moved_free(const ambulo_problem *p, ambulo__moved *moved) {
  ambulo__row_table_clear(&moved->table);
  ambulo__row_runs_free(&p->allocator, &moved->row_runs);
  ambulo__free_aligned(&p->allocator, moved->ground);
}

static int same_rows(const ambulo__row_table *a, const ambulo__row_table *b) {
  if (a->row_count != b->row_count) return 0;
  for (int r = 0; r < a->row_count; r++) {
    const ambulo__table_row *one = &a->rows[r], *other = &b->rows[r];
    if (!ambulo__rows_alike(one, other) || one->node != other->node ||
        one->relation != other->relation || (one->user < 0) != (other->user < 0))
      return 0;
  }
  return 1;
}

int ambulo__moved_is_alike(const ambulo_problem *p, const ambulo__moved *moved) {
  const ambulo__row_table *a = &p->table, *b = &moved->table;
  if (a->term_count != b->term_count) return 0;
  for (int t = 0; t < a->term_count; t++)
    if (a->terms[t].node != b->terms[t].node || a->terms[t].channel != b->terms[t].channel)
      return 0;
  return 1;
}

static ambulo_status build_moved(ambulo_problem *p) {
  ambulo_status status =
      ambulo__schedule_check_reach(&p->definition, p->times, p->nodes, p->active, NULL);
  if (!status) status = ambulo__ground_fill(p, &p->allocator, p->times, p->nodes, &p->ground);
  return status ? status : ambulo__problem_build_rows(p, NULL);
}

ambulo_status ambulo__problem_move_foothold(ambulo_problem *p, int contact, const double place[2],
                                            double heading, ambulo__moved *moved) {
  const ambulo_problem_definition *d = &p->definition;
  int rows = p->rows, equalities = p->equalities;
  if (contact < 0 || contact >= d->contact_count || d->ends != AMBULO_ENDS_FREE)
    return AMBULO_E_ARGUMENT;
  *moved = (ambulo__moved){.contact = contact, .place = {place[0], place[1]}, .heading = heading};
  ambulo__row_table_init(&moved->table, &p->allocator);
  ambulo__problem_swap_moved(p, moved);
  ambulo_status status = build_moved(p);
  if (!status && !same_rows(&p->table, &moved->table)) status = AMBULO_E_PROBLEM;
  if (!status) return AMBULO_OK;
  ambulo__problem_swap_moved(p, moved);
  ambulo__moved_free(p, moved);
  p->rows = rows;
  p->equalities = equalities;
  return status;
}
