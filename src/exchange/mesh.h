/* exchange/mesh.h - vertices of meshes in files: STL, both kinds, and OBJ. */
#ifndef AMBULO_EXCHANGE_MESH_H
#define AMBULO_EXCHANGE_MESH_H

#include "exchange/arena.h"

/* What a geometry says of its mesh; read when it is asked for (a robot has many, and feet few). */
typedef struct ambulo__mesh {
  const char *model; /* file that names it */
  const char *file;  /* as named there: a path, package://PACKAGE/PATH, model:// or file:// */
  double scale[3];
  int tried;
  double *points; /* [count][3], scaled; NULL: not read, or nothing to read */
  int count;
} ambulo__mesh;

/* Of the arena; NULL without memory, or where `file` is NULL or empty. */
ambulo__mesh *ambulo__mesh_named(ambulo__arena *arena, const char *model, const char *file);
/* Fills points once: from the file beside the model; of a package from the folders above it, too.
 * A file that is not there, or of another kind, leaves none. */
void ambulo__mesh_read(ambulo__arena *arena, ambulo__mesh *mesh);

#endif
