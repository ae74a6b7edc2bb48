#include "gl.h"

#include "../support/check.h"

#include <GL/osmesa.h>

/* LLVM and Mesa keep what they compiled until the process ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) { return "leak:libOSMesa\nleak:libLLVM\nleak:libgallium\n"; }

static void textures_open(const gl_scene_t *scene, GLuint *names) {
    for (size_t i = 0; i < scene->texture_count; i++) {
        const gl_texture_t *texture = &scene->textures[i];
        glGenTextures(1, &names[i]);
        glBindTexture(GL_TEXTURE_2D, names[i]);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, texture->clamp_s ? GL_CLAMP_TO_EDGE : GL_REPEAT);
        glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, texture->clamp_t ? GL_CLAMP_TO_EDGE : GL_REPEAT);
        glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_REPLACE);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, (GLsizei)texture->width, (GLsizei)texture->height, 0, GL_BGRA,
                     GL_UNSIGNED_INT_8_8_8_8_REV, texture->argb);
    }
}

/* The rows of the picture go downwards, as its y does: GL's lower left corner is the picture's upper left one, so that nothing has
 * to be turned over but the winding. */
static void state_open(const gl_scene_t *scene, uint32_t width, uint32_t height) {
    double columns[16];
    for (int i = 0; i < 4; i++) {
        for (int j = 0; j < 4; j++) {
            columns[4 * j + i] = (i == 1 ? -1 : 1) * scene->clip[i][j];
        }
    }
    glViewport(0, 0, (GLsizei)width, (GLsizei)height);
    glMatrixMode(GL_PROJECTION);
    glLoadMatrixd(columns);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS); /* of two faces equally deep the first is seen */
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CW);
    glShadeModel(GL_FLAT);
    glDisable(GL_DITHER);
    glClearColor((float)(scene->background >> 16) / 255, (float)(scene->background >> 8 & 255) / 255,
                 (float)(scene->background & 255) / 255, 1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void triangle_draw(const gl_triangle_t *triangle, const GLuint *names) {
    if (triangle->texture >= 0) {
        glEnable(GL_TEXTURE_2D);
        glBindTexture(GL_TEXTURE_2D, names[triangle->texture]);
    } else {
        glDisable(GL_TEXTURE_2D);
    }
    glColor3ub((GLubyte)(triangle->rgb >> 16), (GLubyte)(triangle->rgb >> 8), (GLubyte)triangle->rgb);
    glBegin(GL_TRIANGLES);
    for (int i = 0; i < 3; i++) {
        glTexCoord2dv(triangle->st[i]);
        glVertex3dv(triangle->position[i]);
    }
    glEnd();
}

uint32_t *gl_draw(const gl_scene_t *scene, uint32_t width, uint32_t height) {
    static const int wish[] = {OSMESA_FORMAT, OSMESA_BGRA, OSMESA_DEPTH_BITS, 32, OSMESA_PROFILE, OSMESA_COMPAT_PROFILE, 0};
    GLuint names[64] = {0};
    uint32_t *picture = calloc((size_t)width * height, sizeof *picture);
    OSMesaContext context = OSMesaCreateContextAttribs(wish, NULL);
    assert_non_null(picture);
    assert_non_null(context);
    assert_true(scene->texture_count <= CHECK_COUNT(names));
    assert_true(OSMesaMakeCurrent(context, picture, GL_UNSIGNED_BYTE, (GLsizei)width, (GLsizei)height));
    const char *renderer = (const char *)glGetString(GL_RENDERER);
    if (!renderer || !strstr(renderer, "llvmpipe")) { fail_msg("not llvmpipe but %s", renderer ? renderer : "nothing"); }
    textures_open(scene, names);
    state_open(scene, width, height);
    for (size_t i = 0; i < scene->triangle_count; i++) {
        triangle_draw(&scene->triangles[i], names);
    }
    glFinish();
    assert_int_equal(glGetError(), GL_NO_ERROR);
    glDeleteTextures((GLsizei)scene->texture_count, names);
    OSMesaDestroyContext(context);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        picture[i] &= 0xffffff;
    }
    return picture;
}
