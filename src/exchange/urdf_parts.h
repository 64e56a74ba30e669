/* exchange/urdf_parts.h - a joint and a link of a URDF (urdf.c walks over them). */
#ifndef AMBULO_EXCHANGE_URDF_PARTS_H
#define AMBULO_EXCHANGE_URDF_PARTS_H

#include "exchange/body_tree.h"

/* name=..., "" without */
const char *ambulo__urdf_name(const ambulo__xml_node *node);
/* Appends a joint and its child; the child's link in the tree, or -1. */
int ambulo__urdf_joint(ambulo__tree *tree, int parent, const ambulo__xml_node *joint,
                       const char *child);
/* Body and solids of a link. */
void ambulo__urdf_link(ambulo__tree *tree, int link, const ambulo__xml_node *node);
/* Names what else the file has and the model has not. */
void ambulo__urdf_leftovers(ambulo__tree *tree, const ambulo__xml_node *root);

#endif
