/* exchange/foot_solids.h - where the solids of a link would touch the ground at q = 0. */
#ifndef AMBULO_EXCHANGE_FOOT_SOLIDS_H
#define AMBULO_EXCHANGE_FOOT_SOLIDS_H

#include "exchange/body_tree.h"

typedef struct ambulo__sole {
  double along[2], across[2], height; /* m, along forward, left and up of the world */
  int solids, meshes;                 /* how many were read, and were not */
} ambulo__sole;

/* 'l', 'r' or 0: what the name of a link says; of lfoot only if there is an rfoot. */
char ambulo__side_of_link(const ambulo__tree *tree, int link);

/* The topmost link that a link is fixed to, or itself. */
int ambulo__rigid_leader(const ambulo__tree *tree, int link);
/* The sole of a link and all that is fixed to it; axes: forward, left, up. Meshes count where it
 * has no other solids. 0, with the number of meshes, if those cannot be read either. */
int ambulo__sole_of(const ambulo__tree *tree, int link, const double axes[3][3],
                    ambulo__sole *sole);
/* The link with the lowest sole, of meshes where there are none of other solids, among those whose
 * names say `side`; -1 without. */
int ambulo__lowest_link(const ambulo__tree *tree, const double axes[3][3], char side);

#endif
