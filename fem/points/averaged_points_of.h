#pragma once

#include "fem/materials/step_dissipation.h"
#include "fem/points/averaged_points.h"
#include "fem/points/nonlocal_weights.h"

namespace fem
{
  /**
   * AveragedPoints of a law with averaging_length(), averaging_factor(), flow(strain, state, with_tangent), which gives a Law::March
   * with driving() and driving_by_strain(), damage(march, driving, strain, state, element, with_tangent), and driving_of(state).
   */
  template <typename Law>
  class AveragedPointsOf : public AveragedPoints
  {
  public:
    explicit AveragedPointsOf(const Law &law_)
      : law(law_)
    {
    }

    const char                *material_name() const override { return Law::name; }
    const base::Stiffness     &elastic_stiffness() const override { return law.elastic_stiffness(); }
    bool                       linear() const override { return false; }
    double                     averaging_length() const override { return law.averaging_length(); }
    bool                       takes_initial_state() const override { return true; }
    std::vector<PointQuantity> quantities() const override { return quantities_of<Law>(); }

    void allocate(const std::size_t n_points) override
    {
      committed.assign(n_points, {});
      trial.assign(n_points, {});
      flown.assign(n_points, {});
      driving.assign(n_points, 0.0);
      responses.assign(n_points, base::Voigt::Zero());
    }

    void place(const std::vector<Eigen::Vector3d> &places, const std::vector<double> &volumes) override
    {
      const double m = law.averaging_factor();
      weights        = NonlocalWeights(places, volumes, law.averaging_length());
      coupled.assign(places.size(), {});
      for (std::size_t i = 0; i < places.size(); ++i)
        {
          coupled[i] = weights.row(i);
          for (auto &[j, weight] : coupled[i])
            weight = m * weight + (j == i ? 1 - m : 0.0);
        }
    }

    void flow(const std::size_t point, const base::Voigt &strain, const bool with_tangent) override
    {
      flown[point] = law.flow(strain, committed[point], with_tangent);
    }

    void average() override
    {
      for (std::size_t i = 0; i < flown.size(); ++i)
        driving[i] = flown[i].driving();
      driving = weights.averaged(driving, law.averaging_factor());
    }

    void evaluate(const std::size_t    point,
                  const base::Voigt   &strain,
                  const ElementExtent &element,
                  const bool           with_tangent,
                  PointAnswer         &answer) override
    {
      const auto done = law.damage(flown[point], driving[point], strain, committed[point], element, with_tangent);
      trial[point]    = done.response.trial;
      answer.stress   = done.response.stress;
      if (!with_tangent)
        return;
      answer.tangent   = done.response.tangent;
      responses[point] = Law::damage_of(trial[point]) > Law::damage_of(committed[point]) ?
                           done.stress_by_driving :
                           base::Voigt(base::Voigt::Zero());
    }

    base::Voigt        influence(const std::size_t point) const override { return flown[point].driving_by_strain(); }
    const base::Voigt &response(const std::size_t point) const override { return responses[point]; }
    const std::vector<std::pair<std::size_t, double>> &couplings(const std::size_t point) const override
    {
      return coupled[point];
    }

    void begin_step() override
    {
      driving_before.resize(committed.size());
      std::transform(committed.begin(), committed.end(), driving_before.begin(), Law::driving_of);
      driving_before = weights.averaged(driving_before, law.averaging_factor());
    }

    void commit() override { committed = trial; }

    void set_initial(const std::size_t point, const InitialPointState &given, const ElementExtent &element) override
    {
      trial[point] = committed[point] = law.initial_state(given, element);
    }

    void visit(const std::size_t point, const StateColumn &column) override
    {
      Law::describe_state(committed[point], column);
      trial[point] = committed[point];
    }

    double stored_energy(const std::size_t point, const base::Voigt &strain, const base::Voigt &stress) const override
    {
      return law.stored_energy(strain, stress, committed[point]);
    }

    /// The average grows with the point's own variable; along a straight line where that does not grow.
    Dissipation dissipated(const std::size_t point, const ElementExtent &element) const override
    {
      const typename Law::State &from = committed[point], &to = trial[point];
      if (Law::was_elastic(from, to) && Law::damage_of(from) == Law::damage_of(to))
        return {};
      const auto next = [&](const typename Law::State &now, const base::Voigt &strain, const double part) {
        const auto   went  = law.flow(strain, now, false);
        const double start = Law::driving_of(from), grown = Law::driving_of(to) - start;
        const double share  = grown > 0 ? (went.driving() - start) / grown : part;
        const double drives = driving_before[point] + share * (driving[point] - driving_before[point]);
        return law.damage(went, drives, strain, now, element, false).response.trial;
      };
      return settled_dissipation(
        law, from, to, [&](const int pieces) { return dissipation_on_line(law, from, to.strain, pieces, next); });
    }

  private:
    Law                                                      law;
    NonlocalWeights                                          weights;
    std::vector<std::vector<std::pair<std::size_t, double>>> coupled;
    std::vector<typename Law::State>                         committed, trial;
    std::vector<typename Law::March>                         flown;
    std::vector<double>                                      driving, driving_before; // averaged
    std::vector<base::Voigt>                                 responses;
  };
}
