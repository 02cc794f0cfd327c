#pragma once

/**
 * The kernel is one long straight line of arithmetic on registers; left to itself the compiler stops inlining half-way and passes
 * packs through memory, at half the speed. What lies on that line is marked BRECCIA_KERNEL; branches off it are kept out of it:
 * BRECCIA_BRANCH where some links go at some steps, BRECCIA_RARE where hardly any link ever goes.
 */
#define BRECCIA_KERNEL [[gnu::always_inline]] inline
#define BRECCIA_BRANCH [[gnu::noinline]]
#define BRECCIA_RARE [[gnu::noinline, gnu::cold]]
