/* show/gait_svg.c - gait.svg: title, strip, bars, time axis, curves, legend. */
#include "show/gait_svg.h"

#include "contact/contacts.h"
#include "model/neutral_pose.h"
#include "show/skeleton.h"
#include "show/svg.h"
#include "trajectory/basis.h"

#include <math.h>
#include <string.h>

enum { FEWEST_STEPS = 240, STEPS_A_PIECE = 3, MOST_STEPS = 6000 };

static const double page_width = 1200.0, margin = 40.0;

/* "3.2e-09": two digits, free of the locale */
static void append_small(ambulo__text_buffer *text, double value) {
  if (!(value > 0.0) || !isfinite(value)) {
    ambulo__text_append(text, value == 0.0 ? "0" : "not finite");
    return;
  }
  int exponent = (int)floor(log10(value));
  int digits = (int)lround(value / pow(10.0, (double)(exponent - 1)));
  if (digits >= 100) {
    digits /= 10;
    exponent++;
  }
  ambulo__text_append_format(text, "%d.%de%d", digits / 10, digits % 10, exponent);
}

static void append_rounded(ambulo__text_buffer *text, double value) {
  int exponent = value != 0.0 && isfinite(value) ? (int)floor(log10(fabs(value))) : 0;
  int decimals = 3 - exponent;
  ambulo__label_number(text, value, decimals < 0 ? 0 : decimals > 6 ? 6 : decimals);
}

static void subtitle(const ambulo_problem *problem, const ambulo_result *result,
                     ambulo__text_buffer *out) {
  const ambulo_audit *audit = ambulo_result_audit(result);
  double travel = problem->definition.travel, duration = ambulo_problem_duration(problem);
  ambulo__text_append(out, ambulo_verdict_name(ambulo_result_verdict(result)));
  ambulo__text_append(out, "   \xc2\xb7   ");
  if (ambulo_problem_ends(problem) == AMBULO_ENDS_MIRRORED)
    ambulo__text_append(out, "one step, mirrored: ");
  append_rounded(out, duration);
  ambulo__text_append(out, " s");
  if (travel != 0.0) {
    ambulo__text_append(out, ", ");
    ambulo__label_number(out, travel, 2);
    ambulo__text_append(out, " m, ");
    ambulo__label_number(out, travel / duration, 2);
    ambulo__text_append(out, " m/s");
  }
  if (ambulo_problem_term_count(problem)) {
    ambulo__text_append(out, "   \xc2\xb7   objective ");
    append_rounded(out, ambulo_result_objective(result));
  }
  ambulo__text_append(out, "   \xc2\xb7   worst violation ");
  append_small(out, audit->violation.worst);
  if (audit->violation.unit) ambulo__text_append_format(out, " %s", audit->violation.unit);
}

static void device_legend(const ambulo_problem *problem, double right, ambulo__text_buffer *text) {
  int count = ambulo_problem_device_count(problem), at_joints = 0;
  for (int i = 0; i < count; i++) at_joints |= ambulo_problem_device(problem, i)->coordinate >= 0;
  double left = right - (at_joints ? 296.0 : 120.0);
  if (count == 0) return;
  ambulo__svg_line(text, "device", left, 41.5, left + 20.0, 41.5);
  ambulo__svg_label(text, "device-text", left + 30.0, 46.0,
                    at_joints ? "device (its torque: dotted)" : "device");
}

/* underscores of a name are read as spaces */
static void heading(const ambulo_problem *problem, const ambulo_result *result, int sides,
                    ambulo__text_buffer *text) {
  const char *name = ambulo_problem_name(problem);
  ambulo__text_buffer line;
  ambulo__text_init_part(&line, text);
  for (const char *c = name ? name : "motion"; *c; c++)
    ambulo__text_append_char(&line, *c == '_' ? ' ' : *c);
  double right = page_width - margin, first = right - (sides ? 168.0 : 0.0);
  if (ambulo_problem_device_count(problem)) first -= 300.0;
  ambulo__svg_label_within(text, "title", margin, 46.0, first - margin, 22.0,
                           ambulo__text_data(&line));
  ambulo__text_clear(&line);
  subtitle(problem, result, &line);
  ambulo__svg_label(text, "subtitle", margin, 69.0, ambulo__text_data(&line));
  ambulo__text_free(&line);
  device_legend(problem, sides ? right - 168.0 : right, text);
  if (!sides) return;
  ambulo__svg_line(text, "left-mark", right - 146.0, 41.5, right - 126.0, 41.5);
  ambulo__svg_label(text, "left-text", right - 116.0, 46.0, "left");
  ambulo__svg_line(text, "right-mark", right - 70.0, 41.5, right - 50.0, 41.5);
  ambulo__svg_label(text, "right-text", right - 40.0, 46.0, "right");
}

