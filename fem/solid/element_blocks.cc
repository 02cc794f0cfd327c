#include "fem/solid/element_blocks.h"

#include <cmath>

namespace fem
{
  namespace
  {
    // Bytes of the processor's vectors. A wider one is no vector to the compiler, but memory: every operation would store its result.
#if defined(__AVX512F__)
    constexpr std::size_t vector_bytes = 64;
#elif defined(__AVX__)
    constexpr std::size_t vector_bytes = 32;
#else
    constexpr std::size_t vector_bytes = 16;
#endif

    /// One number of the elements of a group, or of as many of them as a vector of the processor has room for.
    template <typename Number>
    struct Group
    {
      typedef Number Wide __attribute__((vector_size(vector_bytes), may_alias));
    };
    template <typename Number>
    using Wide = typename Group<Number>::Wide;
    template <typename Number>
    constexpr std::size_t width = vector_bytes / sizeof(Number); ///< elements that are treated at once

    /// The k-th number from there on, each of which has a place for every lane.
    template <typename Number>
    inline const Wide<Number> &number_at(const Number *p, const std::size_t k)
    {
      return *reinterpret_cast<const Wide<Number> *>(p + k * ElementBlocksOf<Number>::lanes);
    }

    template <int dim, typename Number>
    inline void
    stress_isotropic(const ElementBlocksOf<Number> &e, const Wide<Number> &weight, Wide<Number> (&h)[dim][dim])
    {
      const Wide<Number> along = e.stiffness[0] * weight, cross = e.stiffness[1] * weight,
                         shear = e.stiffness[21] * weight;
      Wide<Number> volume      = h[0][0] + h[1][1];
      if constexpr (dim == 3)
        volume += h[2][2];
      for (int d = 0; d < dim; ++d)
        h[d][d] = cross * volume + (along - cross) * h[d][d];
      for (int c = 0; c < dim; ++c)
        for (int d = c + 1; d < dim; ++d)
          h[c][d] = h[d][c] = shear * (h[c][d] + h[d][c]);
    }

