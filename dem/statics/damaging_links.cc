#include "dem/statics/damaging_links.h"

#include <algorithm>
#include <cmath>

namespace dem
{
  namespace
  {
    Eigen::Vector3d vector(const Vec<double, 3> &v) { return {v[0], v[1], v[2]}; }
    Vec<double, 3>  vector(const Eigen::Vector3d &v) { return {{v[0], v[1], v[2]}}; }

    /** Write or read a number (three, for a vector) per link. */
    template <typename Get>
    void visit(StateVisitor &visitor, const char *name, const std::size_t links, const int numbers, const Get &get)
    {
      Column column(links * numbers);
      for (std::size_t i = 0; i < links; ++i)
        for (int c = 0; c < numbers; ++c)
          column[i * numbers + c] = get(i, c);
      visitor.column(name, column);
      for (std::size_t i = 0; i < links; ++i)
        for (int c = 0; c < numbers; ++c)
          get(i, c) = column.at(i * numbers + c);
    }
  } // namespace

  DamagingLinks::DamagingLinks(const LoadedNetwork &network, const CpmMaterials &materials)
    : loaded(&network)
    , laws(materials)
    , state(network.network.links.size(), CpmState<double, 3>{})
    , trial(state)
    , shear(state.size(), Eigen::Vector3d::Zero())
    , trial_shear(shear)
    , unreturned(shear)
    , strain(state.size(), 0.0)
    , trial_strain(strain)
    , response(state.size(), CpmResponse<double, 3>{})
    , force(shear)
    , grown(state.size(), 0)
    , slid(grown)
  {
  }

  void DamagingLinks::evaluate(const LoadedMotion &motion)
  {
    const std::int64_t n = static_cast<std::int64_t>(state.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < n; ++i)
      {
        const ElasticLink    &l     = loaded->network.links[i];
        const Eigen::Vector3d total = slip_of(*loaded, i, motion) / l.branch.norm();
        trial_strain[i]             = l.direction.dot(total);
        trial_shear[i]              = total - trial_strain[i] * l.direction;
        unreturned[i]               = vector(state[i].elastic_shear) + trial_shear[i] - shear[i];
        trial[i]                    = state[i];
        trial[i].elastic_shear      = vector(unreturned[i]);
        response[i] = Cpm<true, true>::update(law_of(i), trial_strain[i], trial_shear[i].squaredNorm(), trial[i]);
        force[i]    = l.area * (response[i].normal_stress * l.direction + vector(response[i].shear_stress));
      }
  }

  CpmUpdate DamagingLinks::update_of(const std::size_t i) const
  {
    return {trial_strain[i],   trial_shear[i],  unreturned[i],
            trial[i].kappa,    trial[i].damage, trial[i].kappa > reached(i),
            response[i].slides};
  }

  std::vector<Eigen::Matrix3d> DamagingLinks::stiffness(const LinkStiffness kind) const
  {
    // In equilibrium a damaging link stands exactly on its envelope, a sliding one at its strength; rounding must not guess which
    // way they will go.
    constexpr double             on_the_envelope = 1e-9;
    std::vector<Eigen::Matrix3d> result(state.size());
    const std::int64_t           n = static_cast<std::int64_t>(state.size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < n; ++i)
      {
        const ElasticLink &l = loaded->network.links[i];
        CpmUpdate          u = update_of(i);
        if (kind == LinkStiffness::onward && grown[i] && trial_strain[i] >= (1 - on_the_envelope) * reached(i))
          u.grows = true;
        if (kind == LinkStiffness::onward)
          u.slides = slid[i] != 0;
        result[i] = l.area / l.branch.norm() *
                    (kind == LinkStiffness::secant ? cpm_secant(law_of(i), l.direction, u) :
                                                     cpm_tangent(law_of(i), l.direction, u));
      }
    return result;
  }

  void DamagingLinks::commit()
  {
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        const CpmConstants &law    = law_of(i);
        const ElasticLink  &l      = loaded->network.links[i];
        const double        volume = l.area * l.branch.norm();
        lost_by_sliding += volume * response[i].plastic_work;
        lost_by_damage += volume * response[i].damage_work;
        if (law.shear_weight == 0) // then the pass does not sum up what damage takes; the closed form does
          lost_by_damage += volume * (law.dissipated_at(trial[i].kappa, trial[i].damage) -
                                      law.dissipated_at(state[i].kappa, state[i].damage));
        if (trial[i].kappa > reached(i))
          grown[i] = 1;
        slid[i] = response[i].slides;
      }
    state  = trial;
    shear  = trial_shear;
    strain = trial_strain;
  }

  void DamagingLinks::forget_growth() { std::fill(grown.begin(), grown.end(), 0); }

  double DamagingLinks::largest_growth() const
  {
    double largest = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      largest = std::max(largest, growth(i));
    return largest;
  }

  double DamagingLinks::strength_damage_of(const std::size_t i) const
  {
    return law_of(i).strength_damage(state[i].kappa, state[i].damage);
  }

  double DamagingLinks::damage_work_of(const std::size_t i) const
  {
    const CpmConstants &law = law_of(i);
    const ElasticLink  &l   = loaded->network.links[i];
    return law.shear_weight == 0 ? l.area * l.branch.norm() * law.dissipated_at(state[i].kappa, state[i].damage) : 0.0;
  }

  double DamagingLinks::mean_damage() const
  {
    double sum = 0;
    for (const auto &s : state)
      sum += s.damage;
    return sum / static_cast<double>(state.size());
  }

  double DamagingLinks::stored() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < state.size(); ++i)
      {
        const CpmConstants &law          = law_of(i);
        const double        open         = std::max(strain[i], 0.0);
        const double        shear_energy = law.G * vector(state[i].elastic_shear).squaredNorm();
        sum += 0.5 * loaded->network.links[i].area * loaded->network.links[i].branch.norm() *
               (law.E * (strain[i] * strain[i] - state[i].damage * open * open) + shear_energy);
      }
    return sum;
  }

  void DamagingLinks::visit_state(StateVisitor &visitor)
  {
    const std::size_t n = state.size();
    visit(visitor, "kappa", n, 1, [&](std::size_t i, int) -> double & { return state[i].kappa; });
    visit(visitor, "damage", n, 1, [&](std::size_t i, int) -> double & { return state[i].damage; });
    visit(visitor, "elastic_shear", n, 3, [&](std::size_t i, int c) -> double & { return state[i].elastic_shear[c]; });
    visit(visitor, "shear", n, 3, [&](std::size_t i, int c) -> double & { return shear[i][c]; });
    visit(visitor, "strain", n, 1, [&](std::size_t i, int) -> double & { return strain[i]; });
    visitor.column("grown", grown);
    visitor.column("slid", slid);
    visitor.scalar("lost_by_damage", lost_by_damage);
    visitor.scalar("lost_by_sliding", lost_by_sliding);
  }
} // namespace dem