void ambulo__people_legend(const ambulo__gait_people *people, const ambulo__panel *panel,
                           const ambulo__gait_style *style, ambulo__text_buffer *text) {
  double y = panel->y, x = panel->x + 44.0;
  for (int f = 0; f < AMBULO__PEOPLE_FILES; f++) {
    if (!people->shown[f]) continue;
    const ambulo__people_file *file = &people->people->files[f];
    int has_band = file->reference.curves[0].sd != NULL;
    ambulo__text_buffer line;
    ambulo__text_init_part(&line, text);
    if (style->percent && has_band) {
      ambulo__svg_rectangle(text, "both-people", x, y - 10.0, 44.0, 12.0);
    } else if (style->percent) {
      ambulo__svg_line(text, "trunk people", x, y - 4.0, x + 44.0, y - 4.0);
    } else if (has_band) {
      ambulo__svg_rectangle(text, "left-people", x, y - 10.0, 20.0, 12.0);
      ambulo__svg_rectangle(text, "right-people", x + 24.0, y - 10.0, 20.0, 12.0);
    } else {
      ambulo__svg_line(text, "left people", x, y - 4.0, x + 20.0, y - 4.0);
      ambulo__svg_line(text, "right people", x + 24.0, y - 4.0, x + 44.0, y - 4.0);
    }
    ambulo__text_append(&line, has_band ? "people, mean \xc2\xb1 2 SD: " : "people, mean: ");
    ambulo__text_append(&line, file->source ? file->source : file->path);
    ambulo__svg_label_within(text, "legend", x + 54.0, y, panel->width - 98.0, 12.0,
                             ambulo__text_data(&line));
    ambulo__text_free(&line);
    y += 19.0;
  }
}

static int has_sides(const ambulo_model *model) {
  for (int i = 0; i < model->coordinate_count; i++) {
    if (model->coordinates[i].mirror != i) return 1;
  }
  return 0;
}

/* picture below the heading; the height is known before anything is drawn */
typedef struct layout {
  ambulo__panel strip, bars, axis, plan, curves, forces, people;
  double height;
} layout;

static ambulo_status arrange(const ambulo__stride *stride, const double *x,
                             const ambulo__gait_style *style, int people, layout *page) {
  int lanes = 0, forces = stride->feet + stride->patches > 0;
  for (int e = 0; e < ambulo__effector_count(stride->model); e++)
    lanes += ambulo_problem_contact_count(stride->problem) && ambulo__gait_shows(stride, e);
  double left = margin + 70.0, width = page_width - 2.0 * margin - 150.0;
  ambulo__panel strip = {left, 92.0, width, 270.0, stride->duration};
  ambulo_status status = ambulo__gait_strip_height(stride->problem, x, &stride->allocator, &strip);
  page->strip = strip;
  page->bars = strip;
  page->bars.y = strip.y + strip.height + 30.0;
  page->axis = page->bars;
  page->axis.y = page->bars.y + 19.0 * (double)lanes + (lanes ? 3.0 : -12.0);
  page->plan = strip;
  page->plan.y = page->axis.y + 52.0;
  if (!status) status = ambulo__gait_plan_height(stride, &page->plan);
  double above = page->plan.height > 0.0 ? page->plan.height + 30.0 : 0.0;
  page->height = page->axis.y + 34.0 + above;
  if (style->without_curves) return status;
  double top = style->without_strip ? 120.0 : page->axis.y + 78.0 + above;
  double rows = style->powers ? 252.0 : 0.0;
  ambulo__panel curves = {margin, top, page_width - 2.0 * margin, 430.0 + rows, stride->duration};
  page->curves = curves;
  page->forces = curves;
  page->forces.y = curves.y + curves.height + 66.0;
  page->forces.height = forces ? 178.0 : 0.0;
  page->people = curves;
  page->people.y = curves.y + curves.height + 54.0 + (forces ? 244.0 : 0.0);
  page->height = page->people.y - 8.0 + (people ? 44.0 : 0.0);
  return status;
}

