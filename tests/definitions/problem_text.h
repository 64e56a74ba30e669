/* tests/definitions/problem_text.h - problems from text, against the models that are shipped. */
#ifndef AMBULO_TESTS_PROBLEM_TEXT_H
#define AMBULO_TESTS_PROBLEM_TEXT_H

#include "problem/nlp.h"
#include "ambulo/tools/load.h"
#include "support/messages.h"

/* Three lines that every problem of these tests begins with; line 4 is the test's own. */
#define WALKER "ambulo: 1\nkind: problem\nmodel: walker_2d.yaml\n"
#define PENDULUM "ambulo: 1\nkind: problem\nmodel: pendulum.yaml\n"

static inline ambulo_status load_text(const char *text, ambulo_diagnostics *list,
                                      ambulo_problem **problem) {
  *problem = NULL;
  return ambulo_problem_load_text(&(ambulo_problem_text){.size = sizeof(ambulo_problem_text),
                                                         .text = text,
                                                         .length = strlen(text),
                                                         .name = "p.yaml",
                                                         .directory = "models"},
                                  NULL, list, problem);
}

/* a problem that must load; prints what it says otherwise */
static inline ambulo_problem *problem_of(const char *text) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  ambulo_status status = load_text(text, list, &problem);
  for (size_t i = 0; status && i < ambulo_diagnostics_count(list); i++) {
    char line[1024];
    ambulo_diagnostics_format(list, i, line, sizeof line);
    print_error("%s\n", line);
  }
  ambulo_diagnostics_free(list);
  assert_int_equal(status, AMBULO_OK);
  assert_non_null(problem);
  return problem;
}

/* a problem that must be refused with a first message that contains `message` */
static inline void expect_refusal(const char *text, ambulo_status expected, const char *message) {
  ambulo_diagnostics *list = ambulo_diagnostics_create(NULL);
  ambulo_problem *problem = NULL;
  ambulo_status status = load_text(text, list, &problem);
  if (ambulo_diagnostics_count(list) == 0) print_error("no message; expected %s\n", message);
  assert_message(list, 0, message);
  assert_int_equal(status, expected);
  assert_null(problem);
  ambulo_diagnostics_free(list);
}

#endif
