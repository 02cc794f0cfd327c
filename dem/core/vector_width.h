#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#elif defined(__aarch64__)
#include <arm_neon.h>
#endif

/** Bytes of the vectors that packs are made of: 64 (AVX-512), 32 (AVX) or 16 (SSE2, NEON). */
#ifndef BRECCIA_VECTOR
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#define BRECCIA_VECTOR 64
#elif defined(__AVX__)
#define BRECCIA_VECTOR 32
#else
#define BRECCIA_VECTOR 16
#endif
#endif
#if BRECCIA_VECTOR != 64 && BRECCIA_VECTOR != 32 && BRECCIA_VECTOR != 16
#error "BRECCIA_VECTOR is 64, 32 or 16 bytes"
#elif BRECCIA_VECTOR == 64 && !(defined(__AVX512F__) && defined(__AVX512DQ__))
#error "BRECCIA_VECTOR=64 needs AVX-512 F and DQ"
#elif BRECCIA_VECTOR == 32 && !defined(__AVX__)
#error "BRECCIA_VECTOR=32 needs AVX"
#endif
#define BRECCIA_JOIN_WORDS(a, b) a##b
#define BRECCIA_JOIN(a, b) BRECCIA_JOIN_WORDS(a, b)

namespace dem
{
  constexpr int vector_bytes = BRECCIA_VECTOR;
} // namespace dem

/** Code of different widths in one program are different functions: what depends on the width stands in an inline namespace of it. */
#define BRECCIA_VECTORS BRECCIA_JOIN(vectors_of_, BRECCIA_VECTOR)