    constexpr int voigt_of[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

    template <int dim, typename Number>
    inline void
    stress_general(const ElementBlocksOf<Number> &e, const Wide<Number> &weight, Wide<Number> (&h)[dim][dim])
    {
      Wide<Number> stress[dim][dim];
      for (int c = 0; c < dim; ++c)
        for (int d = c; d < dim; ++d)
          {
            const Number *row = &e.stiffness[6 * voigt_of[c][d]];
            Wide<Number>  sum = row[0] * h[0][0] + row[1] * h[1][1] + row[5] * (h[0][1] + h[1][0]);
            if constexpr (dim == 3)
              sum += row[2] * h[2][2] + row[3] * (h[1][2] + h[2][1]) + row[4] * (h[0][2] + h[2][0]);
            stress[c][d] = stress[d][c] = weight * sum;
          }
      for (int c = 0; c < dim; ++c)
        for (int d = 0; d < dim; ++d)
          h[c][d] = stress[c][d];
    }

    /// Stress times weight at a point from the displacement gradient, in place: h[c][d] becomes s[c][d].
    template <int dim, typename Number>
    inline void stress_of(const ElementBlocksOf<Number> &e, const Wide<Number> &weight, Wide<Number> (&h)[dim][dim])
    {
      if (e.isotropic)
        stress_isotropic<dim>(e, weight, h);
      else
        stress_general<dim>(e, weight, h);
    }

    template <typename Number>
    inline void gather(const unsigned int *dofs, const Number *u, Wide<Number> &value)
    {
      for (std::size_t l = 0; l < width<Number>; ++l)
        value[l] = u[dofs[l]];
    }

    /// Elements of a group may share nodes: one lane after the other.
    template <typename Number>
    inline void scatter(const unsigned int *dofs, const Wide<Number> *values, const unsigned int n, Number *f)
    {
      constexpr std::size_t lanes = ElementBlocksOf<Number>::lanes;
      for (std::size_t l = 0; l < width<Number>; ++l)
        for (unsigned int i = 0; i < n; ++i)
          f[dofs[i * lanes + l]] += values[i][l];
    }

    template <int dim, unsigned int fixed_nodes, typename Number> // 0 nodes: known only at run time
    void add_by_gradients(const ElementBlocksOf<Number> &e, const Number *u, Number *f)
    {
      constexpr std::size_t  lanes = ElementBlocksOf<Number>::lanes;
      constexpr unsigned int most  = fixed_nodes > 0 ? fixed_nodes : 27;
      const unsigned int     nodes = fixed_nodes > 0 ? fixed_nodes : e.n_nodes;
      Wide<Number>           local[most * dim], force[most * dim];
      for (std::size_t group = 0; group < e.n_blocks * lanes; group += width<Number>)
        {
          const std::size_t   b = group / lanes, lane = group % lanes;
          const unsigned int *dofs = &e.dofs[b * nodes * dim * lanes + lane];
          for (unsigned int i = 0; i < nodes * dim; ++i)
            {
              gather(dofs + i * lanes, u, local[i]);
              force[i] = Wide<Number>{};
            }
          for (unsigned int q = 0; q < e.n_points; ++q)
            {
              const Number *g           = &e.gradients[(b * e.n_points + q) * nodes * dim * lanes + lane];
              Wide<Number>  h[dim][dim] = {};
              for (unsigned int a = 0; a < nodes; ++a)
                for (int c = 0; c < dim; ++c)
                  for (int d = 0; d < dim; ++d)
                    h[c][d] += local[a * dim + c] * number_at(g, a * dim + d);
              stress_of<dim>(e, number_at(&e.weights[lane], b * e.n_points + q), h);
              for (unsigned int a = 0; a < nodes; ++a)
                for (int c = 0; c < dim; ++c)
                  for (int d = 0; d < dim; ++d)
                    force[a * dim + c] += h[c][d] * number_at(g, a * dim + d);
            }
          scatter(dofs, force, nodes * dim, f);
        }
    }

    const double lower = 0.5 + 0.5 / std::sqrt(3.0); ///< share of the lower node at the lower Gauss point of a line

    /// Derivatives of the trilinear interpolation along the three axes, each at the four places of the other two coordinates.
    template <typename Number>
    inline void differentiate(const Wide<Number> (&u)[8], Wide<Number> (&g)[3][4])
    {
      const Number  p = Number(lower), m = Number(1 - lower);
      constexpr int step[3] = {1, 2, 4}, first[3] = {2, 1, 1}, second[3] = {4, 4, 2};
      for (int d = 0; d < 3; ++d)
        {
          const int          s = step[d], i = first[d], j = second[d];
          const Wide<Number> a = u[s] - u[0], b = u[s + i] - u[i], c = u[s + j] - u[j], e = u[s + i + j] - u[i + j];
          const Wide<Number> ab0 = p * a + m * b, ab1 = m * a + p * b, ce0 = p * c + m * e, ce1 = m * c + p * e;
          g[d][0] = p * ab0 + m * ce0;
          g[d][1] = p * ab1 + m * ce1;
          g[d][2] = m * ab0 + p * ce0;
          g[d][3] = m * ab1 + p * ce1;
        }
    }

    /// The transpose of differentiate().
    template <typename Number>
    inline void integrate(const Wide<Number> (&g)[3][4], Wide<Number> (&f)[8])
    {
      const Number  p = Number(lower), m = Number(1 - lower);
      constexpr int step[3] = {1, 2, 4}, first[3] = {2, 1, 1}, second[3] = {4, 4, 2};
      for (int a = 0; a < 8; ++a)
        f[a] = Wide<Number>{};
      for (int d = 0; d < 3; ++d)
        {
          const int          s = step[d], i = first[d], j = second[d];
          const Wide<Number> ab0 = p * g[d][0] + m * g[d][2], ab1 = p * g[d][1] + m * g[d][3],
                             ce0 = m * g[d][0] + p * g[d][2], ce1 = m * g[d][1] + p * g[d][3];
          const Wide<Number> a = p * ab0 + m * ab1, b = m * ab0 + p * ab1, c = p * ce0 + m * ce1, e = m * ce0 + p * ce1;
          f[s] += a, f[0] -= a;
          f[s + i] += b, f[i] -= b;
          f[s + j] += c, f[j] -= c;
          f[s + i + j] += e, f[i + j] -= e;
        }
    }

    template <bool one_jacobian, typename Number>
    void add_trilinear(const ElementBlocksOf<Number> &e, const Number *u, Number *f)
    {
      constexpr std::size_t lanes = ElementBlocksOf<Number>::lanes;
      Wide<Number>          node[3][8], g[3][3][4], t[3][3][4], force[24];
      for (std::size_t group = 0; group < e.n_blocks * lanes; group += width<Number>)
        {
          const std::size_t   b = group / lanes, lane = group % lanes;
          const unsigned int *dofs = &e.dofs[b * 24 * lanes + lane];
          for (int a = 0; a < 8; ++a)
            for (int c = 0; c < 3; ++c)
              gather(dofs + (3 * a + c) * lanes, u, node[c][a]);
          for (int c = 0; c < 3; ++c)
            {
              differentiate<Number>(node[c], g[c]);
              for (int d = 0; d < 3; ++d)
                for (int i = 0; i < 4; ++i)
                  t[c][d][i] = Wide<Number>{};
            }
#pragma GCC unroll 8
          for (int q = 0; q < 8; ++q)
            {
              const int         at[3]  = {q >> 1, (q & 1) + 2 * (q >> 2), q & 3};
              const std::size_t stored = one_jacobian ? b : b * 8 + q;
              const auto        j      = [from = &e.jacobians[stored * 9 * lanes + lane]](const int k) {
                return number_at(from, static_cast<std::size_t>(k));
              };
              Wide<Number> h[3][3];
              for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                  h[c][d] = g[c][0][at[0]] * j(d) + g[c][1][at[1]] * j(3 + d) + g[c][2][at[2]] * j(6 + d);
              stress_of<3>(e, number_at(&e.weights[lane], stored), h);
              for (int c = 0; c < 3; ++c)
                for (int d = 0; d < 3; ++d)
                  t[c][d][at[d]] += h[c][0] * j(3 * d) + h[c][1] * j(3 * d + 1) + h[c][2] * j(3 * d + 2);
            }
          for (int c = 0; c < 3; ++c)
            {
              Wide<Number> nodal[8];
              integrate<Number>(t[c], nodal);
              for (int a = 0; a < 8; ++a)
                force[3 * a + c] = nodal[a];
            }
          scatter(dofs, force, 24, f);
        }
    }

    /// Gradient of a shape function at a point in one lane.
    template <typename Number>
    std::array<Number, 3> gradient_at(const ElementBlocksOf<Number> &e,
                                      const std::size_t              b,
                                      const unsigned int             q,
                                      const unsigned int             a,
                                      const std::size_t              lane)
    {
      constexpr std::size_t lanes = ElementBlocksOf<Number>::lanes;
      std::array<Number, 3> g{};
      if (e.geometry == BlockGeometry::gradients)
        for (unsigned int d = 0; d < e.dim; ++d)
          g[d] = e.gradients[(((b * e.n_points + q) * e.n_nodes + a) * e.dim + d) * lanes + lane];
      else
        {
          const auto        unit   = unit_gradient(q, a);
          const std::size_t stored = b * e.n_stored_points() + (e.n_stored_points() == 1 ? 0 : q);
          for (int d = 0; d < 3; ++d)
            for (int i = 0; i < 3; ++i)
              g[d] += Number(unit[i]) * e.jacobians[(stored * 9 + 3 * i + d) * lanes + lane];
        }
      return g;
    }
  }

