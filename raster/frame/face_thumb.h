/* face_bin_plain for most clusters, in assembly: face_thumb.c, face_thumb1.c. */
#ifndef TUILE_FRAME_FACE_THUMB_H
#define TUILE_FRAME_FACE_THUMB_H

#include "face.h"

/* Records for count >= 1 triangles of a cluster that face_bin_plain has found to be plain. False: it is none for the assembly, and
 * nothing was done. ASSEMBLY_FACES only. */
bool face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count);

#endif
