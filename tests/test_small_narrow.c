/* The small triangles of machines with registers of 32 bits, and of those that neither divide nor make long products. */
#define FIXED_WIDE_REGISTERS 0
#define FIXED_BY_HALVES 1

#include "test_small.c"
