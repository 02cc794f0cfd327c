#pragma once

/**
 * The kernel is one long straight line of arithmetic on registers; left to itself the compiler stops inlining half-way and passes
 * packs through memory, at half the speed. What lies on that line is marked BRECCIA_KERNEL, the rare branches off it
 * BRECCIA_RARE.
 */
#define BRECCIA_KERNEL [[gnu::always_inline]] inline
#define BRECCIA_RARE [[gnu::noinline, gnu::cold]]
