/* face_bin_plain for most clusters, in assembly: face_thumb.c, face_thumb1.c. */
#ifndef TUILE_FRAME_FACE_THUMB_H
#define TUILE_FRAME_FACE_THUMB_H

#include "face.h"

/* Records for count >= 1 triangles of a cluster that face_bin_plain has found to be plain. False: it is none for the assembly, and
 * nothing was done. ASSEMBLY_FACES only. */
bool face_thumb(tuile_t *t, const frame_cluster_t *cluster, unsigned count);

/* face_thumb, of loops over one kind of cluster each: constants wherever this is called. */
typedef void (*face_loop_t)(tuile_t *t, const frame_cluster_t *cluster, unsigned count);
TUILE_INLINE bool face_thumb_by(tuile_t *t, const frame_cluster_t *cluster, unsigned count, face_loop_t flat, face_loop_t smooth,
                                face_loop_t surface) {
    if (t->config.method != TUILE_ZBUFFER) { return false; }
    if (cluster->face_normals) {
        if (t->record_bytes != sizeof(record_t) || t->transform.light_count > 1 || t->transform.two_sided) { return false; }
        flat(t, cluster, count);
    } else if (t->record_bytes == sizeof(record_t)) {
        smooth(t, cluster, count);
    } else if (t->numbers != NULL) {
        surface(t, cluster, count);
    } else {
        return false;
    }
    return true;
}

#endif
