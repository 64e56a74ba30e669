/* show/approach_json.c - see approach_json.h. */
#include "show/approach_json.h"

#include "people/stride_measures.h"

enum { PER_INTERVAL = 10 };

ambulo_status ambulo__approach_json(ambulo__json *json, const ambulo_problem *problem,
                                    const ambulo_result *result) {
  const ambulo_allocator *a = &json->text->allocator;
  ambulo__approach *list = NULL;
  int count = 0, samples = PER_INTERVAL * (problem->nodes - 1) + 1;
  if (ambulo_problem_pairs(problem, 0, NULL) == 0 && ambulo_problem_obstacle_count(problem) == 0)
    return AMBULO_OK;
  ambulo_status status =
      ambulo__approaches(problem, ambulo_result_x(result), samples, a, &list, &count);
  if (status) return status;
  ambulo__json_open(json, "approaches", '[');
  for (int i = 0; i < count; i++) {
    ambulo__json_open(json, NULL, '{');
    ambulo__json_text(json, "capsule", list[i].capsule);
    ambulo__json_text(json, list[i].is_obstacle ? "obstacle" : "other", list[i].other);
    ambulo__json_number(json, "gap", list[i].gap);
    ambulo__json_number(json, "time", list[i].time);
    ambulo__json_close(json, '}');
  }
  ambulo__json_close(json, ']');
  ambulo__free(a, list);
  return AMBULO_OK;
}
