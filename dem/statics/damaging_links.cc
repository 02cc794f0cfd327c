#include "dem/statics/damaging_links.h"

#include "base/state_vectors.h"
#include "dem/network/waiting_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem
{
  namespace
  {
    void visit_numbers(base::StateVisitor &visitor, const char *name, std::vector<double> &numbers)
    {
      base::Column column(numbers.begin(), numbers.end());
      visitor.column(name, column);
      numbers.assign(column.begin(), column.end());
    }
  } // namespace

  DamagingLinks::DamagingLinks(const LoadedNetwork &network, const LinkMaterials &materials)
    : loaded(&network)
    , law(law_of_links(network.network, materials))
    , columns(law->columns().size())
    , state(columns * network.network.links.size(), 0.0)
    , shear(network.network.links.size(), Eigen::Vector3d::Zero())
    , trial_shear(shear)
    , turn(shear)
    , trial_turn(shear)
    , strain(shear.size(), 0.0)
    , answer(shear.size())
    , force(shear)
    , moment(law->has_moment() ? shear.size() : 0, Eigen::Vector3d::Zero())
    , grown(shear.size(), 0)
    , slid(grown)
  {
    for (std::size_t i = 0; i < size(); ++i)
      {
        law->begin(pair_of(i), network.network.links[i].made, &state[columns * i]);
        strain[i] = geometry_of(network.network.links[i]).strain;
      }
    trial        = state;
    trial_strain = strain;
  }

  LinkGeometry DamagingLinks::geometry(const std::size_t i, const double normal_strain) const
  {
    const ElasticLink &l = loaded->network.links[i];
    return {normal_strain, l.reference * (1 + normal_strain), l.reference, l.area};
  }

  LinkStep DamagingLinks::step_of(const std::size_t i) const
  {
    const ElasticLink &l = loaded->network.links[i];
    LinkStep           step;
    step.geometry        = geometry(i, trial_strain[i]);
    step.strain_before   = strain[i];
    step.direction       = l.direction;
    step.shear_increment = trial_shear[i] - shear[i];
    if (law->has_moment())
      {
        const Eigen::Vector3d turned = trial_turn[i] - turn[i];
        step.twist_increment         = l.direction.dot(turned);
        step.bending_increment       = turned - step.twist_increment * l.direction;
      }
    return step;
  }

  void DamagingLinks::evaluate(const LoadedMotion &motion)
  {
    const std::int64_t n = static_cast<std::int64_t>(size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < n; ++i)
      {
        const ElasticLink    &l     = loaded->network.links[i];
        const Eigen::Vector3d total = slip_of(*loaded, i, motion) / l.reference;
        const double          along = l.direction.dot(total);
        trial_strain[i]             = geometry_of(l).strain + along;
        trial_shear[i]              = total - along * l.direction;
        if (law->has_moment())
          trial_turn[i] = turn_of(*loaded, i, motion);
        answer[i] = law->update(pair_of(i), step_of(i), row(state, i), &trial[columns * i]);
        force[i]  = answer[i].force;
        if (law->has_moment())
          moment[i] = answer[i].moment;
      }
  }

  double DamagingLinks::growth(const std::size_t i) const
  {
    const double before = reached(i);
    return std::isinf(before) ? 0.0 : (law->damaging_strain(pair_of(i), row(trial, i)) - before) / std::abs(before);
  }

  double DamagingLinks::exertion(const std::size_t i) const
  {
    const LinkExertion near = law->exertion(pair_of(i), geometry(i, trial_strain[i]),
                                            loaded->network.links[i].direction, force[i], row(trial, i));
    return std::max(near.damage, near.sliding);
  }

  std::vector<base::Matrix6> DamagingLinks::stiffness(const LinkStiffness kind) const
  {
    // In equilibrium a damaging link stands exactly on its envelope, a sliding one at its strength; rounding must not guess which
    // way they will go.
    constexpr double           on_the_envelope = 1e-9;
    std::vector<base::Matrix6> result(size());
    const std::int64_t         n = static_cast<std::int64_t>(size());
#pragma omp parallel for schedule(static)
    for (std::int64_t i = 0; i < n; ++i)
      {
        const ElasticLink &l = loaded->network.links[i];
        LinkTangent        wanted;
        wanted.secant  = kind == LinkStiffness::secant;
        wanted.damages = growth(i) > 0;
        wanted.slides  = answer[i].slides;
        if (kind == LinkStiffness::onward)
          {
            const double strain = reached(i); // below zero where a link has flowed in compression
            const double nearly = (strain > 0 ? 1 - on_the_envelope : 1 + on_the_envelope) * strain;
            wanted.damages      = wanted.damages || (grown[i] && trial_strain[i] >= nearly);
            wanted.slides       = slid[i] != 0;
          }
        result[i] = law->tangent(pair_of(i), step_of(i), row(state, i), row(trial, i), wanted);
        result[i].topRows<3>() *= l.area;
        result[i].leftCols<3>() /= l.reference;
      }
    return result;
  }

  LinkLosses DamagingLinks::lost_with_trial() const
  {
    LinkLosses lost{lost_by_damage, lost_by_sliding};
    for (std::size_t i = 0; i < size(); ++i)
      {
        lost.sliding += answer[i].friction;
        // What the law sums up in its updates, and what it knows by the closed form.
        lost.damage += answer[i].damage + answer[i].released;
        lost.damage += law->damage_dissipation(pair_of(i), geometry(i, trial_strain[i]), row(trial, i)) -
                       law->damage_dissipation(pair_of(i), geometry(i, strain[i]), row(state, i));
      }
    return lost;
  }

  void DamagingLinks::commit()
  {
    const LinkLosses lost = lost_with_trial();
    lost_by_damage        = lost.damage;
    lost_by_sliding       = lost.sliding;
    for (std::size_t i = 0; i < size(); ++i)
      {
        if (growth(i) > 0)
          grown[i] = 1;
        slid[i] = answer[i].slides;
      }
    state  = trial;
    shear  = trial_shear;
    turn   = trial_turn;
    strain = trial_strain;
  }

  void DamagingLinks::forget_growth() { std::fill(grown.begin(), grown.end(), 0); }

  double DamagingLinks::largest_growth() const
  {
    double largest = 0;
    for (std::size_t i = 0; i < size(); ++i)
      largest = std::max(largest, growth(i));
    return largest;
  }

  LinkLoss DamagingLinks::damage_of(const std::size_t i) const
  {
    return law->damage(pair_of(i), geometry(i, strain[i]), row(state, i));
  }

  double DamagingLinks::damage_work_of(const std::size_t i) const
  {
    return law->damage_dissipation(pair_of(i), geometry(i, strain[i]), row(state, i));
  }

  // A closed link may open again: what counts is whether it would carry tension.
  bool DamagingLinks::is_exhausted(const std::size_t i) const
  {
    if (loaded->network.links[i].waits)
      return false;
    const double opened = std::max(strain[i], std::numeric_limits<double>::min());
    return law->phase(pair_of(i), geometry(i, opened), row(state, i)) != LinkPhase::whole;
  }

  double DamagingLinks::mean_damage() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
      sum += damage_of(i).stiffness;
    return sum / static_cast<double>(loaded->network.bonds());
  }

  double DamagingLinks::stored() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
      sum += law->stored(pair_of(i), geometry(i, strain[i]), row(state, i));
    return sum;
  }

  double DamagingLinks::stored_in_trial() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
      sum += law->stored(pair_of(i), geometry(i, trial_strain[i]), row(trial, i));
    return sum;
  }

  bool DamagingLinks::is_undamaged() const
  {
    constexpr double rounding = 1e-12;
    for (std::size_t i = 0; i < size(); ++i)
      {
        if (growth(i) > 0 || answer[i].slides)
          return false;
        const ElasticLink &l       = loaded->network.links[i];
        base::Matrix6      tangent = law->tangent(pair_of(i), step_of(i), row(state, i), row(trial, i), LinkTangent());
        tangent.topRows<3>() *= l.area;
        tangent.leftCols<3>() /= l.reference;
        const base::Matrix6 first = undamaged_stiffness(l);
        if ((tangent - first).cwiseAbs().maxCoeff() > rounding * first.cwiseAbs().maxCoeff())
          return false;
      }
    return true;
  }

  void DamagingLinks::take_over(const DamagingLinks &earlier, const std::vector<std::optional<std::size_t>> &before)
  {
    for (std::size_t i = 0; i < size(); ++i)
      if (before[i])
        {
          std::copy_n(earlier.row(earlier.state, *before[i]), columns, &state[columns * i]);
          shear[i]  = earlier.shear[*before[i]];
          turn[i]   = earlier.turn[*before[i]];
          strain[i] = earlier.strain[*before[i]];
          grown[i]  = earlier.grown[*before[i]];
          slid[i]   = earlier.slid[*before[i]];
        }
    lost_by_damage  = earlier.lost_by_damage;
    lost_by_sliding = earlier.lost_by_sliding;
  }

  void DamagingLinks::visit_state(base::StateVisitor &visitor)
  {
    visit_numbers(visitor, "history", state);
    base::visit_vectors(visitor, "shear", shear);
    base::visit_vectors(visitor, "turn", turn);
    visit_numbers(visitor, "strain", strain);
    visitor.column("grown", grown);
    visitor.column("slid", slid);
    visitor.scalar("lost_by_damage", lost_by_damage);
    visitor.scalar("lost_by_sliding", lost_by_sliding);
  }
} // namespace dem
