/* exchange/formats.h - one reader for each format: from the root element to a tree.
 *
 * Faults are recorded in tree->xml, and reading goes on where it can. */
#ifndef AMBULO_EXCHANGE_FORMATS_H
#define AMBULO_EXCHANGE_FORMATS_H

#include "base/text_buffer.h"
#include "exchange/body_tree.h"

void ambulo__read_urdf(ambulo__tree *tree, const ambulo__xml_node *root);
void ambulo__read_osim(ambulo__tree *tree, const ambulo__xml_node *root);
/* `path`: of the file, in whose folder included ones are looked for. */
void ambulo__read_mjcf(ambulo__tree *tree, ambulo__xml_node *root, const char *path);

/* Heels and toes by options and from solids (foot_points.c). */
void ambulo__find_feet(ambulo__tree *tree);
/* Defaults within their ranges, the feet on the ground (start_pose.c). */
void ambulo__find_start(ambulo__tree *tree);
/* Partners of coordinates, left for right (mirror_pairs.c). */
void ambulo__find_mirrors(ambulo__tree *tree);
/* The model file as text (tree_yaml.c). `source`: name of the file it came from. */
void ambulo__tree_print(const ambulo__tree *tree, const char *source, ambulo__text_buffer *text);

#endif
