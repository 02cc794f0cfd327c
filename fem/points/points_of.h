#pragma once

#include "base/errors.h"
#include "fem/materials/mixed_control.h"
#include "fem/materials/step_dissipation.h"
#include "fem/materials/traits.h"
#include "fem/points/averaged_points_of.h"

#include <stdexcept>

namespace fem
{
  /// Points that are each for themselves, of any law (doc/theory/materials.md).
  template <typename Law>
  class PointsOf : public MaterialPoints
  {
  public:
    PointsOf(const Law &law_, const Plane plane)
      : law(law_)
      , plane_stress(plane == Plane::stress)
    {
    }

    const char                *material_name() const override { return Law::name; }
    const base::Stiffness     &elastic_stiffness() const override { return law.elastic_stiffness(); }
    bool                       linear() const override { return !has_history<Law>; }
    bool                       takes_initial_state() const override { return fem::takes_initial_state<Law>; }
    std::vector<PointQuantity> quantities() const override { return quantities_of<Law>(); }

    void allocate(const std::size_t n_points) override
    {
      committed.assign(n_points, {});
      trial.assign(n_points, {});
    }

    void evaluate(const std::size_t    point,
                  const base::Voigt   &strain,
                  const ElementExtent &element,
                  const bool           with_tangent,
                  PointAnswer         &answer) override
    {
      if (plane_stress)
        return evaluate_plane_stress(point, strain, element, with_tangent, answer);
      const auto r  = law.evaluate(strain, committed[point], element, with_tangent);
      trial[point]  = r.trial;
      answer.stress = r.stress;
      if (with_tangent)
        answer.tangent = r.tangent;
    }

    void commit() override { committed = trial; }

    void set_initial([[maybe_unused]] const std::size_t        point,
                     [[maybe_unused]] const InitialPointState &given,
                     [[maybe_unused]] const ElementExtent     &element) override
    {
      if constexpr (fem::takes_initial_state<Law>)
        trial[point] = committed[point] = law.initial_state(given, element);
      else
        throw base::InputError(std::string(Law::name) + ": no initial state can be given to it.");
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

    Dissipation dissipated([[maybe_unused]] const std::size_t    point,
                           [[maybe_unused]] const ElementExtent &element) const override
    {
      if constexpr (has_history<Law>)
        {
          const typename Law::State &from = committed[point], &to = trial[point];
          if (Law::was_elastic(from, to))
            return {};
          const MixedTarget    target = in_plane(to.strain);
          const MixedPath<Law> path(law, target, from, element, stress_unit(to.strain));
          const auto           next = [&](const typename Law::State &now, const base::Voigt &strain, double) {
            return law.evaluate(strain, now, element, false).trial;
          };
          return settled_dissipation(law, from, to, [&](const int pieces) {
            return plane_stress ? dissipation_on_path(law, path, pieces, mixed_control::leap * law.strain_scale()) :
                                  dissipation_on_line(law, from, to.strain, pieces, next);
          });
        }
      else
        return {};
    }

  private:
    /// The strains in the plane, and no stress across it.
    static MixedTarget in_plane(const base::Voigt &strain)
    {
      MixedTarget target;
      target.stress_given = {false, false, true, true, true, false};
      target.value << strain[0], strain[1], 0, 0, 0, strain[5];
      return target;
    }

    double stress_unit(const base::Voigt &strain) const
    {
      return law.elastic_stiffness()(0, 0) * std::fmax(strain.cwiseAbs().maxCoeff(), 1e-12);
    }

    void evaluate_plane_stress(const std::size_t    point,
                               const base::Voigt   &strain,
                               const ElementExtent &element,
                               const bool           with_tangent,
                               PointAnswer         &answer)
    {
      // Quickly: the number of parts leaps from strain to strain, and more often when walks must settle surely. Beside such a
      // leap Newton's iteration goes to and fro.
      const MixedTarget target = in_plane(strain);
      const double      unit   = stress_unit(strain);
      const auto s = solve_mixed(law, target, committed[point], element, unit, Increments::followed, Settling::quickly);
      trial[point] = s.response.trial;
      answer.stress    = s.response.stress;
      answer.stress[2] = answer.stress[3] = answer.stress[4] = 0;
      if (with_tangent)
        answer.tangent = mixed_tangent(law, target, committed[point], element, unit, s);
    }

    Law                              law;
    bool                             plane_stress;
    std::vector<typename Law::State> committed, trial;
  };

  template <typename Law>
  std::unique_ptr<MaterialPoints> make_points(const Law &law, const Plane plane)
  {
    if constexpr (averages<Law>)
      if (law.averaging_length() > 0)
        {
          if (plane == Plane::stress)
            throw base::InputError("Nonlocal length: is not built for plane stress.");
          return std::make_unique<AveragedPointsOf<Law>>(law);
        }
    return std::make_unique<PointsOf<Law>>(law, plane);
  }
}
