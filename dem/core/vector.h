#pragma once

#include "dem/core/simd.h"

namespace dem
{
  /** n components of a number type (double or Pack); kept free of storage order and of expression templates for the kernel. */
  template <typename T, int n>
  struct Vec
  {
    T c[n];

    T       &operator[](const int i) { return c[i]; }
    const T &operator[](const int i) const { return c[i]; }
  };

  template <typename T, int n>
  BRECCIA_KERNEL Vec<T, n> operator+(Vec<T, n> a, const Vec<T, n> &b)
  {
    for (int i = 0; i < n; ++i)
      a.c[i] = a.c[i] + b.c[i];
    return a;
  }

  template <typename T, int n>
  BRECCIA_KERNEL Vec<T, n> operator-(Vec<T, n> a, const Vec<T, n> &b)
  {
    for (int i = 0; i < n; ++i)
      a.c[i] = a.c[i] - b.c[i];
    return a;
  }

  template <typename T, int n>
  BRECCIA_KERNEL Vec<T, n> operator*(const T &s, Vec<T, n> a)
  {
    for (int i = 0; i < n; ++i)
      a.c[i] = s * a.c[i];
    return a;
  }

  /** s a + b, each component rounded once. */
  template <typename T, int n>
  BRECCIA_KERNEL Vec<T, n> multiply_add(const T &s, Vec<T, n> a, const Vec<T, n> &b)
  {
    for (int i = 0; i < n; ++i)
      a.c[i] = multiply_add(s, a.c[i], b.c[i]);
    return a;
  }

  /** b - s a, each component rounded once. */
  template <typename T, int n>
  BRECCIA_KERNEL Vec<T, n> negative_multiply_add(const T &s, Vec<T, n> a, const Vec<T, n> &b)
  {
    for (int i = 0; i < n; ++i)
      a.c[i] = negative_multiply_add(s, a.c[i], b.c[i]);
    return a;
  }

  template <typename T, int n>
  BRECCIA_KERNEL T dot(const Vec<T, n> &a, const Vec<T, n> &b)
  {
    T sum = a.c[0] * b.c[0];
    for (int i = 1; i < n; ++i)
      sum = multiply_add(a.c[i], b.c[i], sum);
    return sum;
  }

  template <typename T>
  BRECCIA_KERNEL Vec<T, 3> cross(const Vec<T, 3> &a, const Vec<T, 3> &b)
  {
    const auto component = [&](const int i, const int j) { return multiply_subtract(a.c[i], b.c[j], a.c[j] * b.c[i]); };
    return {{component(1, 2), component(2, 0), component(0, 1)}};
  }
} // namespace dem
