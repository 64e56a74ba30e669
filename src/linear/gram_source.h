/* linear/gram_source.h - the part of band_source.h on Gram matrices: A += G'G, tile by tile of A's
 * lower triangle. Included by it alone.
 *
 * Gradients are zero on the limbs that they do not concern, in half of all places of a whole body.
 * A bit says whether a row has anything in a panel of 8 columns, and a tile takes the rows that
 * have something in both of its panels: of 45 coordinates 0.5 to 0.6 of all. They are looked up
 * once for each panel, as many rows and panels at a time as have room on the stack.
 */

enum { BITS = 64, WORDS = 2, PANELS = 32 };

typedef struct gram {
  int count; /* rows, at most BITS * WORDS */
  size_t stride;
  const double *g;
  uint64_t use[PANELS][WORDS];     /* of the panels that are A's rows */
  const double *row[BITS * WORDS]; /* at the columns of a tile */
} gram;

/* bit k: row k is not zero in a panel, or not a number */
static void find_rows(const gram *m, int panel, uint64_t use[WORDS]) {
  for (int w = 0; w < WORDS; w++) {
    const double *row = m->g + (size_t)(w * BITS) * m->stride + (size_t)(panel * T);
    lanes bits[V] = {{0}}, bit = (lanes){0} + 1;
    int left = m->count - w * BITS, end = left < BITS ? left : BITS;
    for (int k = 0; k < end; k++, bit += bit, row += m->stride) {
      for (int v = 0; v < V; v++) bits[v] |= (lanes)(load(row + v * W) != (wide){0}) & bit;
    }
    use[w] = 0;
    for (int i = 0; i < T; i++) use[w] |= (uint64_t)bits[i / W][i % W];
  }
}

/* sums of a tile, `ahead` from its columns to its rows */
static inline void sum_tile(const gram *m, const uint64_t use[WORDS], const uint64_t own[WORDS],
                            int ahead, wide sums[V][COLUMNS]) {
  for (int v = 0; v < V; v++) {
    for (int c = 0; c < COLUMNS; c++) sums[v][c] = (wide){0};
  }
  for (int w = 0; w < WORDS; w++) {
    for (uint64_t both = use[w] & own[w]; both; both &= both - 1) {
      const double *row = m->row[w * BITS + __builtin_ctzll(both)];
      add_products(1, 1, row + ahead, 0, row, 0, sums);
    }
  }
}

/* COLUMNS columns of A from `column` on, `there` of which are in A, on the panels [from, end) */
static void add_columns(gram *m, int column, int there, const uint64_t own[WORDS], int from,
                        int end, size_t step, double *a) {
  for (int k = 0; k < m->count; k++) m->row[k] = m->g + (size_t)k * m->stride + (size_t)column;
  for (int panel = from; panel < end; panel++) {
    wide sums[V][COLUMNS];
    sum_tile(m, m->use[panel % PANELS], own, panel * T - column, sums);
    for (int c = 0; c < there; c++) {
      double *at = a + place(panel * T, column + c, step);
      for (int v = 0; v < V; v++) {
        if (panel * T > column) {
          *(loose *)(at + v * W) += sums[v][c];
        } else { /* on the diagonal; what is above belongs to other columns */
          for (int i = 0; i < W; i++) {
            if (panel * T + v * W + i >= column + c) at[v * W + i] += sums[v][c][i];
          }
        }
      }
    }
  }
}

/* the panels [from, end) of A's rows, whose rows in use are known */
static void add_panels(gram *m, int width, int from, int end, size_t step, double *a) {
  for (int panel = 0; panel < end; panel++) {
    uint64_t other[WORDS];
    const uint64_t *own = panel < from ? other : m->use[panel % PANELS];
    if (panel < from) find_rows(m, panel, other);
    for (int column = panel * T; column < (panel + 1) * T && column < width; column += COLUMNS) {
      int left = width - column, there = left < COLUMNS ? left : COLUMNS;
      add_columns(m, column, there, own, panel < from ? from : panel, end, step, a);
    }
  }
}

static void add_gram(int count, int width, int stride, const double *g, int ld, double *a) {
  int panels = blocks_of(width);
  gram m = {.stride = (size_t)stride};
  for (int k = 0; k < count; k += BITS * WORDS) {
    m.g = g + (size_t)k * m.stride;
    m.count = count - k < BITS * WORDS ? count - k : BITS * WORDS;
    for (int from = 0; from < panels; from += PANELS) {
      int end = from + PANELS < panels ? from + PANELS : panels;
      for (int panel = from; panel < end; panel++) find_rows(&m, panel, m.use[panel % PANELS]);
      add_panels(&m, width, from, end, (size_t)ld - 1, a);
    }
  }
}
