/* One folder under /tmp for the files of a test program. */
#ifndef TESTS_SUPPORT_FOLDER_H
#define TESTS_SUPPORT_FOLDER_H

#include <stdbool.h>
#include <stddef.h>

/* Make and remove the folder with the files in it: the set-up and tear-down of a group of tests. */
int folder_make(void **state);
int folder_remove(void **state);

/* The folder's own path. */
const char *folder_name(void);

/* How many files there are; with remove_them they are deleted, empty folders too. */
size_t folder_files(bool remove_them);

/* The path of a file in the folder, valid until the next call. */
const char *folder_path(const char *name);

/* Write a file in the folder and return its path, as folder_path does. */
const char *folder_put_bytes(const char *name, const void *bytes, size_t size_bytes);
const char *folder_put_text(const char *name, const char *text);

#endif
