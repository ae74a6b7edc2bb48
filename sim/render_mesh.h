/* Options of tuile mesh and tuile render that say how a model is compiled. */
#ifndef SIM_RENDER_MESH_H
#define SIM_RENDER_MESH_H

#include "mesh/mesh.h"
#include "options.h"

extern const char render_mesh_usage[];

/* True: the option was one of these. A value that is wrong fails the options. */
bool render_mesh_option(mesh_options_t *mesh, options_t *options, const char *argument);

/* Lines of warning, to the standard error output. */
void render_mesh_warn(const mesh_report_t *report);

#endif
