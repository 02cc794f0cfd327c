#include "fem/explicit/element_blocks.h"

#include <algorithm>

namespace fem
{
  namespace
  {
    constexpr std::size_t lanes = ElementBlocks::lanes;

    /// One number of every element of a group.
    struct Lanes
    {
      double v[lanes];
    };

    template <typename F>
    inline void each(const F &f)
    {
      for (std::size_t l = 0; l < lanes; ++l)
        f(l);
    }

    /// Stress times weight at a point from the displacement gradient, in place: h[c][d] becomes s[c][d].
    template <int dim>
    inline void stress_isotropic(const ElementBlocks &e, const double *weight, Lanes (&h)[dim][dim])
    {
      const double along = e.stiffness[0], cross = e.stiffness[1], shear = e.stiffness[21];
      each([&](const std::size_t l) {
        double volume = 0;
        for (int d = 0; d < dim; ++d)
          volume += h[d][d].v[l];
        const double w = weight[l];
        for (int d = 0; d < dim; ++d)
          h[d][d].v[l] = w * (cross * volume + (along - cross) * h[d][d].v[l]);
        for (int c = 0; c < dim; ++c)
          for (int d = c + 1; d < dim; ++d)
            h[c][d].v[l] = h[d][c].v[l] = w * shear * (h[c][d].v[l] + h[d][c].v[l]);
      });
    }

    template <int dim>
    inline void stress_general(const ElementBlocks &e, const double *weight, Lanes (&h)[dim][dim])
    {
      constexpr int row[6] = {0, 1, 2, 1, 0, 0}, column[6] = {0, 1, 2, 2, 2, 1};
      each([&](const std::size_t l) {
        double strain[6] = {}, stress[6] = {};
        for (int i = 0; i < 6; ++i)
          if (column[i] < dim)
            strain[i] =
              i < 3 ? h[i < dim ? i : 0][i < dim ? i : 0].v[l] : h[row[i]][column[i]].v[l] + h[column[i]][row[i]].v[l];
        for (int i = 0; i < 6; ++i)
          for (int j = 0; j < 6; ++j)
            stress[i] += e.stiffness[6 * i + j] * strain[j];
        for (int i = 0; i < 6; ++i)
          if (column[i] < dim)
            h[row[i]][column[i]].v[l] = h[column[i]][row[i]].v[l] = weight[l] * stress[i];
      });
    }

    template <int dim, unsigned int fixed_nodes> // 0: known only at run time
    void add_forces(const ElementBlocks &e, const double *u, double *f)
    {
      constexpr unsigned int most  = 27;
      const unsigned int     nodes = fixed_nodes > 0 ? fixed_nodes : e.n_nodes;
      Lanes                  local[most * dim], force[most * dim];
      for (std::size_t b = 0; b < e.n_blocks; ++b)
        {
          const unsigned int *dofs = &e.dofs[b * nodes * dim * lanes];
          for (unsigned int i = 0; i < nodes * dim; ++i)
            each([&](const std::size_t l) {
              local[i].v[l] = u[dofs[i * lanes + l]];
              force[i].v[l] = 0;
            });
          for (unsigned int q = 0; q < e.n_points; ++q)
            {
              const double *g           = &e.gradients[(b * e.n_points + q) * nodes * dim * lanes];
              const double *weight      = &e.weights[(b * e.n_points + q) * lanes];
              Lanes         h[dim][dim] = {};
              for (unsigned int a = 0; a < nodes; ++a)
                for (int c = 0; c < dim; ++c)
                  for (int d = 0; d < dim; ++d)
                    each([&](const std::size_t l) {
                      h[c][d].v[l] += local[a * dim + c].v[l] * g[(a * dim + d) * lanes + l];
                    });
              if (e.isotropic)
                stress_isotropic<dim>(e, weight, h);
              else
                stress_general<dim>(e, weight, h);
              for (unsigned int a = 0; a < nodes; ++a)
                for (int c = 0; c < dim; ++c)
                  for (int d = 0; d < dim; ++d)
                    each([&](const std::size_t l) {
                      force[a * dim + c].v[l] += h[c][d].v[l] * g[(a * dim + d) * lanes + l];
                    });
            }
          for (std::size_t l = 0; l < lanes; ++l)
            for (unsigned int i = 0; i < nodes * dim; ++i)
              f[dofs[i * lanes + l]] += force[i].v[l];
        }
    }
  }

  void add_internal_force(const ElementBlocks &e, const double *displacement, double *force)
  {
    if (e.dim == 3 && e.n_nodes == 8)
      add_forces<3, 8>(e, displacement, force);
    else if (e.dim == 3 && e.n_nodes == 4)
      add_forces<3, 4>(e, displacement, force);
    else if (e.dim == 3)
      add_forces<3, 0>(e, displacement, force);
    else if (e.n_nodes == 4)
      add_forces<2, 4>(e, displacement, force);
    else
      add_forces<2, 0>(e, displacement, force);
  }
}
