/* What every test file begins with: cmocka and its headers, exact integers, and fewer rounds where sanitizers make them slow. */
#ifndef TESTS_SUPPORT_CHECK_H
#define TESTS_SUPPORT_CHECK_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <stdbool.h>

__extension__ typedef __int128 int128_t;
__extension__ typedef unsigned __int128 uint128_t;

#if defined(__SANITIZE_ADDRESS__)
#define CHECK_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(undefined_behavior_sanitizer)
#define CHECK_SANITIZED 1
#endif
#endif
#ifndef CHECK_SANITIZED
#define CHECK_SANITIZED 0
#endif

/* Rounds of a loop: all of them, or one in sixteen under sanitizers. */
#define CHECK_ROUNDS(n) (CHECK_SANITIZED ? ((n) + 15) / 16 : (n))

#define CHECK_COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* Runs the function in a process of its own. True when it came back: no signal, no sanitizer's report. */
bool check_survives(void (*function)(void));

#endif
