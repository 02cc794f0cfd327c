#pragma once

#include "fem/materials/mixed_control.h"
#include "fem/materials/traits.h"
#include "fem/points/driven_point.h"

namespace fem
{
  template <typename Law>
  class DrivenPointOf final : public DrivenPoint
  {
  public:
    explicit DrivenPointOf(const Law &law_)
      : law(law_)
    {
    }

    void go_to(const MixedTarget   &target,
               const ElementExtent &element,
               const double         stress_unit,
               const Increments     how) override
    {
      const auto reached = solve_mixed(law, target, state, element, stress_unit, how);
      now_strain         = reached.strain;
      now_stress         = reached.response.stress;
      state              = reached.response.trial;
      in_parts           = reached.parts * reached.response.substeps;
    }

    const base::Voigt     &strain() const override { return now_strain; }
    const base::Voigt     &stress() const override { return now_stress; }
    int                    parts() const override { return in_parts; }
    const base::Stiffness &elastic_stiffness() const override { return law.elastic_stiffness(); }
    void                   visit(const StateColumn &column) override { Law::describe_state(state, column); }

    Increments increments() const override
    {
      if constexpr (has_history<Law>)
        return law.increments();
      else
        return Increments::followed;
    }

  private:
    Law                 law;
    typename Law::State state;
    base::Voigt         now_strain = base::Voigt::Zero(), now_stress = base::Voigt::Zero();
    int                 in_parts = 1;
  };
}
