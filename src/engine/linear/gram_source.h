/* linear/gram_source.h - the part of band_source.h on Gram matrices: A += G'G, tile by tile of A's
 * lower triangle. Included by it alone.
 *
 * Gradients are zero on the limbs that they do not concern, in half of all places of a whole body.
 * Of such rows a tile takes those that have something in both of its panels of 8 columns, which a
 * bit for each row and panel says: of 45 coordinates about half. The bits are found for as
 * many rows and panels at a time as have room on the stack.
 */

/* adds sums to `there` columns of `tiles` tiles */
ALWAYS void add_sums(int tiles, int there, wide sums[][COLUMNS], size_t step, double *tile) {
  for (int c = 0; c < there; c++) {
    for (int v = 0; v < tiles * V; v++) *(loose *)(tile + (size_t)c * step + v * W) += sums[v][c];
  }
}

/* the same from column h of a corner on; what is above the diagonal belongs to other columns */
static inline void add_corner(int h, int there, wide sums[][COLUMNS], size_t step, double *tile) {
  UNROLLED for (int c = 0; c < COLUMNS; c++) {
    if (c >= there) break;
    for (int v = 0; v < V; v++) {
      lanes below = (lanes)(counting + v * W >= (lanes){0} + (h + c));
      *(loose *)(tile + (size_t)c * step + v * W) += (wide)((lanes)sums[v][c] & below);
    }
  }
}

/* how many of COLUMNS columns from one on there are */
static inline int columns_there(int width, int column) {
  return width - column < COLUMNS ? width - column : COLUMNS;
}

/* ------------------------------------------------------------ rows without zeros */

ALWAYS void add_strip(int tiles, int count, size_t stride, const double *g, int row, int column,
                      int there, size_t step, double *a) {
  wide sums[STRIP * V][COLUMNS] = {{{0}}};
  double *tile = a + place(row, column, step);
  add_products(tiles, (size_t)count, g + row, stride, g + column, stride, sums);
  if (row / T == column / T) {
    add_corner(column % T, there, sums, step, tile);
  } else {
    add_sums(tiles, there, sums, step, tile);
  }
}

static void add_gram(int count, int width, int stride, const double *g, int ld, double *a) {
  size_t step = (size_t)ld - 1;
  for (int column = 0; column < width; column += COLUMNS) {
    int there = columns_there(width, column), row = column / T * T, end = blocks_of(width) * T;
    add_strip(1, count, (size_t)stride, g, row, column, there, step, a);
    for (row += T; row + STRIP * T <= end; row += STRIP * T)
      add_strip(STRIP, count, (size_t)stride, g, row, column, there, step, a);
    if (row < end) add_strip(1, count, (size_t)stride, g, row, column, there, step, a);
  }
}

/* --------------------------------------------------------- rows of many zeros */

enum { BITS = 64, WORDS = 2, PANELS = 32 };

typedef uint64_t marks __attribute__((vector_size(8 * AMBULO__WIDTH)));

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
    marks bits[V] = {{0}}, bit = (marks){0} + 1;
    int left = m->count - w * BITS, end = left < BITS ? left : BITS;
    for (int k = 0; k < end; k++, bit += bit, row += m->stride) {
      for (int v = 0; v < V; v++) bits[v] |= (marks)(load(row + v * W) != (wide){0}) & bit;
    }
    use[w] = 0;
    for (int i = 0; i < T; i++) use[w] |= bits[i / W][i % W];
  }
}

/* sums of a tile, `ahead` from its columns to its rows; by itself, for the registers */
static __attribute__((noinline)) void sum_tile(const gram *m, const uint64_t use[WORDS],
                                               const uint64_t own[WORDS], int ahead,
                                               wide sums[V][COLUMNS]) {
  wide sum[V][COLUMNS] = {{{0}}};
  for (int w = 0; w < WORDS; w++) {
    const double *const *rows = m->row + w * BITS;
    for (uint64_t both = use[w] & own[w]; both; both &= both - 1) {
      const double *row = rows[__builtin_ctzll(both)];
      add_products(1, 1, row + ahead, 0, row, 0, sum);
    }
  }
  for (int v = 0; v < V; v++) {
    for (int c = 0; c < COLUMNS; c++) sums[v][c] = sum[v][c];
  }
}

/* COLUMNS columns of A from `column` on, `there` of which are in A, on the panels [from, end) */
static void add_columns(gram *m, int column, int there, const uint64_t own[WORDS], int from,
                        int end, size_t step, double *a) {
  for (int k = 0; k < m->count; k++) m->row[k] = m->g + (size_t)k * m->stride + (size_t)column;
  for (int panel = from; panel < end; panel++) {
    wide sums[V][COLUMNS];
    double *tile = a + place(panel * T, column, step);
    sum_tile(m, m->use[panel % PANELS], own, panel * T - column, sums);
    if (panel == column / T) {
      add_corner(column % T, there, sums, step, tile);
    } else {
      add_sums(1, there, sums, step, tile);
    }
  }
}

/* the panels [from, end) of A's rows, whose rows in use are known */
static void add_panels(gram *m, int width, int from, int end, size_t step, double *a) {
  for (int panel = 0; panel < end; panel++) {
    uint64_t other[WORDS];
    const uint64_t *own = panel < from ? other : m->use[panel % PANELS];
    if (panel < from) find_rows(m, panel, other);
    for (int column = panel * T; column < (panel + 1) * T && column < width; column += COLUMNS)
      add_columns(m, column, columns_there(width, column), own, panel < from ? from : panel, end,
                  step, a);
  }
}

static void add_sparse_gram(int count, int width, int stride, const double *g, int ld, double *a) {
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