static ambulo_status draw_strip(const ambulo__stride *stride, const double *x, const layout *page,
                                ambulo__text_buffer *text) {
  ambulo_status status = ambulo__gait_strip(stride->problem, x, &page->strip, text);
  ambulo__gait_bars(stride, &page->bars, text);
  ambulo__time_axis(&page->axis, 9, "s", text);
  if (!status) status = ambulo__gait_plan(stride, &page->plan, text);
  return status;
}

static ambulo_status draw_curves(const ambulo__stride *stride, const ambulo__gait_style *style,
                                 ambulo__gait_people *people, const layout *page,
                                 ambulo__text_buffer *text) {
  ambulo_status status = ambulo__gait_curves(stride, &page->curves, style, people, text);
  if (!status) status = ambulo__gait_forces(stride, &page->forces, style, people, text);
  ambulo__people_legend(people, &page->people, style, text);
  return status;
}

static ambulo_status draw_page(const ambulo_result *result, const ambulo__stride *stride,
                               const ambulo__gait_style *style, ambulo__gait_people *people,
                               ambulo__text_buffer *text) {
  layout page;
  const double *x = ambulo_result_x(result);
  ambulo_status status = arrange(stride, x, style, people->people != NULL, &page);
  if (status) return status;
  const char *name = ambulo_problem_name(stride->problem);
  ambulo__svg_begin(text, page_width, page.height, style->millimetres, name ? name : "motion");
  heading(stride->problem, result, has_sides(stride->model), text);
  if (!style->without_strip) status = draw_strip(stride, x, &page, text);
  if (!status && !style->without_curves) status = draw_curves(stride, style, people, &page, text);
  ambulo__svg_end(text);
  return status ? status : ambulo__text_status(text);
}

/* Curves are smooth between the breakpoints of the spline and may have corners there: samples at
 * all of them where they are evenly spaced, and several between two. */
static int samples_of(const ambulo_problem *problem) {
  int pieces = ambulo__basis_intervals(problem->basis);
  if (ambulo_problem_ends(problem) == AMBULO_ENDS_MIRRORED) pieces *= 2;
  int steps = (FEWEST_STEPS + pieces - 1) / pieces;
  if (steps < STEPS_A_PIECE) steps = STEPS_A_PIECE;
  if (pieces * steps > MOST_STEPS) steps = 1;
  return pieces * steps + 1;
}

ambulo_status ambulo__gait_picture(const ambulo_problem *problem, const ambulo_result *result,
                                   const ambulo__people *people, const ambulo__gait_style *style,
                                   ambulo__text_buffer *text, int *shown) {
  ambulo__stride stride = {.samples = 0};
  ambulo__gait_people behind = {.people = NULL};
  ambulo_status status = ambulo__stride_create(problem, ambulo_result_x(result),
                                               samples_of(problem), &text->allocator, &stride);
  if (status) return status;
  status = ambulo__gait_people_create(&stride, people, &text->allocator, &behind);
  behind.per_kg = style->per_kg;
  if (!status) status = draw_page(result, &stride, style, &behind, text);
  for (int f = 0; shown && f < AMBULO__PEOPLE_FILES; f++) *shown += behind.shown[f];
  ambulo__gait_people_free(&behind);
  ambulo__stride_free(&stride);
  return status;
}

ambulo_status ambulo__gait_svg(const ambulo_problem *problem, const ambulo_result *result,
                               const ambulo__people *people, ambulo__text_buffer *text) {
  static const ambulo__gait_style usual = {.millimetres = 0.0};
  return ambulo__gait_picture(problem, result, people, &usual, text, NULL);
}