  std::array<double, 3> unit_gradient(const unsigned int point, const unsigned int node)
  {
    std::array<double, 3> gradient;
    for (unsigned int d = 0; d < 3; ++d)
      {
        gradient[d] = (node >> d & 1u) ? 1.0 : -1.0;
        for (unsigned int i = 0; i < 3; ++i)
          if (i != d)
            gradient[d] *= (node >> i & 1u) == (point >> i & 1u) ? lower : 1 - lower;
      }
    return gradient;
  }

  template <typename Number>
  void add_internal_force(const ElementBlocksOf<Number> &e, const Number *displacement, Number *force)
  {
    if (e.geometry == BlockGeometry::parallelepiped)
      add_trilinear<true>(e, displacement, force);
    else if (e.geometry == BlockGeometry::trilinear)
      add_trilinear<false>(e, displacement, force);
    else if (e.dim == 3 && e.n_nodes == 4)
      add_by_gradients<3, 4>(e, displacement, force);
    else if (e.dim == 3)
      add_by_gradients<3, 0>(e, displacement, force);
    else if (e.n_nodes == 4)
      add_by_gradients<2, 4>(e, displacement, force);
    else
      add_by_gradients<2, 0>(e, displacement, force);
  }

  template <typename Number>
  void add_diagonal(const ElementBlocksOf<Number> &e, Number *diagonal)
  {
    constexpr std::size_t lanes = ElementBlocksOf<Number>::lanes;
    for (std::size_t b = 0; b < e.n_blocks; ++b)
      for (unsigned int a = 0; a < e.n_nodes; ++a)
        for (std::size_t lane = 0; lane < lanes; ++lane)
          {
            std::array<Number, 3> sum{};
            for (unsigned int q = 0; q < e.n_points; ++q)
              {
                const auto        g      = gradient_at(e, b, q, a, lane);
                const std::size_t stored = b * e.n_stored_points() + (e.n_stored_points() == 1 ? 0 : q);
                const Number      weight = e.weights[stored * lanes + lane];
                for (unsigned int c = 0; c < e.dim; ++c)
                  for (unsigned int i = 0; i < e.dim; ++i)
                    for (unsigned int j = 0; j < e.dim; ++j)
                      sum[c] += weight * g[i] * e.stiffness[6 * voigt_of[c][i] + voigt_of[c][j]] * g[j];
              }
            for (unsigned int c = 0; c < e.dim; ++c)
              diagonal[e.dofs[((b * e.n_nodes + a) * e.dim + c) * lanes + lane]] += sum[c];
          }
  }

  template void add_internal_force(const ElementBlocksOf<double> &, const double *, double *);
  template void add_internal_force(const ElementBlocksOf<float> &, const float *, float *);
  template void add_diagonal(const ElementBlocksOf<double> &, double *);
  template void add_diagonal(const ElementBlocksOf<float> &, float *);
}
