#include "dem/peridynamics/bond_forces.h"

#include "dem/core/vector.h"

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  namespace
  {
    enum class Task
    {
      force,
      force_and_break,
      energy
    };

    /** Places of a row that are worked off for all offsets before the next: what they read and write stays in the first cache. */
    constexpr std::size_t tile = 256;

    /** What all bonds of an offset share. */
    template <int dim>
    struct Direction
    {
      Pack xi[3];
      Pack square, length, inverse_length,
        limit; ///< limit: of the difference of squared lengths, or of the stretch if linear
    };

    template <int dim, bool nonlinear>
    Direction<dim> direction_of(const Bonds &bonds, const Offset &o)
    {
      const double   spacing = bonds.grid().spacing(), l = o.length * spacing, s = bonds.critical_stretch();
      Direction<dim> d;
      for (int a = 0; a < dim; ++a)
        d.xi[a] = Pack(o.steps[static_cast<std::size_t>(a)] * spacing);
      d.square         = Pack(l * l);
      d.length         = Pack(l);
      d.inverse_length = Pack(1 / l);
      d.limit          = Pack(nonlinear ? l * l * s * (2 + s) : s);
      return d;
    }

    /** A pack of bonds: along what they pull, how far they are stretched, and the stretch over the length of that direction. */
    template <int dim, bool nonlinear>
    struct PulledBonds
    {
      Pack along[dim];
      Pack measure; ///< squared length less that at rest [m^2]; if linear the stretch
      Pack factor;  ///< of stiffness and direction: the force

      BRECCIA_KERNEL PulledBonds(const Direction<dim> &d, const Pack (&eta)[dim])
      {
        if constexpr (nonlinear)
          {
            measure = eta[0] * multiply_add(Pack(2.0), d.xi[0], eta[0]);
            for (int a = 1; a < dim; ++a)
              measure = multiply_add(eta[a], multiply_add(Pack(2.0), d.xi[a], eta[a]), measure);
            for (int a = 0; a < dim; ++a)
              along[a] = d.xi[a] + eta[a];
            // An empty place may lie anywhere: nothing must be divided by zero there.
            const Pack length = square_root(maximum(d.square + measure, Pack(1e-20) * d.square));
            factor            = measure / (d.length * length * (d.length + length));
          }
        else
          {
            Pack product = d.xi[0] * eta[0];
            for (int a = 1; a < dim; ++a)
              product = multiply_add(d.xi[a], eta[a], product);
            for (int a = 0; a < dim; ++a)
              along[a] = d.xi[a];
            measure = product * d.inverse_length * d.inverse_length;
            factor  = measure * d.inverse_length;
          }
      }

      BRECCIA_KERNEL Pack stretch(const Direction<dim> &d) const
      {
        if constexpr (!nonlinear)
          return measure;
        else
          return measure / (d.length * (d.length + square_root(maximum(d.square + measure, Pack(1e-20) * d.square))));
      }
    };
  } // namespace

  /** The bonds of one group of layers. */
  struct BondForces::Pass
  {
    const Bonds  &bonds;
    const double *k; ///< stiffness
    const Field  &u;
    Field        *f, *given;
    Rows          rows;

    double      *changed   = nullptr; ///< the same, where bonds may break
    const Field *last_step = nullptr;
    BondAccount *account   = nullptr;
    double      *energy    = nullptr;

    template <int dim, bool nonlinear, Task task, bool own_limits>
    void run_as()
    {
      std::vector<Direction<dim>, base::ColumnAllocator<Direction<dim>>> directions;
      for (const Offset &o : bonds.offsets())
        directions.push_back(direction_of<dim, nonlinear>(bonds, o));
      const std::size_t stride = bonds.grid().row_stride();
      Pack              sum(0.0);
      for (std::size_t r = rows.first; r < rows.last; ++r)
        for (std::size_t begin = 0; begin < stride; begin += tile)
          for (std::size_t o = 0; o < directions.size(); ++o)
            line<dim, nonlinear, task, own_limits>(directions[o], o, {r, begin, std::min(begin + tile, stride)}, sum);
      if (task == Task::energy)
        *energy = sum_of(sum);
    }

    /** Part of a row of the grid. */
    struct Stretch
    {
      std::size_t row, begin, end;
    };

    template <int dim, bool nonlinear, Task task, bool own_limits>
    void line(const Direction<dim> &of, const std::size_t o, const Stretch &part, Pack &sum)
    {
      const Direction<dim> d     = of; // in registers
      const std::size_t    start = part.row * bonds.grid().row_stride();
      const std::size_t    bond = bonds.begin(part.row, o), own_first = rows.first * bonds.grid().row_stride();
      const auto           jump = static_cast<std::size_t>(bonds.jump(o));
      for (std::size_t x = part.begin; x < part.end; x += pack_size)
        {
          const std::size_t i = start + x, j = i + jump;
          Pack              stiffness = load(k + bond + x), eta[dim];
          for (std::size_t a = 0; a < dim; ++a)
            eta[a] = Pack::load_unaligned(&u.c[a][j]) - load(&u.c[a][i]);
          const PulledBonds<dim, nonlinear> pulled(d, eta);
          if constexpr (task == Task::energy)
            {
              const Pack s = pulled.stretch(d);
              sum          = multiply_add(Pack(0.5) * stiffness * d.length, s * s, sum);
            }
          else
            {
              if constexpr (task == Task::force_and_break)
                {
                  Pack limit = d.limit;
                  if constexpr (own_limits)
                    {
                      const Pack s = load(&bonds.limits()[bond + x]);
                      limit        = nonlinear ? d.square * s * (Pack(2.0) + s) : s;
                    }
                  if (any(pulled.measure >= limit))
                    stiffness = less_broken(stiffness, pulled, limit, d, {bond + x, i, j});
                }
              const Pack pull = stiffness * pulled.factor;
              for (std::size_t a = 0; a < dim; ++a)
                {
                  double *const own = &f->c[a][i], *const other = &given->c[a][j - own_first];
                  store(multiply_add(pull, pulled.along[a], load(own)), own);
                  negative_multiply_add(pull, pulled.along[a], Pack::load_unaligned(other)).store_unaligned(other);
                }
            }
        }
    }

    /** Where eight bonds are: of their stiffness and of their ends, the first ones. */
    struct Place
    {
      std::size_t bond, i, j;
    };

    /** Takes the stiffness of bonds that are stretched too far, for ever, and counts them. */
    template <int dim, bool nonlinear>
    BRECCIA_RARE Pack less_broken(const Pack                        &stiffness,
                                  const PulledBonds<dim, nonlinear> &pulled,
                                  const Pack                        &limit,
                                  const Direction<dim>              &d,
                                  const Place                       &at)
    {
      const Pack         stretch = pulled.stretch(d);
      alignas(64) double left[pack_size];
      for (int lane = 0; lane < pack_size; ++lane)
        {
          left[lane] = stiffness[lane];
          if (stiffness[lane] == 0 || !(pulled.measure[lane] >= limit[lane]))
            continue;
          ++account->broken;
          account->released += 0.5 * stiffness[lane] * d.length[lane] * stretch[lane] * stretch[lane];
          if (last_step != nullptr)
            for (std::size_t a = 0; a < dim; ++a)
              account->released -= 0.5 * stiffness[lane] * pulled.factor[lane] * pulled.along[a][lane] *
                                   (last_step->c[a][at.j + static_cast<std::size_t>(lane)] -
                                    last_step->c[a][at.i + static_cast<std::size_t>(lane)]);
          left[lane] = 0;
        }
      const Pack rest = load(left);
      store(rest, changed + at.bond);
      return rest;
    }

    template <Task task, bool own_limits>
    void run_task(const Kinematics kinematics)
    {
      const int  dimension = bonds.grid().dimension();
      const bool nonlinear = kinematics == Kinematics::nonlinear;
      if (dimension == 1)
        nonlinear ? run_as<1, true, task, own_limits>() : run_as<1, false, task, own_limits>();
      else if (dimension == 2)
        nonlinear ? run_as<2, true, task, own_limits>() : run_as<2, false, task, own_limits>();
      else
        nonlinear ? run_as<3, true, task, own_limits>() : run_as<3, false, task, own_limits>();
    }
  };

  namespace
  {
    /**
     * Where groups of layers begin, and the end of the last. A few thousand places are worth being handed out.
     * @param reach layers to which a group gives beyond its own: those of the next one alone
     */
    std::vector<std::size_t>
    group_begins(const std::size_t layers, const std::size_t layer, const std::size_t reach, const bool planes)
    {
      const std::size_t        worth = (std::size_t(4096) + layer - 1) / layer;
      std::vector<std::size_t> begins;
      if (!planes)
        {
          for (std::size_t l = 0; l < layers; l += std::max(2 * reach, worth))
            begins.push_back(l);
          begins.push_back(layers);
          return begins;
        }
      // Few and large: as many as threads can share evenly, the same number of planes to one each.
      const std::size_t most   = std::max<std::size_t>(layers / std::max(reach + 1, worth), 1);
      std::size_t       shares = 16;
      while (shares > 1 && most < 2 * shares)
        shares /= 2;
      const std::size_t groups = most - most % shares;
      for (std::size_t g = 0; g <= groups; ++g)
        begins.push_back(g * layers / groups);
      return begins;
    }
  } // namespace

  BondForces::BondForces(const Bonds &bonds, const Kinematics how)
    : kinematics(how)
  {
    const Grid              &grid   = bonds.grid();
    const std::array<int, 3> counts = grid.counts();
    const auto               reach  = static_cast<std::size_t>(std::max(grid.reach(), 1));
    const bool               planes = grid.dimension() == 3;
    row                             = grid.row_stride();
    layer                           = grid.row_stride() * (planes ? static_cast<std::size_t>(counts[1]) : 1);
    layers                          = planes ? static_cast<std::size_t>(counts[2]) : grid.rows();
    first_layer                     = group_begins(layers, layer, reach, planes);
    groups                          = first_layer.size() - 1;
    // Bonds between planes reach some rows further than whole planes.
    beyond = reach * layer + (planes ? reach * grid.row_stride() : 0) + grid.row_stride();
    for (std::size_t g = 0; g < groups; ++g)
      given.emplace_back(grid.dimension(), (first_layer[g + 1] - first_layer[g]) * layer + beyond);
    accounts.resize(groups);
    energies.assign(groups, 0.0);
  }

  namespace
  {
    void clear(Field &field, const std::size_t first, const std::size_t last)
    {
      for (base::Column &column : field.c)
        if (!column.empty())
          std::fill(column.begin() + static_cast<std::ptrdiff_t>(first),
                    column.begin() + static_cast<std::ptrdiff_t>(last), 0.0);
    }
  } // namespace

  void BondForces::collect(Field &f) const
  {
#pragma omp parallel for schedule(static)
    for (std::ptrdiff_t g = 0; g < static_cast<std::ptrdiff_t>(groups); ++g)
      {
        const auto        n     = static_cast<std::size_t>(g);
        const std::size_t first = first_layer[n] * layer, last = first_layer[n + 1] * layer;
        for (std::size_t a = 0; a < 3; ++a)
          {
            if (f.c[a].empty())
              continue;
            double *const       to  = f.c[a].data() + first;
            const double *const own = given[n].c[a].data();
            for (std::size_t i = 0; i < last - first; ++i)
              to[i] += own[i];
            if (n == 0)
              continue;
            const double *const before = given[n - 1].c[a].data() + first - first_layer[n - 1] * layer;
            for (std::size_t i = 0; i < std::min(beyond, last - first); ++i)
              to[i] += before[i];
          }
      }
  }

  template <typename Function>
  void BondForces::each_group(Function &&f) const
  {
    const std::size_t rows = layer / row; // of a layer
#pragma omp parallel for schedule(static, 1)
    for (std::ptrdiff_t g = 0; g < static_cast<std::ptrdiff_t>(groups); ++g)
      {
        const auto n = static_cast<std::size_t>(g);
        f(n, Rows{first_layer[n] * rows, first_layer[n + 1] * rows});
      }
  }

  BondForces::Pass
  BondForces::forces_pass(const Bonds &bonds, const Field &u, Field &f, const std::size_t g, const Rows &rows)
  {
    clear(given[g], 0, given[g].c[0].size());
    clear(f, rows.first * row, rows.last * row);
    return {bonds, bonds.stiffness().data(), u, &f, &given[g], rows};
  }

  void BondForces::add_up(const Bonds &bonds, const Field &u, Field &f)
  {
    each_group([&](const std::size_t g, const Rows &rows) {
      forces_pass(bonds, u, f, g, rows).run_task<Task::force, false>(kinematics);
    });
    collect(f);
  }

  BondAccount BondForces::add_up_and_break(Bonds &bonds, const Field &u, const Field *const last_step, Field &f)
  {
    each_group([&](const std::size_t g, const Rows &rows) {
      accounts[g]    = {};
      Pass pass      = forces_pass(bonds, u, f, g, rows);
      pass.changed   = bonds.stiffness().data();
      pass.last_step = last_step;
      pass.account   = &accounts[g];
      if (bonds.limits().empty())
        pass.run_task<Task::force_and_break, false>(kinematics);
      else
        pass.run_task<Task::force_and_break, true>(kinematics);
    });
    collect(f);
    BondAccount all;
    for (const BondAccount &group : accounts)
      {
        all.broken += group.broken;
        all.released += group.released;
      }
    return all;
  }

  double BondForces::energy(const Bonds &bonds, const Field &u)
  {
    each_group([&](const std::size_t g, const Rows &rows) {
      Pass pass{bonds, bonds.stiffness().data(), u, nullptr, nullptr, rows};
      pass.energy = &energies[g];
      pass.run_task<Task::energy, false>(kinematics);
    });
    double sum = 0;
    for (const double group : energies)
      sum += group;
    return sum;
  }

  double BondForces::stretch(const Bonds      &bonds,
                             const std::size_t offset,
                             const std::size_t first,
                             const std::size_t second,
                             const Field      &u) const
  {
    const Offset         &o       = bonds.offsets()[offset];
    const double          spacing = bonds.grid().spacing(), l = o.length * spacing;
    const Eigen::Vector3d xi  = spacing * Eigen::Vector3d(o.steps[0], o.steps[1], o.steps[2]),
                          eta = u.at(second) - u.at(first);
    if (kinematics == Kinematics::linear)
      return xi.dot(eta) / (l * l);
    const double squares = eta.dot(2 * xi + eta);
    return squares / (l * (l + std::sqrt(l * l + squares)));
  }
} // namespace dem::peridynamics
