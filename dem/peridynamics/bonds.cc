#include "dem/peridynamics/bonds.h"

#include "base/errors.h"
#include "base/number_text.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dem::peridynamics
{
  namespace
  {
    /** Twice the signed area of a triangle in the plane. */
    double side(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const Eigen::Vector3d &p)
    {
      return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    }
  } // namespace

  bool Precrack::crosses(const Eigen::Vector3d &a, const Eigen::Vector3d &b, const int dimension) const
  {
    if (dimension < 3)
      return side(from, to, a) * side(from, to, b) <= 0 && side(a, b, from) * side(a, b, to) <= 0 &&
             side(from, to, a) != side(from, to, b);
    const Eigen::Vector3d edge = to - from, normal = edge.cross(depth);
    const double          at_a = normal.dot(a - from), at_b = normal.dot(b - from);
    if (at_a * at_b > 0 || at_a == at_b)
      return false;
    const Eigen::Vector3d hit = a + at_a / (at_a - at_b) * (b - a) - from;
    const double          uu = edge.dot(edge), uv = edge.dot(depth), vv = depth.dot(depth), whole = uu * vv - uv * uv;
    const double          u = (vv * hit.dot(edge) - uv * hit.dot(depth)) / whole;
    const double          v = (uu * hit.dot(depth) - uv * hit.dot(edge)) / whole;
    return u >= 0 && u <= 1 && v >= 0 && v <= 1;
  }

  Bonds::Bonds(const Grid &grid, const Horizon &horizon, const Material &material)
    : Bonds(grid, horizon, Mixture(material))
  {
  }

  Bonds::Bonds(const Grid &grid, const Horizon &horizon, const Mixture &mixture)
    : of(grid)
    , made_of(mixture)
    , family(half_family(grid.dimension(), horizon))
    , length_of_horizon(horizon.ratio * grid.spacing())
  {
    const Material        &shared   = made_of.materials.front();
    const LatticeConstants as_it_is = lattice_constants(grid.body().space, shared.model, horizon);
    constants                       = as_it_is.calibrated(shared.calibration);
    for (const Offset &o : family)
      jumps.push_back(static_cast<std::ptrdiff_t>(of.row_stride()) * (o.steps[1] + o.steps[2] * of.counts()[1]) +
                      o.steps[0]);
    std::vector<double> c; // of each pair
    for (const PairConstants &pair : made_of.pairs)
      c.push_back(
        bond_constant(grid.body().space, shared.model, pair.young_modulus, length_of_horizon, grid.body().section()) /
        as_it_is.factor(shared.calibration));
    k.assign(of.rows() * family.size() * of.row_stride(), 0.0);
    each([&](const std::size_t bond, const std::size_t o, const std::size_t i, const std::size_t j) {
      const double per_stretch = shared.model == BondModel::general ? family[o].length * of.spacing() : 1.0;
      k[bond] = c[made_of.pair_at(i, j)] * family[o].part * per_stretch * of.volume()[i] * of.volume()[j];
    });
    set_limits();
    if (horizon.surface_correction)
      correct_surface();
  }

  void Bonds::set_limits()
  {
    const auto differs = [this](const PairConstants &p) { return p.critical_stretch != critical_stretch(); };
    if (std::none_of(made_of.pairs.begin(), made_of.pairs.end(), differs))
      return;
    limit.assign(k.size(), std::numeric_limits<double>::infinity());
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      limit[bond] = made_of.pairs[made_of.pair_at(i, j)].critical_stretch;
    });
  }

  void Bonds::correct_surface()
  {
    double whole = 0; // family of a node far from the surface
    for (const Offset &o : family)
      whole += 2 * o.part;
    whole *= std::pow(of.spacing(), of.dimension()) * of.body().section();
    const base::Column volumes = family_volumes();
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      k[bond] *= 2 * whole / (volumes[i] + volumes[j]);
    });
  }

  base::Column Bonds::masses() const
  {
    base::Column mass = of.volume();
    for (const std::size_t i : of.nodes())
      mass[i] *= made_of.at(i).density * (own_part.empty() ? 1.0 : own_part[i]);
    return mass;
  }

  std::size_t Bonds::count() const
  {
    std::size_t n = 0;
    each([&n](std::size_t, std::size_t, std::size_t, std::size_t) { ++n; });
    return n;
  }

  std::size_t Bonds::broken() const
  {
    std::size_t n = 0;
    each([&](const std::size_t bond, std::size_t, std::size_t, std::size_t) { n += k[bond] == 0 ? 1 : 0; });
    return n;
  }

  std::size_t Bonds::cut(const Precrack &crack)
  {
    std::size_t n = 0;
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      if (k[bond] == 0 || !crack.crosses(of.position(i), of.position(j), of.dimension()))
        return;
      break_bond(bond);
      ++n;
    });
    return n;
  }

  void Bonds::share(const base::Column &part)
  {
    own_part = part;
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      k[bond] *= 0.5 * (part[i] + part[j]);
    });
  }

  void Bonds::protect(const std::vector<bool> &safe)
  {
    if (limit.empty())
      limit.assign(k.size(), critical_stretch());
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      if (safe[i] || safe[j])
        limit[bond] = std::numeric_limits<double>::infinity();
    });
  }

  base::Column Bonds::family_volumes() const
  {
    base::Column volumes(of.places(), 0.0);
    each([&](std::size_t, const std::size_t o, const std::size_t i, const std::size_t j) {
      volumes[i] += family[o].part * of.volume()[j];
      volumes[j] += family[o].part * of.volume()[i];
    });
    return volumes;
  }

  std::vector<double> Bonds::damage() const
  {
    base::Column whole(of.places(), 0.0), gone(of.places(), 0.0);
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      const double vi = of.volume()[i], vj = of.volume()[j];
      whole[i] += vj;
      whole[j] += vi;
      if (k[bond] != 0)
        return;
      gone[i] += vj;
      gone[j] += vi;
    });
    std::vector<double> damage;
    for (const std::size_t i : of.nodes())
      damage.push_back(whole[i] > 0 ? gone[i] / whole[i] : 0.0);
    return damage;
  }

  void Bonds::refuse_isolated_nodes() const
  {
    std::vector<bool> held(of.places(), false);
    each([&](const std::size_t bond, std::size_t, const std::size_t i, const std::size_t j) {
      if (k[bond] != 0)
        held[i] = held[j] = true;
    });
    for (const std::size_t i : of.nodes())
      if (!held[i])
        {
          const Eigen::Vector3d x = of.position(i);
          throw base::InputError(
            "Body: the node " + std::to_string(of.number(i) + 1) + " at (" + base::number_text(x.x()) + ", " +
            base::number_text(x.y()) + ", " + base::number_text(x.z()) +
            ") m is isolated: no bond leads to it. Enlarge Horizon/Ratio, or move Holes and Cracks.");
        }
  }
} // namespace dem::peridynamics
