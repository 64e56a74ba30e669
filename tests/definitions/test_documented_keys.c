/* Every key of the tables of members stands in docs/problem-format.md, in a row whose words, range
 * and default are those of the table. */
#include "problem/members.h"
#include "support/test.h"

enum { MOST_LINES = 1000, LINE = 4000 };

static char lines[MOST_LINES][LINE];
static int line_count;

/* rows of tables, with '-' for the minus sign of print */
static void read_page(void) {
  FILE *page = fopen("docs/problem-format.md", "r");
  assert_non_null(page);
  while (line_count < MOST_LINES && fgets(lines[line_count], LINE, page)) {
    char *line = lines[line_count], *minus;
    while ((minus = strstr(line, "\xe2\x88\x92"))) {
      *minus = '-';
      memmove(minus + 1, minus + 3, strlen(minus + 3) + 1);
    }
    line_count += strncmp(line, "| `", 3) == 0;
  }
  fclose(page);
}

static int names(const char *line, const char *key) {
  char marked[80];
  (void)snprintf(marked, sizeof marked, "`%s`", key);
  const char *found = strstr(line, marked), *end = strchr(line + 2, '|');
  return found && end && found < end;
}

/* "0 to 1" */
static int has_span(const char *line) {
  for (const char *to = strstr(line, " to "); to; to = strstr(to + 1, " to "))
    if (to[-1] >= '0' && to[-1] <= '9' && to[4] >= '0' && to[4] <= '9') return 1;
  return 0;
}

static int is_digit(char c) {
  return c >= '0' && c <= '9';
}

static int has_number(const char *line, double value) {
  for (const char *at = line + 1; *at; at++) {
    if (!is_digit(*at) || is_digit(at[-1]) || at[-1] == '.') continue;
    char *end;
    if (strtod(at[-1] == '-' ? at - 1 : at, &end) == value || strtod(at, &end) == value) return 1;
    at = end - 1;
  }
  return 0;
}

/* NULL: the row says what the table does */
static const char *differs(const char *line, const ambulo__member *m) {
  char span[80], short_span[80];
  (void)snprintf(span, sizeof span, "%.10g to %.10g", m->low, m->high);
  (void)snprintf(short_span, sizeof short_span, "%g to %g", m->low, m->high);
  for (char *zero = strstr(short_span, "e-0"); zero; zero = strstr(short_span, "e-0"))
    memmove(zero + 2, zero + 3, strlen(zero + 2));
  for (char *plus = strstr(short_span, "e+0"); plus; plus = strstr(short_span, "e+0"))
    memmove(plus + 1, plus + 3, strlen(plus + 2));
  int is_number = m->type == AMBULO__NUMBER || m->type == AMBULO__INTEGER;
  int has_range = is_number && m->count == 1 && m->low < m->high;
  if (has_range && has_span(line) && !strstr(line, span) && !strstr(line, short_span) &&
      !(strstr(span, "0 to") == span && m->type == AMBULO__INTEGER))
    return "range";
  for (int k = 0; m->type == AMBULO__CHOICE && k < m->word_count; k++)
    if (m->words[k][0] && !strstr(line, m->words[k])) return "words";
  for (int k = 0; is_number && k < m->count && k < 2; k++)
    if (isfinite(m->usual[k]) && m->usual[k] != 0.0 && !(m->flags & AMBULO__REQUIRED) &&
        !m->of_kinds && !has_number(line, m->usual[k]))
      return "default";
  return NULL;
}

static void check(const ambulo__member *m, int *faults) {
  const char *point = strrchr(m->key, '.'), *key = point ? point + 1 : m->key;
  const char *fault = "row";
  for (int i = 0; i < line_count && fault; i++)
    if (names(lines[i], key)) fault = differs(lines[i], m);
  if (fault) print_error("docs/problem-format.md: no row of '%s' has its %s\n", m->key, fault);
  *faults += fault != NULL;
}

static void the_page_says_what_the_tables_do(void **state) {
  (void)state;
  static const ambulo__structure *const structures[] = {
      &ambulo__definition_members, &ambulo__clearance_members, &ambulo__ground_reaction_members,
      &ambulo__collision_members,  &ambulo__contact_members,   &ambulo__tube_members,
      &ambulo__obstacle_members,   &ambulo__reach_members,     &ambulo__device_members,
      &ambulo__hold_members,       &ambulo__term_members,      &ambulo__options_members};
  int faults = 0;
  read_page();
  for (size_t i = 0; i < sizeof structures / sizeof *structures; i++)
    for (int k = 0; k < structures[i]->count; k++)
      if (structures[i]->members[k].key && strncmp(structures[i]->members[k].key, "engaged", 7))
        check(&structures[i]->members[k], &faults);
  assert_int_equal(faults, 0);
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(the_page_says_what_the_tables_do)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
