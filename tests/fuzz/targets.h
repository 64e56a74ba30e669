/* tests/fuzz/targets.h - one for every reader of files. */
#ifndef AMBULO_TESTS_FUZZ_TARGETS_H
#define AMBULO_TESTS_FUZZ_TARGETS_H

#include "folders.h"
#include "foreign.h"

static const fuzz_target fuzz_targets[] = {
    {"model", NULL, fuzz_model},
    {"round", NULL, fuzz_round},
    {"problem", fuzz_open_rod, fuzz_problem},
    {"override", fuzz_open_rod, fuzz_override},
    {"reference", fuzz_open_rod, fuzz_reference},
    {"solution", fuzz_open_solution, fuzz_solution},
    {"sweep", fuzz_open_rod, fuzz_sweep},
    {"fit", fuzz_open_fit, fuzz_fit},
    {"import", NULL, fuzz_import},
    {"mesh", NULL, fuzz_mesh},
    {"loads", fuzz_open_body, fuzz_loads},
    {"motion", fuzz_open_body, fuzz_motion},
    {"export", fuzz_open_body, fuzz_export},
    {"page", fuzz_open_page, fuzz_page},
    {"compare", fuzz_open_compare, fuzz_compare},
    {"batch", fuzz_open_batch, fuzz_batch},
};
enum { FUZZ_TARGETS = sizeof fuzz_targets / sizeof *fuzz_targets };

static void fuzz_run(const fuzz_target *target, const uint8_t *data, size_t size) {
  target->run(size ? data[0] : 0, (const char *)data + (size > 0), size - (size > 0));
}

#endif
